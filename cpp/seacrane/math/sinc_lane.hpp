#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace seacrane {

/// sin x / x from y = x^2 <= pi^2, and its derivative in y: Taylor polynomial whose first omitted term is
/// pi^28 / 29! = 1e-17. Without branches, so that a loop over it becomes SIMD code.
template <class T>
void sinc_lane(const T& y, T& out, T& slope) {
  constexpr std::size_t count = 14;
  constexpr std::array<double, count> coefficient = [] {
    std::array<double, count> c{};
    double factorial = 1.0;
    for (std::size_t n = 0; n < count; ++n) {
      c[n] = (n % 2 == 0 ? 1.0 : -1.0) / factorial;
      factorial *= static_cast<double>((2 * n + 2) * (2 * n + 3));
    }
    return c;
  }();
  T sum = y * 0.0 + coefficient[count - 1], rise = y * 0.0;
  for (std::size_t n = count - 1; n-- > 0;) {
    rise = y * rise + sum;
    sum = y * sum + coefficient[n];
  }
  out = sum;
  slope = rise;
}
template <class T>
void sinc_lane(const T& y, T& out) {
  T slope;
  sinc_lane(y, out, slope);
}

inline constexpr double sinc_end = std::numbers::pi * std::numbers::pi;  // of its main lobe, in x^2

}  // namespace seacrane
