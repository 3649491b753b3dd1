#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "seacrane/math/clones.hpp"

namespace seacrane {

/// y + h sum_j weight_j k_j over whole vectors in one loop. `Weights::at(j)` are constants: the zero ones
/// cost nothing, and the compiler sees one straight expression, as if it had been written out by hand.
template <class Weights, std::size_t count>
class LinearCombination {
  static constexpr std::size_t nonzeros = [] {
    std::size_t n = 0;
    for (std::size_t j = 0; j < count; ++j) n += Weights::at(j) != 0.0;
    return n;
  }();
  static constexpr std::array<std::size_t, nonzeros> index = [] {
    std::array<std::size_t, nonzeros> found{};
    std::size_t n = 0;
    for (std::size_t j = 0; j < count; ++j) {
      if (Weights::at(j) != 0.0) found[n++] = j;
    }
    return found;
  }();

  template <class Slopes, std::size_t... J>
  static double sum(const Slopes& k, std::size_t i, std::index_sequence<J...>) {
    return (... + (Weights::at(index[J]) * k[index[J]][i]));
  }

 public:
  /// z = y + h sum, for n components; z overlaps nothing.
  template <class Slopes>
  SEACRANE_CLONES("avx2")
  static void add(std::size_t n, const double* y, double h, const Slopes& k, double* __restrict z) {
    for (std::size_t i = 0; i < n; ++i) z[i] = y[i] + h * slope(k, i);
  }
  /// The sum for component i.
  template <class Slopes>
  static double slope(const Slopes& k, std::size_t i) {
    return sum(k, i, std::make_index_sequence<nonzeros>());
  }
};

}  // namespace seacrane
