#include "seacrane/integrate/error_norm.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/math/clones.hpp"

namespace seacrane {
namespace {

std::vector<double> spread(const std::vector<double>& absolute, std::size_t size) {
  if (absolute.size() == size) return absolute;
  if (absolute.size() == 1) return std::vector<double>(size, absolute.front());
  throw std::invalid_argument("absolute_tolerance holds " + std::to_string(absolute.size()) +
                              " values; give one, or one for each of the " + std::to_string(size) +
                              " state components");
}

}  // namespace

ErrorNorm::ErrorNorm(const Tolerances& tolerances, std::size_t size)
    : relative_(tolerances.relative),
      absolute_(spread(tolerances.absolute, size)),
      growth_(size, tolerances.relative),
      lanes_(tolerances.lanes) {
  if (!(lanes_ == 1 || lanes_ == 4 || lanes_ == 8) || size % lanes_ != 0) {
    throw std::invalid_argument("lanes is " + std::to_string(lanes_) + "; give 1, 4 or 8");
  }
  if (!(relative_ >= 0.0 && relative_ < 1.0)) {
    throw std::invalid_argument("relative_tolerance is " + std::to_string(relative_) +
                                "; give a value from 0 to below 1");
  }
  if (!tolerances.growth.empty() && tolerances.growth.size() != size) {
    throw std::invalid_argument("growth holds " + std::to_string(tolerances.growth.size()) +
                                " values; give none, or one for each of the " + std::to_string(size) +
                                " state components");
  }
  for (std::size_t i = 0; i < tolerances.growth.size(); ++i) growth_[i] += tolerances.growth[i];
  std::size_t included = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (!(absolute_[i] > 0.0)) {
      throw std::invalid_argument("absolute_tolerance of state component " + std::to_string(i) + " is " +
                                  std::to_string(absolute_[i]) +
                                  "; give a positive value, infinity to leave the component out");
    }
    if (std::isfinite(absolute_[i])) ++included;
  }
  if (included == 0) {
    throw std::invalid_argument("absolute_tolerance leaves every state component out of the error norm");
  }
  inverse_count_ = static_cast<double>(lanes_) / static_cast<double>(included);
  weight_scale_ = std::sqrt(static_cast<double>(size) * inverse_count_);
}

/// Sums the squared ratios of all components, by lane.
template <std::size_t lanes, class Ratio>
SEACRANE_CLONES("avx2")
std::array<double, lanes> ErrorNorm::sums(const Ratio& ratio) const {
  std::array<double, lanes> out{};
  for (std::size_t i = 0; i < absolute_.size(); i += lanes) {
    for (std::size_t j = 0; j < lanes; ++j) {
      const double one = ratio(i + j);
      out[j] += one * one;
    }
  }
  return out;
}

template <class Ratio>
double ErrorNorm::root_mean_square(const Ratio& ratio) const {
  return std::sqrt(largest([&]<std::size_t lanes>() { return sums<lanes>(ratio); }) * inverse_count_);
}

template <class Ratio>
ErrorNorm::Lanes ErrorNorm::root_mean_squares(const Ratio& ratio) const {
  Lanes out{};
  largest([&]<std::size_t lanes>() {
    const std::array<double, lanes> found = sums<lanes>(ratio);
    for (std::size_t j = 0; j < lanes; ++j) out[j] = std::sqrt(found[j] * inverse_count_);
    return found;
  });
  return out;
}

double ErrorNorm::norm(const double* vector, const double* y) const {
  return root_mean_square([&](std::size_t i) { return vector[i] / tolerance(i, std::abs(y[i])); });
}

ErrorNorm::Lanes ErrorNorm::norms(const double* vector, const double* y) const {
  return root_mean_squares([&](std::size_t i) { return vector[i] / tolerance(i, std::abs(y[i])); });
}

double ErrorNorm::over_tolerances(const double* y) const {
  return root_mean_square([&](std::size_t i) { return y[i] / (absolute_[i] + growth_[i] * std::abs(y[i])); });
}

double ErrorNorm::distance(const double* a, const double* b) const {
  return root_mean_square([&](std::size_t i) { return (a[i] - b[i]) / tolerance(i, std::abs(a[i])); });
}

ErrorNorm::Lanes ErrorNorm::distances(const double* a, const double* b) const {
  return root_mean_squares([&](std::size_t i) { return (a[i] - b[i]) / tolerance(i, std::abs(a[i])); });
}

void ErrorNorm::weights(const double* y, double* w) const {
  for (std::size_t i = 0; i < absolute_.size(); ++i) {
    w[i] = weight_scale_ / tolerance(i, std::abs(y[i]));
  }
}

double ErrorNorm::typical(std::size_t i) const {
  // An absolute tolerance is usually chosen as the relative one times the size that matters.
  if (!std::isfinite(absolute_[i]) || relative_ == 0.0) return 1.0;
  return absolute_[i] / relative_;
}

SEACRANE_CLONES("avx2") bool all_finite(const double* values, std::size_t size) {
  // 0 * x is 0 for finite x and NaN otherwise; independent sums let the compiler use vector registers.
  constexpr std::size_t sums = 16;
  double sum[sums] = {}, total = 0.0;
  std::size_t i = 0;
  for (; i + sums <= size; i += sums) {
    for (std::size_t j = 0; j < sums; ++j) sum[j] += 0.0 * values[i + j];
  }
  for (; i < size; ++i) total += 0.0 * values[i];
  for (const double one : sum) total += one;
  return total == 0.0;
}

std::size_t first_non_finite(const double* values, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    if (!std::isfinite(values[i])) return i;
  }
  return IntegrationError::no_component;
}

}  // namespace seacrane
