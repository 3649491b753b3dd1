#pragma once

#include <cstddef>
#include <vector>

namespace seacrane {

/// Coefficients of a polynomial in z = h lambda, lowest power first.
using Polynomial = std::vector<long double>;

/// sum += factor z p
inline void add_times_z(Polynomial& sum, long double factor, const Polynomial& p) {
  for (std::size_t power = 0; power + 1 < sum.size(); ++power) sum[power + 1] += factor * p[power];
}

/// Stability polynomial of an explicit Runge-Kutta method: stage i is 1 + z sum_j a_ij stage_j, and the step
/// is the row after the last stage.
template <class Rows>
std::vector<double> polynomial_of(const Rows& a, std::size_t stages) {
  std::vector<Polynomial> stage;
  for (std::size_t i = 0; i <= stages; ++i) {
    Polynomial own(stages + 1, 0.0L);
    own[0] = 1.0L;
    for (std::size_t j = 0; j < i; ++j) add_times_z(own, a[i][j], stage[j]);
    stage.push_back(own);
  }
  return {stage.back().begin(), stage.back().end()};
}

}  // namespace seacrane
