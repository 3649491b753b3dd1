#include "without_gil.hpp"

#ifdef _WIN32
#include <process.h>
#else
#include <unistd.h>
#endif

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace {

int this_process() {
#ifdef _WIN32
  return ::_getpid();
#else
  return ::getpid();
#endif
}

struct Threads {
  std::mutex mutex;
  std::condition_variable left;
  int process = 0;
  int inside = 0;
  std::atomic<bool> ending{false};
  std::thread::id last;  // the thread that ends the interpreter; set before `ending`
};

/// The threads of the process, which has one interpreter. They are never destroyed, because they outlive it.
Threads& threads() {
  static auto* const all = new Threads;
  return *all;
}

void wait_for_threads() {
  Threads& all = threads();
  all.last = std::this_thread::get_id();
  all.ending = true;
  const py::gil_scoped_release release;
  std::unique_lock lock(all.mutex);
  all.left.wait(lock, [&] { return all.inside == 0 || all.process != this_process(); });
}

}  // namespace

bool WithoutGil::should_return() { return threads().ending && threads().last != std::this_thread::get_id(); }

WithoutGil::Counted::Counted() : process(this_process()) {
  if (should_return()) {
    PyErr_SetString(PyExc_SystemExit, "the interpreter is ending; nothing is begun any more");
    throw py::error_already_set();
  }
  Threads& all = threads();
  const std::lock_guard lock(all.mutex);
  if (all.process != process) {
    all.process = process;
    all.inside = 0;
  }
  ++all.inside;
}

WithoutGil::Counted::~Counted() {
  Threads& all = threads();
  const std::lock_guard lock(all.mutex);
  if (all.process == process && --all.inside == 0) all.left.notify_all();
}

void bind_exit() { py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_threads)); }
