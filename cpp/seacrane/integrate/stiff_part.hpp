#pragma once

#include <cstddef>

namespace seacrane {

/// What makes a system stiff, where that is little and known: few numbers z of the state on which its rates
/// depend so strongly that explicit steps would be bound by them,
///
///   z = in y,   dy'/dz = out.
class StiffPart {
 public:
  virtual ~StiffPart() = default;
  /// How many numbers.
  virtual std::size_t rank() const = 0;
  /// Writes `in`, by numbers, and `out`, by numbers too, each over all components of the state. Evaluates the
  /// system at (t, y); may throw as its derivative() does.
  virtual void linearise(double t, const double* y, double* in, double* out) = 0;
};

}  // namespace seacrane
