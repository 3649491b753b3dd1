#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// Bogacki and Shampine 3(2), first-same-as-last [A 3(2) pair of Runge-Kutta formulas, Appl. Math. Lett. 2
/// (1989) 321]; dense output of order 3 is the cubic Hermite polynomial of the step.
struct BogackiShampine32 {
  static constexpr const char* name = "bs32";
  static constexpr const char* kind = "explicit pair (Bogacki, Shampine)";
  static constexpr const char* purpose = "the pair of lowest order: loose tolerances";
  static constexpr int order = 3, error_order = 2, dense_order = 3;
  static constexpr std::size_t stages = 3, extra_stages = 0;
  static constexpr long double a[4][3] = {{0}, {1.0L / 2}, {0, 3.0L / 4}, {2.0L / 9, 1.0L / 3, 4.0L / 9}};
  static constexpr long double error[4] = {-5.0L / 72, 1.0L / 12, 1.0L / 9, -1.0L / 8};
  static constexpr long double dense[4][3] = {
      {1, -4.0L / 3, 5.0L / 9}, {0, 1, -2.0L / 3}, {0, 4.0L / 3, -8.0L / 9}, {0, -1, 1}};
};

}  // namespace seacrane::tableaus
