#pragma once

#include <cstddef>

namespace seacrane {

/// Rows of weights of a cubic spline, one for each place, over `values` columns.
struct SplineWeights {
  std::size_t places = 0, values = 0;
  const double* curvature = nullptr;  // (knots, values): from values to second derivatives at the knots

  /// Each place: the knot before it, its shares of the values and of the second derivatives at that knot and
  /// at the next; `column` tells the value that belongs to a knot.
  void evaluate(const std::ptrdiff_t* knot, const std::ptrdiff_t* column, const double* left,
                const double* right, const double* bend_left, const double* bend_right, double* out) const {
    for (std::size_t q = 0; q < places; ++q, out += values) {
      const auto i = static_cast<std::size_t>(knot[q]);
      const double *before = curvature + i * values, *after = before + values;
      for (std::size_t n = 0; n < values; ++n) out[n] = before[n] * bend_left[q];
      out[column[i]] += left[q];
      out[column[i + 1]] += right[q];
      for (std::size_t n = 0; n < values; ++n) out[n] += after[n] * bend_right[q];
    }
  }
};

}  // namespace seacrane
