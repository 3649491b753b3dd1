#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "seacrane/integrate/adaptive_step.hpp"
#include "seacrane/integrate/linear_combination.hpp"
#include "seacrane/integrate/stability_polynomial.hpp"
#include "seacrane/math/clones.hpp"

namespace seacrane {

/// An explicit Runge-Kutta pair with dense output, given by a tableau (see tableaus/): row i of `a` makes
/// stage i from the ones before; row `stages` holds the weights of the step, so that stage `stages` is the
/// derivative at its end; rows beyond belong to stages that only dense output needs, evaluated on the first
/// look into a step. `error` holds the weights minus the embedded ones. Dense output at t0 + s h is
///   y0 + h sum_j k_j (dense[j][0] s + dense[j][1] s^2 + ...).
template <class Tableau>
class EmbeddedPair final : public AdaptiveStep {
 public:
  static constexpr IntegratorProperties properties{.name = Tableau::name,
                                                   .kind = Tableau::kind,
                                                   .order = Tableau::order,
                                                   .error_order = Tableau::error_order,
                                                   .dense_order = Tableau::dense_order,
                                                   .lanes = true,
                                                   .purpose = Tableau::purpose};
  static std::vector<double> stability_polynomial() { return polynomial_of(Tableau::a, stages); }

  EmbeddedPair(const Problem& problem, const IntegratorOptions& options)
      : AdaptiveStep(properties, problem, options, estimate_power),
        stage_state_(size()),
        inner_((stages - 1) * size()),
        extra_(Tableau::extra_stages * size()) {}

  void interpolate(double t, double* y) const override;

 private:
  static constexpr std::size_t stages = Tableau::stages;
  static constexpr std::size_t all_stages = stages + 1 + Tableau::extra_stages;
  static constexpr bool two_estimates = requires { Tableau::low_order_error; };
  /// Two estimates of orders p and q < p are combined to one that falls like h^(2 p - q + 1).
  static constexpr int estimate_power = [] {
    if constexpr (two_estimates) return 2 * Tableau::error_order - Tableau::low_error_order + 1;
    return Tableau::error_order + 1;
  }();
  static constexpr bool error_needs_end = Tableau::error[stages] != 0.0L;

  template <std::size_t row>
  struct Stage {
    static constexpr double at(std::size_t j) { return static_cast<double>(Tableau::a[row][j]); }
  };
  struct Error {
    static constexpr double at(std::size_t j) { return static_cast<double>(Tableau::error[j]); }
  };
  struct LowOrderError {
    static constexpr double at(std::size_t j) { return static_cast<double>(Tableau::low_order_error[j]); }
  };

  static constexpr std::size_t degree = std::size(Tableau::dense[0]);
  static constexpr auto dense = [] {
    std::array<std::array<double, degree>, all_stages> rounded{};
    for (std::size_t j = 0; j < all_stages; ++j) {
      for (std::size_t p = 0; p < degree; ++p) rounded[j][p] = static_cast<double>(Tableau::dense[j][p]);
    }
    return rounded;
  }();

  template <std::size_t row>
  static constexpr double node() {
    long double sum = 0.0L;
    for (std::size_t j = 0; j < row; ++j) sum += Tableau::a[row][j];
    return static_cast<double>(sum);
  }

  using Slopes = std::array<const double*, all_stages>;
  Slopes slopes() const {
    Slopes k;
    k[0] = start_derivative_.data();
    for (std::size_t j = 1; j < stages; ++j) k[j] = inner_.data() + (j - 1) * size();
    k[stages] = end_derivative_.data();
    for (std::size_t j = stages + 1; j < all_stages; ++j) k[j] = extra_.data() + (j - stages - 1) * size();
    return k;
  }

  template <std::size_t row>
  bool inner_stage(double h, double t_end, const Slopes& k) {
    LinearCombination<Stage<row>, row>::add(size(), state_.data(), h, k, stage_state_.data());
    const double t = node<row>() == 1.0 ? t_end : time_ + node<row>() * h;
    return stage(t, stage_state_.data(), inner_.data() + (row - 1) * size());
  }
  template <std::size_t... row>
  bool inner_stages(double h, double t_end, const Slopes& k, std::index_sequence<row...>) {
    return (... && inner_stage<row + 1>(h, t_end, k));
  }
  template <std::size_t row>
  void extra_stage(double h, const Slopes& k) const {
    LinearCombination<Stage<row>, row>::add(size(), previous_state_.data(), h, k, stage_state_.data());
    double* const slope = extra_.data() + (row - stages - 1) * size();
    evaluate(previous_time_ + node<row>() * h, stage_state_.data(), slope);
    if (all_finite(slope, size())) return;
    fail(h, first_non_finite(slope, size()), "the derivative inside the step is not finite");
  }
  template <std::size_t... row>
  void extra_stages([[maybe_unused]] double h, const Slopes& k, std::index_sequence<row...>) const {
    (..., extra_stage<stages + 1 + row>(h, k));
    extra_known_ = true;
  }

  double combined(double h, double sum, double low) const {
    if (two_estimates && sum > 0.0) {
      // [Hairer, Norsett, Wanner I, II.10.17]
      return h * std::sqrt(norm_.inverse_count()) * sum / std::sqrt(sum + 0.01 * low);
    }
    return h * std::sqrt(sum * norm_.inverse_count());
  }
  template <std::size_t lanes>
  std::array<double, lanes> errors(double h, const Slopes& k) const;
  SEACRANE_CLONES("avx2")
  static void add_product(std::size_t n, double factor, const double* k, double* __restrict y) {
    for (std::size_t i = 0; i < n; ++i) y[i] += factor * k[i];
  }
  bool try_step(double h, double t_end) override;
  double error(double h) const override;
  std::size_t dominant_component(double h) const override;

  // Scratch; dense output, const to the caller, writes the extra stages on the first look into a step.
  mutable std::vector<double> stage_state_;
  std::vector<double> inner_;
  mutable std::vector<double> extra_;
  mutable bool extra_known_ = false;
};

template <class Tableau>
bool EmbeddedPair<Tableau>::try_step(double h, double t_end) {
  extra_known_ = false;
  const Slopes k = slopes();
  if (!inner_stages(h, t_end, k, std::make_index_sequence<stages - 1>())) return false;
  LinearCombination<Stage<stages>, stages>::add(size(), state_.data(), h, k, end_state_.data());
  if (!end_is_finite()) return false;
  end_derivative_known_ = error_needs_end;
  return !error_needs_end || stage(t_end, end_state_.data(), end_derivative_.data());
}

template <class Tableau>
template <std::size_t lanes>
SEACRANE_CLONES("avx2")
auto EmbeddedPair<Tableau>::errors(double h, const Slopes& k) const -> std::array<double, lanes> {
  const auto tolerance = [&](std::size_t i) {
    return norm_.tolerance(i, std::max(std::abs(state_[i]), std::abs(end_state_[i])));
  };
  std::array<double, lanes> sum{}, low{};
  for (std::size_t i = 0; i < size(); i += lanes) {
    for (std::size_t j = 0; j < lanes; ++j) {
      const double ratio = LinearCombination<Error, stages + 1>::slope(k, i + j) / tolerance(i + j);
      sum[j] += ratio * ratio;
      if constexpr (two_estimates) {
        const double low_ratio =
            LinearCombination<LowOrderError, stages + 1>::slope(k, i + j) / tolerance(i + j);
        low[j] += low_ratio * low_ratio;
      }
    }
  }
  for (std::size_t j = 0; j < lanes; ++j) sum[j] = combined(h, sum[j], low[j]);
  return sum;
}

template <class Tableau>
double EmbeddedPair<Tableau>::error(double h) const {
  const Slopes k = slopes();
  return norm_.largest([&]<std::size_t lanes>() { return errors<lanes>(h, k); });
}

template <class Tableau>
std::size_t EmbeddedPair<Tableau>::dominant_component(double) const {
  const Slopes k = slopes();
  std::size_t worst = 0;
  double largest = -1.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double slope = LinearCombination<Error, stages + 1>::slope(k, i);
    const double ratio = std::abs(slope) / norm_.tolerance(i, std::abs(state_[i]));
    if (ratio > largest) {
      largest = ratio;
      worst = i;
    }
  }
  return worst;
}

template <class Tableau>
void EmbeddedPair<Tableau>::interpolate(double t, double* y) const {
  t = inside_last_step(t);
  const std::size_t n = size();
  if (previous_time_ == time_) {
    std::copy_n(state_.data(), n, y);
    return;
  }
  if (t == time_) {
    std::copy_n(end_state_.data(), n, y);
    return;
  }
  const double h = time_ - previous_time_;
  const double s = (t - previous_time_) / h;
  const Slopes k = slopes();
  if (!extra_known_ && s > 0.0) extra_stages(h, k, std::make_index_sequence<Tableau::extra_stages>());
  std::copy_n(previous_state_.data(), n, y);
  for (std::size_t j = 0; j < all_stages; ++j) {
    double weight = 0.0;
    for (std::size_t p = degree; p-- > 0;) weight = s * (weight + dense[j][p]);
    if (weight == 0.0) continue;
    add_product(n, h * weight, k[j], y);
  }
}

}  // namespace seacrane
