#pragma once

#include <cstddef>
#include <vector>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/model/kinks.hpp"

namespace seacrane {

/// The kinks of curves over time at which steps end.
class KinkStops {
 public:
  explicit KinkStops(double scaled_tolerance) : scaled_tolerance_(scaled_tolerance) {}

  /// Time of the next kink that matters to a step of the present length; infinity where there is none near.
  /// Kinks beyond the step are left to the steps that come near them: an integrator must know of a stop a
  /// little beyond its step, no further.
  double next(const std::vector<Kink>& kinks, const Integrator& integrator, double now);

 private:
  double scaled_tolerance_;
  std::size_t next_ = 0;  // of the kinks of the model
};

}  // namespace seacrane
