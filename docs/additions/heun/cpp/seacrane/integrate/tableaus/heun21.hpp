#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// Heun 2(1), the trapezoidal rule with Euler's method inside; dense output of
/// order 2 is the cubic Hermite polynomial of the step.
struct Heun21 {
  static constexpr const char* name = "heun21";
  static constexpr const char* kind = "explicit pair (Heun, Euler)";
  static constexpr const char* purpose = "an example of what a new pair takes";
  static constexpr int order = 2, error_order = 1, dense_order = 2;
  static constexpr std::size_t stages = 2, extra_stages = 0;
  static constexpr long double a[3][2] = {{0}, {1}, {1.0L / 2, 1.0L / 2}};
  static constexpr long double error[3] = {-1.0L / 2, 1.0L / 2, 0};
  static constexpr long double dense[3][3] = {{1, -1.0L / 2, 0}, {0, 3.0L / 2, -1}, {0, -1, 1}};
};

}  // namespace seacrane::tableaus
