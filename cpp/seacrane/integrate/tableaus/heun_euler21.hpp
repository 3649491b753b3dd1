#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// Heun's method with Euler's embedded [Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I,
/// II.1]; dense output is the quadratic of order 2 through both slopes.
struct HeunEuler21 {
  static constexpr const char* name = "heun21";
  static constexpr int order = 2, error_order = 1, dense_order = 2;
  static constexpr std::size_t stages = 2, extra_stages = 0;
  static constexpr long double a[3][2] = {{0}, {1}, {0.5L, 0.5L}};
  static constexpr long double error[3] = {-0.5L, 0.5L};
  static constexpr long double dense[3][2] = {{1, -0.5L}, {0, 0.5L}, {0}};
};

}  // namespace seacrane::tableaus
