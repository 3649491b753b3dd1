#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// Five-stage method of order 4 in two registers [M. H. Carpenter, C. A. Kennedy, Fourth-order 2N-storage
/// Runge-Kutta schemes, NASA TM 109112 (1994), solution 3]: du := a_i du + h f(t + c_i h, u), u := u + b_i
/// du.
struct CarpenterKennedy {
  static constexpr int order = 4;
  static constexpr std::size_t stages = 5;
  static constexpr long double a[5] = {0, -567301805773.0L / 1357537059087, -2404267990393.0L / 2016746695238,
                                       -3550918686646.0L / 2091501179385, -1275806237668.0L / 842570457699};
  static constexpr long double b[5] = {1432997174477.0L / 9575080441755, 5161836677717.0L / 13612068292357,
                                       1720146321549.0L / 2090206949498, 3134564353537.0L / 4481467310338,
                                       2277821191437.0L / 14882151754819};
  static constexpr long double c[5] = {0, 1432997174477.0L / 9575080441755, 2526269341429.0L / 6820363962896,
                                       2006345519317.0L / 3224310063776, 2802321613138.0L / 2924317926251};
};

}  // namespace seacrane::tableaus
