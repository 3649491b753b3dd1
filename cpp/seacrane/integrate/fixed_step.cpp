#include "seacrane/integrate/fixed_step.hpp"

#include <algorithm>
#include <numbers>

namespace seacrane {

FixedStep::FixedStep(const IntegratorProperties& properties, const Problem& problem,
                     const IntegratorOptions& options)
    : OneStepIntegrator(properties, problem, options),
      length_(options.fixed_step > 0.0 ? options.fixed_step : properties.default_step),
      inner_state_(size()),
      quartic_(size()) {
  if (options.max_step > 0.0) length_ = std::min(length_, options.max_step);
}

void FixedStep::require_finite(double h, const std::vector<double>& values) const {
  if (all_finite(values.data(), size())) return;
  fail(h, first_non_finite(values.data(), size()), "the solution is not finite; take a shorter fixed step");
}

void FixedStep::step(double t_limit) {
  check_limit(t_limit);
  if (t_limit == time_) return;
  if (length_ < smallest_step(time_)) {
    fail(length_, IntegrationError::no_component,
         "dt is below the resolution of time there; give a longer dt or start nearer to 0");
  }
  begin_step();
  quartic_known_ = false;
  const double remaining = t_limit - time_;
  const double h = limited_step(length_, remaining);
  const double t_end = h == remaining ? t_limit : time_ + h;
  advance(h, t_end);
  require_finite(h, end_state_);
  evaluate(t_end, end_state_.data(), end_derivative_.data());
  require_finite(h, end_derivative_);
  accept(t_end);
}

/// Cubic Hermite polynomial at t0 + s h.
double FixedStep::cubic(std::size_t i, double s, double h) const {
  return cubic_hermite(previous_state_[i], end_state_[i], h * start_derivative_[i], h * end_derivative_[i],
                       s);
}

void FixedStep::find_quartic() const {
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

void FixedStep::interpolate(double t, double* y) const {
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

}  // namespace seacrane
