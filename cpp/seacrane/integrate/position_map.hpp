#pragma once

#include <cstddef>

namespace seacrane {

/// Which components of a System's state are positions and how velocities move them: for methods that treat
/// the two apart.
class PositionMap {
 public:
  virtual ~PositionMap() = default;

  /// Number of leading components that are positions.
  virtual std::size_t position_size() const = 0;
  /// Moves the positions in y along the velocities in y for the time h, both held: rotations by the
  /// exponential.
  virtual void move(double h, double* y) = 0;
  /// Derivatives of the positions that move(h, y) leaves in the velocities of y, by columns: position_size()
  /// rows, a column for every other component. Returns false where there are none: differences then replace
  /// them.
  virtual bool move_jacobian(double h, const double* y, double* out) = 0;
};

}  // namespace seacrane
