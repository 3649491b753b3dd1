#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// Cash and Karp 5(4) [A variable order Runge-Kutta method for initial value
/// problems with rapidly varying right-hand sides, ACM Trans. Math. Softw. 16
/// (1990) 201]; dense output of order 3 is the cubic Hermite polynomial of the
/// step.
struct CashKarp54 {
  static constexpr const char* name = "cash-karp54";
  static constexpr const char* kind = "explicit pair (Cash, Karp)";
  static constexpr const char* purpose = "an example of what a new pair takes";
  static constexpr int order = 5, error_order = 4, dense_order = 3;
  static constexpr std::size_t stages = 6, extra_stages = 0;
  static constexpr long double a[7][6] = {
      {0},
      {1.0L / 5},
      {3.0L / 40, 9.0L / 40},
      {3.0L / 10, -9.0L / 10, 6.0L / 5},
      {-11.0L / 54, 5.0L / 2, -70.0L / 27, 35.0L / 27},
      {1631.0L / 55296, 175.0L / 512, 575.0L / 13824, 44275.0L / 110592, 253.0L / 4096},
      {37.0L / 378, 0, 250.0L / 621, 125.0L / 594, 0, 512.0L / 1771}};
  static constexpr long double error[7] = {37.0L / 378 - 2825.0L / 27648,
                                           0,
                                           250.0L / 621 - 18575.0L / 48384,
                                           125.0L / 594 - 13525.0L / 55296,
                                           -277.0L / 14336,
                                           512.0L / 1771 - 1.0L / 4,
                                           0};
  static constexpr long double dense[7][3] = {{1, 3 * a[6][0] - 2, 1 - 2 * a[6][0]},
                                              {0, 0, 0},
                                              {0, 3 * a[6][2], -2 * a[6][2]},
                                              {0, 3 * a[6][3], -2 * a[6][3]},
                                              {0, 0, 0},
                                              {0, 3 * a[6][5], -2 * a[6][5]},
                                              {0, -1, 1}};
};

}  // namespace seacrane::tableaus
