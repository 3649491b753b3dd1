#pragma once

#include <pybind11/pybind11.h>

#include "bindings.hpp"

/// Gives the interpreter's lock back for a while, as py::gil_scoped_release does, and keeps the interpreter
/// from ending meanwhile: a thread that asks an ending interpreter for the lock is cut off in the middle of
/// C++, which aborts the process. In a thread other than the one that ends it, raises SystemExit, which ends
/// a thread in silence: a traceback that is printed while the interpreter ends can abort the process too.
class WithoutGil {
 public:
  WithoutGil() = default;
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

  /// Whether the interpreter waits for this thread to come back. May be asked without the lock.
  static bool should_return();

 private:
  struct Counted {
    Counted();
    ~Counted();
    int process;  // a fork leaves the threads of its parent behind, not their number
  };
  Counted counted_;
  py::gil_scoped_release release_;
};

void bind_exit();
