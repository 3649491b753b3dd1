#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace seacrane {

/// Which of the rows of magnitudes (rows, columns) are kept where the smallest are left out, as long as their
/// shares of each column sum to no more than `limit`. All, where one is not finite; always at least one.
inline std::vector<char> kept_components(const double* magnitudes, std::size_t rows, std::size_t columns,
                                         double limit) {
  std::vector<char> kept(rows, 1);
  const double* const end = magnitudes + rows * columns;
  if (rows < 2 || !std::all_of(magnitudes, end, [](double m) { return std::isfinite(m); })) return kept;
  std::vector<double> whole(columns, 0.0), share(rows * columns), largest(rows, 0.0), left_out(columns, 0.0);
  const auto each = [&](const auto& use) {
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < columns; ++j) use(i, j, i * columns + j);
    }
  };
  each([&](std::size_t, std::size_t j, std::size_t k) { whole[j] += magnitudes[k]; });
  each([&](std::size_t i, std::size_t j, std::size_t k) {
    share[k] = whole[j] > 0.0 ? magnitudes[k] / whole[j] : 0.0;
    largest[i] = std::max(largest[i], share[k]);
  });
  std::vector<std::size_t> order(rows);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return largest[a] < largest[b]; });
  for (std::size_t place = 0; place + 1 < rows; ++place) {
    double most = 0.0;
    for (std::size_t j = 0; j < columns; ++j) {
      left_out[j] += share[order[place] * columns + j];
      most = std::max(most, left_out[j]);
    }
    if (!(most <= limit)) break;
    kept[order[place]] = 0;
  }
  return kept;
}

}  // namespace seacrane
