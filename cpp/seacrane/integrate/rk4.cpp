#include <algorithm>
#include <cmath>
#include <numbers>

#include "seacrane/integrate/one_step.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// Step without a choice of the user (s): well inside the 0.15 s or so at which the modes of a crane's
/// controlled cylinders make the method unstable.
constexpr double default_step = 0.02;

/// The classical Runge-Kutta method of order 4 with a fixed step [Hairer, Norsett, Wanner, Solving
/// Ordinary Differential Equations I, II.1]. Four evaluations a step: the one at the end of a step is the
/// first of the next.
///
/// Dense output of order 4, matching the method's, is a quartic: the cubic Hermite polynomial of the step,
/// corrected so that its slope at one inner point is the system's there (evaluated on the cubic, whose
/// error there is O(h^4), which makes the quartic's O(h^5)). That evaluation is made once, and only for a
/// step somebody looks into.
class ClassicalRungeKutta final : public OneStepIntegrator {
 public:
  ClassicalRungeKutta(System& system, const IntegratorOptions& options)
      : OneStepIntegrator("rk4", system, options),
        length_(options.fixed_step > 0.0 ? options.fixed_step : default_step),
        stage_state_(size()),
        k2_(size()),
        k3_(size()),
        k4_(size()),
        inner_state_(size()),
        quartic_(size()) {
    if (options.max_step > 0.0) length_ = std::min(length_, options.max_step);
  }

  int order() const override { return 4; }
  bool is_adaptive() const override { return false; }
  void step(double t_limit) override;
  void interpolate(double t, double* y) const override;

 private:
  void stage(double c, double h, const std::vector<double>& slope, std::vector<double>& k);
  void require_finite(double h, const std::vector<double>& values) const;
  double cubic(std::size_t i, double s, double h) const;
  void find_quartic() const;

  double length_;
  std::vector<double> stage_state_, k2_, k3_, k4_;
  // Filled on the first look into a step.
  mutable std::vector<double> inner_state_, quartic_;
  mutable bool quartic_known_ = false;
};

void ClassicalRungeKutta::require_finite(double h, const std::vector<double>& values) const {
  if (all_finite(values.data(), size())) return;
  fail(h, first_non_finite(values.data(), size()), "the solution is not finite; take a shorter fixed step");
}

/// k = f(t + c h, y + c h slope)
void ClassicalRungeKutta::stage(double c, double h, const std::vector<double>& slope,
                                std::vector<double>& k) {
  const std::size_t n = size();
  for (std::size_t i = 0; i < n; ++i) stage_state_[i] = state_[i] + c * h * slope[i];
  evaluate(time_ + c * h, stage_state_.data(), k.data());
  require_finite(h, k);
}

void ClassicalRungeKutta::step(double t_limit) {
  check_limit(t_limit);
  if (t_limit == time_) return;
  begin_step();
  quartic_known_ = false;
  const double remaining = t_limit - time_;
  const double h = limited_step(length_, remaining);
  const double t_end = h == remaining ? t_limit : time_ + h;
  stage(0.5, h, start_derivative_, k2_);
  stage(0.5, h, k2_, k3_);
  stage(1.0, h, k3_, k4_);
  const std::size_t n = size();
  for (std::size_t i = 0; i < n; ++i) {
    end_state_[i] = state_[i] + h / 6.0 * (start_derivative_[i] + 2.0 * (k2_[i] + k3_[i]) + k4_[i]);
  }
  require_finite(h, end_state_);
  evaluate(t_end, end_state_.data(), end_derivative_.data());
  require_finite(h, end_derivative_);
  accept(t_end);
}

/// Cubic Hermite polynomial at t0 + s h [Hairer, Norsett, Wanner I, II.6.7].
double ClassicalRungeKutta::cubic(std::size_t i, double s, double h) const {
  const double rise = end_state_[i] - previous_state_[i];
  const double bend =
      (1.0 - 2.0 * s) * rise + h * ((s - 1.0) * start_derivative_[i] + s * end_derivative_[i]);
  return previous_state_[i] + s * (rise + (s - 1.0) * bend);
}

void ClassicalRungeKutta::find_quartic() const {
  // Here s^2 (1-s)^2, which changes neither values nor slopes at the ends, is steepest.
  const double s = 0.5 - std::numbers::sqrt3 / 6.0;
  const double steepest = std::numbers::sqrt3 / 9.0;
  const double h = time_ - previous_time_;
  const std::size_t n = size();
  for (std::size_t i = 0; i < n; ++i) inner_state_[i] = cubic(i, s, h);
  evaluate(previous_time_ + s * h, inner_state_.data(), quartic_.data());
  if (!all_finite(quartic_.data(), n)) {
    fail(h, first_non_finite(quartic_.data(), n), "the derivative inside the step is not finite");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double rise = end_state_[i] - previous_state_[i];
    // Slope of the cubic at this s, where 6 s (1 - s) = 1 and 3 s^2 = 3 s - 1/2.
    const double slope = rise + h * ((0.5 - s) * start_derivative_[i] + (s - 0.5) * end_derivative_[i]);
    quartic_[i] = (h * quartic_[i] - slope) / steepest;
  }
  quartic_known_ = true;
}

void ClassicalRungeKutta::interpolate(double t, double* y) const {
  t = inside_last_step(t);
  const std::size_t n = size();
  if (previous_time_ == time_) {
    std::copy_n(state_.data(), n, y);
    return;
  }
  const double h = time_ - previous_time_;
  const double s = (t - previous_time_) / h;
  if (!quartic_known_ && s > 0.0 && s < 1.0) find_quartic();
  const double hump = quartic_known_ ? s * s * (1.0 - s) * (1.0 - s) : 0.0;
  for (std::size_t i = 0; i < n; ++i) y[i] = cubic(i, s, h) + hump * quartic_[i];
}

}  // namespace

std::unique_ptr<Integrator> make_rk4(System& system, ResidualSystem* /*residual*/,
                                     const IntegratorOptions& options) {
  return std::make_unique<ClassicalRungeKutta>(system, options);
}

}  // namespace seacrane
