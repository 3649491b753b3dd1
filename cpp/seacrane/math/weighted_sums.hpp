#pragma once

#include <cstddef>
#include <cstring>

namespace seacrane {

/// out (q, width) = sum over n, in its order, of weights (q, n) times values: of shape (n, width), shared by
/// all q, or (q, n, width).
struct WeightedSums {
  std::size_t sums = 0, terms = 0, width = 0;
  bool shared = false;

  void evaluate(const double* weights, const double* values, double* out) const {
    for (std::size_t q = 0; q < sums; ++q, out += width, weights += terms) {
      const double* row = shared ? values : values + q * terms * width;
      std::size_t k = 0;
      for (; k + 2 * packs <= width; k += 2 * packs) add(weights, row + k, out + k);
      for (; k < width; ++k) {
        out[k] = 0.0;
        for (std::size_t n = 0; n < terms; ++n) out[k] += weights[n] * row[n * width + k];
      }
    }
  }

 private:
  // Two doubles in one register of every 64-bit processor; gcc and clang spell it alike.
  using Pack = double __attribute__((vector_size(16)));
  static constexpr std::size_t packs = 6;  // six complex numbers, whose sums stay in registers

  void add(const double* weights, const double* row, double* out) const {
    Pack sum[packs] = {}, value;
    for (std::size_t n = 0; n < terms; ++n, row += width) {
      for (std::size_t p = 0; p < packs; ++p) {
        std::memcpy(&value, row + 2 * p, sizeof(value));
        sum[p] += weights[n] * value;
      }
    }
    std::memcpy(out, sum, sizeof(sum));
  }
};

}  // namespace seacrane
