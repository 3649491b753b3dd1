#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// Fehlberg 5(4) [Low-order classical Runge-Kutta formulas with stepsize
/// control, NASA TR R-315 (1969), table III], which goes on with the formula of
/// order 5; dense output of order 3 is the cubic Hermite polynomial of the step.
struct Fehlberg54 {
  static constexpr const char* name = "fehlberg54";
  static constexpr const char* kind = "explicit pair (Fehlberg)";
  static constexpr const char* purpose = "an example of what a new pair takes";
  static constexpr int order = 5, error_order = 4, dense_order = 3;
  static constexpr std::size_t stages = 6, extra_stages = 0;
  static constexpr long double a[7][6] = {
      {0},
      {1.0L / 4},
      {3.0L / 32, 9.0L / 32},
      {1932.0L / 2197, -7200.0L / 2197, 7296.0L / 2197},
      {439.0L / 216, -8, 3680.0L / 513, -845.0L / 4104},
      {-8.0L / 27, 2, -3544.0L / 2565, 1859.0L / 4104, -11.0L / 40},
      {16.0L / 135, 0, 6656.0L / 12825, 28561.0L / 56430, -9.0L / 50, 2.0L / 55}};
  static constexpr long double error[7] = {1.0L / 360, 0, -128.0L / 4275, -2197.0L / 75240, 1.0L / 50,
                                           2.0L / 55,  0};
  static constexpr long double dense[7][3] = {{1, 3 * a[6][0] - 2, 1 - 2 * a[6][0]},
                                              {0, 0, 0},
                                              {0, 3 * a[6][2], -2 * a[6][2]},
                                              {0, 3 * a[6][3], -2 * a[6][3]},
                                              {0, 3 * a[6][4], -2 * a[6][4]},
                                              {0, 3 * a[6][5], -2 * a[6][5]},
                                              {0, -1, 1}};
};

}  // namespace seacrane::tableaus
