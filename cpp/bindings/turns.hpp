#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "without_gil.hpp"

/// One thread at a time, in the order in which they came; a thread that has its turn may take it again.
class Turns {
 public:
  /// Waits without the interpreter's lock, which the caller holds.
  void take() {
    if (take_own_or_free()) return;
    const WithoutGil released;
    wait_for(queue(), 1);
  }

  void give() {
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
