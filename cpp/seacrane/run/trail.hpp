#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "seacrane/run/recording.hpp"

namespace seacrane {

/// Values of channels at the middle and the end of every step, for what is made of them elsewhere. Memory
/// grows with the steps.
struct Trail {
  std::vector<const RecordedChannel*> channels;
  std::vector<double> times, rows;

  std::size_t width() const {
    std::size_t out = 0;
    for (const RecordedChannel* c : channels) out += c->size;
    return out;
  }
  /// Drops what was until a time.
  void drop(double until) {
    const auto kept = std::ranges::upper_bound(times, until) - times.begin();
    times.erase(times.begin(), times.begin() + kept);
    rows.erase(rows.begin(), rows.begin() + kept * static_cast<std::ptrdiff_t>(width()));
  }
};

}  // namespace seacrane
