#pragma once

#include <cstddef>

namespace seacrane {

/// out (q, width) = sum over n, in its order, of weights (q, n) times values: of shape (n, width), shared by
/// all q, or (q, n, width).
struct WeightedSums {
  std::size_t sums = 0, terms = 0, width = 0;
  bool shared = false;

  void evaluate(const double* weights, const double* values, double* out) const {
    for (std::size_t q = 0; q < sums; ++q, out += width, weights += terms) {
      const double* row = shared ? values : values + q * terms * width;
      for (std::size_t k = 0; k < width; ++k) out[k] = 0.0;
      for (std::size_t n = 0; n < terms; ++n, row += width) {
        for (std::size_t k = 0; k < width; ++k) out[k] += weights[n] * row[k];
      }
    }
  }
};

}  // namespace seacrane
