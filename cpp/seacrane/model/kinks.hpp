#pragma once

#include <array>

namespace seacrane {

/// A time at which one curve of one element is not smooth, and what that is worth. Entry p: jump of a
/// derivative of the velocities' rates, of order p - 1, over the scale of the state where it is largest,
/// 1/s^p; entry 0: of the velocities themselves.
struct Kink {
  double time = 0.0;
  /// Time over which its neighbours in the same curve are apart, s, halved; infinity for the first and last.
  double span = 0.0;
  std::array<double, 4> jump{};
  /// What jumps beyond the mean of the neighbours: little where samples of something smooth stand close.
  std::array<double, 4> alone{};

  /// Whether a step of length h over it may err by more than a tolerance (over the scales): by more than
  /// jump h^p / p!. Of kinks closer than h, a step sees the curve that they follow: then h counts for what is
  /// not their neighbours', and for all of the jump a quarter of their span, which is what is left of them as
  /// a ripple. Where a stop costs `lost` steps, kinks closer than these are left to the step control but for
  /// jumps of velocity or acceleration.
  bool matters(double h, double tolerance, double lost) const;
};

}  // namespace seacrane
