#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "seacrane/integrate/adaptive_step.hpp"
#include "seacrane/integrate/difference_jacobian.hpp"
#include "seacrane/integrate/registration.hpp"
#include "seacrane/integrate/sparse_lu.hpp"
#include "seacrane/integrate/tableaus/rang_angermann34.hpp"

namespace seacrane {
namespace {

/// Accepted steps with one Jacobian.
constexpr int steps_per_jacobian = 20;
/// Share of the derivative's change over a step beyond which the Jacobian is said not to describe it.
constexpr double misled = 0.5;
/// A step is not lengthened by less: its factors would be lost for little.
constexpr double least_growth_rosenbrock = 1.3;

/// Linearly implicit Runge-Kutta (Rosenbrock W) method of order 3(2). Stage i solves
///   (I - h gamma J) k_i = f(t + alpha_i h, y + h sum a_ij k_j) + h J sum gamma_ij k_j,
/// written with u_i = k_i + s_i, s_i = sum (gamma_ij / gamma) k_j, so that no product with J is needed:
///   (I - h gamma J) u_i = f + s_i.
/// The order holds for any J, also with no derivative in time [Hairer, Wanner II, IV.7], so that difference
/// quotients and a Jacobian of some steps before do. Dense output is the cubic Hermite polynomial of the
/// step.
class RosenbrockW final : public AdaptiveStep {
 public:
  static constexpr IntegratorProperties properties{
      .name = "rosenbrock",
      .kind = "linearly implicit, L-stable (Rang, Angermann)",
      .order = 3,
      .error_order = 2,
      .dense_order = 3,
      .uses_jacobian = true,
      .purpose = "stiff elements at loose tolerances; restarts at limits and kinks cost it little"};

  RosenbrockW(const Problem& problem, const IntegratorOptions& options)
      : AdaptiveStep(properties, problem, options, 3),
        stage_state_(size()),
        sum_(size()),
        slope_(size()),
        jacobian_(size() * size()),
        lu_(size()) {
    for (auto& k : k_) k.resize(size());
  }

  void init(double t0, const double* y0) override {
    AdaptiveStep::init(t0, y0);
    forget();
  }
  void reset(double t, const double* y) override {
    AdaptiveStep::reset(t, y);
    forget();
  }
  void interpolate(double t, double* y) const override;

 private:
  using Scheme = tableaus::RangAngermann34;

  bool try_step(double h, double t_end) override;
  double error(double h) const override;
  std::size_t dominant_component(double h) const override;
  bool has_leapt(double h) override;
  bool is_misled(double h, const double* change);
  double preferred_step(double h, double wish) const override {
    return wish >= h && wish < least_growth_rosenbrock * h ? h : wish;
  }

  std::size_t history_size() const override { return 2 + jacobian_.size(); }
  void save_history(std::span<double> history) const override;
  void load_history(std::span<const double> history) override;

  void forget() {
    age_ = steps_per_jacobian;
    factored_step_ = 0.0;
  }
  bool refresh_jacobian(double h);
  bool factor(double h);
  double error_slope(std::size_t i) const;

  std::vector<double> stage_state_, sum_, slope_;
  std::array<std::vector<double>, Scheme::stages> k_;
  std::vector<double> jacobian_;  // by columns
  SparseLu lu_;
  int age_ = steps_per_jacobian;
  double factored_step_ = 0.0;
  /// Start and end of the last try: a second one from the same state has been rejected.
  double tried_time_ = 0.0, end_time_ = 0.0;
  bool tried_ = false;
};

bool RosenbrockW::refresh_jacobian(double h) {
  ++counters_.jacobians;
  // An exception on the way leaves neither.
  forget();
  if (exact_jacobian(system_, time_, state_.data(), jacobian_.data(), counters_)) {
    age_ = 0;
    return true;
  }
  // The derivative kept from the last step may belong to a state some projection away: no base for
  // differences.
  double* const base = end_derivative_.data();
  if (!stage(time_, state_.data(), base)) return false;
  const auto f = [&](const double* y, double* ydot) { return stage(time_, y, ydot) ? 0 : 1; };
  const int flag = difference_jacobian(state_.data(), base, h, norm_, stage_state_, slope_, f,
                                       [&](std::size_t j) { return jacobian_.data() + j * size(); });
  if (flag == 0) age_ = 0;
  return flag == 0;
}

bool RosenbrockW::factor(double h) {
  const double scale = -h * Scheme::gamma;
  for (std::size_t j = 0; j < size(); ++j) {
    double* const column = lu_.column(j);
    const double* const from = jacobian_.data() + j * size();
    for (std::size_t i = 0; i < size(); ++i) column[i] = scale * from[i];
    column[j] += 1.0;
  }
  factored_step_ = lu_.factor() ? h : 0.0;
  return factored_step_ > 0.0;
}

bool RosenbrockW::try_step(double h, double t_end) {
  const bool again = tried_ && tried_time_ == time_;
  tried_ = true;
  tried_time_ = time_;
  end_time_ = t_end;
  if (!again) ++age_;
  const bool stale = age_ > steps_per_jacobian || (again && age_ > 0);
  if (stale && !refresh_jacobian(h)) return false;
  if (h != factored_step_ && !factor(h)) return false;
  const std::size_t n = size();
  for (std::size_t s = 0; s < Scheme::stages; ++s) {
    double node = 0.0;
    std::copy_n(state_.data(), n, stage_state_.data());
    std::fill(sum_.begin(), sum_.end(), 0.0);
    for (std::size_t j = 0; j < s; ++j) {
      const double a = Scheme::a[s][j], c = Scheme::coupling[s][j] / Scheme::gamma;
      node += a;
      const double* const k = k_[j].data();
      for (std::size_t i = 0; i < n; ++i) {
        stage_state_[i] += h * a * k[i];
        sum_[i] += c * k[i];
      }
    }
    double* const k = k_[s].data();
    if (s == 0) {
      std::copy_n(start_derivative_.data(), n, k);
    } else if (!stage(node == 1.0 ? t_end : time_ + node * h, stage_state_.data(), k)) {
      return false;
    }
    for (std::size_t i = 0; i < n; ++i) k[i] += sum_[i];
    lu_.solve(k);
    for (std::size_t i = 0; i < n; ++i) k[i] -= sum_[i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    end_state_[i] = state_[i] + h * (Scheme::b[0] * k_[0][i] + Scheme::b[1] * k_[1][i] +
                                     Scheme::b[2] * k_[2][i] + Scheme::b[3] * k_[3][i]);
  }
  if (!end_is_finite()) return false;
  // The end derivative comes last: projection may start from it.
  return error(h) > 1.0 || stage(t_end, state_.data(), slope_.data());
}

/// A Jacobian that is too stiff, of a stop that the body has left, holds all stages still: the error estimate
/// is small, and so is the motion. What the state's change did to the derivative tells, against what J says
/// of it.
///
/// Where the scene is as stiff as J says, the least curvature of the motion sets them apart as well: a line
/// that turns stretches by the square of its way. So the derivative is asked again, over the correction that
/// J makes of what it missed. Where J is right, it answers as J says.
bool RosenbrockW::has_leapt(double h) {
  if (AdaptiveStep::has_leapt(h)) return true;
  const std::size_t n = size();
  double* const change = stage_state_.data();
  for (std::size_t i = 0; i < n; ++i) {
    change[i] = end_state_[i] - state_[i];
    slope_[i] = end_derivative_[i] - slope_[i];
  }
  if (!is_misled(h, change)) return false;
  for (std::size_t i = 0; i < n; ++i) change[i] = h * slope_[i];
  lu_.solve(change);
  for (std::size_t i = 0; i < n; ++i) sum_[i] = end_state_[i] + change[i];
  if (!stage(end_time_, sum_.data(), slope_.data())) return true;
  for (std::size_t i = 0; i < n; ++i) slope_[i] -= end_derivative_[i];
  // Projection starts from what was evaluated last: that is the end again.
  return is_misled(h, change) || !stage(end_time_, end_state_.data(), end_derivative_.data());
}

/// Whether J does not tell how a change of the state changed the derivative, slope_. Leaves in slope_ what J
/// missed.
bool RosenbrockW::is_misled(double h, const double* change) {
  const std::size_t n = size();
  std::fill(sum_.begin(), sum_.end(), 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    const double* const column = jacobian_.data() + j * n;
    for (std::size_t i = 0; i < n; ++i) sum_[i] += column[i] * change[j];
  }
  const auto size_of = [this](const std::vector<double>& s) { return norm_.norm(s.data(), state_.data()); };
  const double both = size_of(slope_) + size_of(sum_);
  for (std::size_t i = 0; i < n; ++i) slope_[i] -= sum_[i];
  const double apart = size_of(slope_);
  return h * apart > 1.0 && apart > misled * both;
}

double RosenbrockW::error_slope(std::size_t i) const {
  double slope = 0.0;
  for (std::size_t s = 0; s < Scheme::stages; ++s) slope += (Scheme::b[s] - Scheme::embedded[s]) * k_[s][i];
  return slope;
}

double RosenbrockW::error(double h) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double size_of_state = std::max(std::abs(state_[i]), std::abs(end_state_[i]));
    const double ratio = error_slope(i) / norm_.tolerance(i, size_of_state);
    sum += ratio * ratio;
  }
  return h * std::sqrt(sum * norm_.inverse_count());
}

std::size_t RosenbrockW::dominant_component(double) const {
  const auto ratio = [&](std::size_t i) {
    return std::abs(error_slope(i)) / norm_.tolerance(i, std::abs(state_[i]));
  };
  std::size_t worst = 0;
  for (std::size_t i = 1; i < size(); ++i) {
    if (ratio(i) > ratio(worst)) worst = i;
  }
  return worst;
}

void RosenbrockW::interpolate(double t, double* y) const {
  t = inside_last_step(t);
  if (previous_time_ == time_) {
    std::copy_n(state_.data(), size(), y);
    return;
  }
  const double h = time_ - previous_time_;
  const double s = (t - previous_time_) / h;
  for (std::size_t i = 0; i < size(); ++i) {
    y[i] =
        cubic_hermite(previous_state_[i], end_state_[i], h * start_derivative_[i], h * end_derivative_[i], s);
  }
}

void RosenbrockW::save_history(std::span<double> history) const {
  history[0] = age_;
  history[1] = factored_step_;
  std::copy(jacobian_.begin(), jacobian_.end(), history.begin() + 2);
}

void RosenbrockW::load_history(std::span<const double> history) {
  age_ = static_cast<int>(history[0]);
  std::copy(history.begin() + 2, history.end(), jacobian_.begin());
  factored_step_ = 0.0;
  if (history[1] > 0.0) factor(history[1]);
  tried_ = false;
}

}  // namespace

extern const Registration rosenbrock = registration<RosenbrockW>();

}  // namespace seacrane
