#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "bindings.hpp"
#include "seacrane/run/simulation.hpp"
#include "vector_state.hpp"
#include "without_gil.hpp"

/// One thread at a time, in the order in which they came; a thread that has its turn may take it again.
class Turns {
 public:
  /// Waits without the interpreter's lock, which the caller holds.
  void lock() {
    if (take_own_or_free()) return;
    const WithoutGil released;
    wait_for(queue(), 1);
  }

  void unlock() {
    const std::lock_guard lock(mutex_);
    if (--depth_ == 0) pass_on();
  }

  /// Lets all who wait go first. Held without the interpreter's lock by a thread that has its turn.
  class Pause {
   public:
    explicit Pause(Turns& turns) : turns_(turns) {
      const std::lock_guard lock(turns_.mutex_);
      depth_ = turns_.depth_;
      turns_.depth_ = 0;
      turns_.pass_on();
    }
    ~Pause() { turns_.wait_for(turns_.queue(), depth_); }
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    Turns& turns_;
    int depth_ = 0;
  };

 private:
  bool take_own_or_free() {
    const std::lock_guard lock(mutex_);
    const auto self = std::this_thread::get_id();
    if (depth_ > 0 && owner_ == self) {
      ++depth_;
      return true;
    }
    if (serving_ != last_) return false;
    ++last_;
    owner_ = self;
    depth_ = 1;
    return true;
  }

  long queue() {
    const std::lock_guard lock(mutex_);
    return last_++;
  }

  void wait_for(long number, int depth) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return serving_ == number; });
    owner_ = std::this_thread::get_id();
    depth_ = depth;
  }

  void pass_on() {
    ++serving_;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread::id owner_;
  long serving_ = 0, last_ = 0;  // numbers of the queue
  int depth_ = 0;
};

/// A simulation that threads may share: one at a time is inside. A run in progress lets the others in every
/// 20 ms, between two steps.
class SharedSimulation {
 public:
  SharedSimulation(std::shared_ptr<const seacrane::Model> model, const seacrane::State& start,
                   seacrane::RunOptions options)
      : simulation_(std::move(model), start, std::move(options)) {}

  bool advance(double t_end, const py::object& progress) {
    return while_advancing([&](seacrane::Simulation& simulation) {
      const WithoutGil released;
      clear_vector_state();
      return simulation.advance(t_end, [&](double time) {
        if (WithoutGil::should_return()) return false;
        return between_steps([&] { return ask_python(time, progress); });
      });
    });
  }

  /// Calls f(simulation), in whose course it may be advanced.
  template <class Function>
  bool while_advancing(const Function& function) {
    const std::lock_guard turn(turns_);
    if (advancing_) {
      throw std::domain_error(
          "run: is advanced already, by another thread or by whom it calls; give each thread a run of its "
          "own");
    }
    const Advancing mark(advancing_);
    return function(simulation_);
  }

  /// Lets others in, calls f(), and waits for its turn.
  template <class Function>
  bool between_steps(const Function& function) {
    const Turns::Pause pause(turns_);
    return function();
  }

  static bool ask_python(double time, const py::object& progress);

  template <class Function>
  auto alone(const Function& function) {
    const std::lock_guard turn(turns_);
    return function(simulation_);
  }

  void enter() { turns_.lock(); }
  void leave() { turns_.unlock(); }

 private:
  struct Advancing {
    explicit Advancing(bool& mark) : flag(mark) { flag = true; }
    ~Advancing() { flag = false; }
    Advancing(const Advancing&) = delete;
    Advancing& operator=(const Advancing&) = delete;
    bool& flag;
  };

  Turns turns_;
  bool advancing_ = false;
  seacrane::Simulation simulation_;
};
