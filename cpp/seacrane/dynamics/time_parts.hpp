#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "seacrane/dynamics/maximal.hpp"

namespace seacrane {

/// Mean wall time of parts of an evaluation, ns, each called `count` times in turn.
class PartTimes {
 public:
  explicit PartTimes(long count) : count_(count) {}

  /// Times part(i), with i from 0.
  template <class Part>
  void measure(const char* name, Part&& part) {
    const auto start = std::chrono::steady_clock::now();
    for (long i = 0; i < count_; ++i) part(i);
    const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
    values_.emplace_back(name, elapsed.count() / static_cast<double>(count_));
  }
  const std::vector<std::pair<std::string, double>>& values() const { return values_; }

 private:
  long count_;
  std::vector<std::pair<std::string, double>> values_;
};

/// Times the parts of an evaluation in maximal coordinates at (t, y). Where it counts, time advances by 1 ms
/// from call to call.
std::vector<std::pair<std::string, double>> time_parts(MaximalSystem& system, double t, const double* y,
                                                       long count);

}  // namespace seacrane
