#pragma once

#include "seacrane/math/types.hpp"

namespace seacrane {

/// Surge, sway (m, inertial axes) and yaw (rad) of a hull above a cut-off frequency w: the high-pass filter
/// s^2 (s + 2 w) / (s^3 + 2 w s^2 + 2 w^2 s + w^3) of each, driven by its rate. What it leaves follows a
/// steady drift without lag. Three states each, in the unit of the motion, which is the first of them.
struct FastMotion {
  static constexpr int states = 9;
  double cutoff = 0.0;  // rad/s

  template <class T>
  void rates(const Vec3<T>& velocity, const T* x, T* x_rate) const {
    for (int i = 0; i < 3; ++i, x += 3, x_rate += 3) {
      x_rate[0] = velocity[i] + cutoff * (x[1] - 2.0 * x[0]);
      x_rate[1] = 2.0 * velocity[i] + cutoff * (x[2] - 2.0 * x[0]);
      x_rate[2] = -cutoff * x[0];
    }
  }

  /// A velocity at the start is that of a steady drift: the fast motion is zero and stays it.
  void start(const Vec3d& velocity, double* x) const {
    for (int i = 0; i < 3; ++i, x += 3) {
      x[0] = 0.0;
      x[1] = -velocity[i] / cutoff;
      x[2] = -2.0 * velocity[i] / cutoff;
    }
  }

  static Vec3d of(const double* x) { return {x[0], x[3], x[6]}; }
};

}  // namespace seacrane
