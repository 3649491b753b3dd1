#include "seacrane/integrate/adaptive_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seacrane {
namespace {

constexpr double safety = 0.9;
constexpr double strongest_cut = 0.2, strongest_growth = 10.0;
/// Cut after a derivative that was not finite, where no error estimate tells the size.
constexpr double blind_cut = 0.25;
constexpr double least_error_memory = 1e-4;
/// Slope at the end of a step over all that was seen of it, beyond which the step is not believed; a power of
/// time below 100 stays within.
constexpr double leap = 100.0;
/// Rounding of a state relative to its size, as far as tolerances below it are still accepted.
constexpr double rounding = 1e-3 * std::numeric_limits<double>::epsilon();

}  // namespace

AdaptiveStep::AdaptiveStep(const IntegratorProperties& properties, const Problem& problem,
                           const IntegratorOptions& options, int estimate_power)
    : OneStepIntegrator(properties, problem, options),
      max_step_(options.max_step),
      power_(1.0 / estimate_power),
      beta_(0.2 * power_),
      alpha_(power_ - 0.75 * beta_) {}

bool AdaptiveStep::stage(double t, const double* y, double* k) {
  evaluate(t, y, k);
  if (all_finite(k, size())) return true;
  bad_component_ = first_non_finite(k, size());
  return false;
}

bool AdaptiveStep::end_is_finite() {
  if (all_finite(end_state_.data(), size())) return true;
  bad_component_ = first_non_finite(end_state_.data(), size());
  return false;
}

/// First step size from the derivative and its change over a small Euler step
/// [Hairer, Norsett, Wanner I, II.4].
double AdaptiveStep::starting_step(double remaining) {
  const double size_of_state = norm_.norm(state_.data(), state_.data());
  // An estimate can be zero at the level of rounding, and would let every step pass.
  if (norm_.over_tolerances(state_.data()) * rounding > 1.0) {
    fail(0.0, IntegrationError::no_component, "the tolerances are far below the rounding of the state");
  }
  const double size_of_slope = norm_.norm(start_derivative_.data(), state_.data());
  double h0 = size_of_state < 1e-5 || size_of_slope < 1e-5 ? 1e-6 : 0.01 * size_of_state / size_of_slope;
  h0 = std::min(h0, remaining);
  if (max_step_ > 0.0) h0 = std::min(h0, max_step_);
  for (std::size_t i = 0; i < size(); ++i) end_state_[i] = state_[i] + h0 * start_derivative_[i];
  if (!stage(time_ + h0, end_state_.data(), end_derivative_.data())) return blind_cut * h0;
  for (std::size_t i = 0; i < size(); ++i) end_derivative_[i] -= start_derivative_[i];
  const double curvature = norm_.norm(end_derivative_.data(), state_.data()) / h0;
  const double steepest = std::max(size_of_slope, curvature);
  const double h1 = steepest <= 1e-15 ? std::max(1e-6, 1e-3 * h0) : std::pow(0.01 / steepest, power_);
  return std::max(std::min(100.0 * h0, h1), 2.0 * smallest_step(time_));
}

double AdaptiveStep::step_in_use() const {
  const double step = step_ > 0.0 ? step_ : std::numeric_limits<double>::infinity();
  return max_step_ > 0.0 ? std::min(step, max_step_) : step;
}

void AdaptiveStep::collapse() const {
  if (max_step_ > 0.0 && max_step_ < smallest_step(time_)) {
    fail(max_step_, IntegrationError::no_component,
         "maximum_step is below the resolution of time there; give a longer one or start nearer to 0");
  }
  if (bad_component_ != IntegrationError::no_component) {
    fail(step_, bad_component_, "the step size has collapsed: the derivative is not finite");
  }
  fail(step_, dominant_component(step_),
       "the step size has collapsed: no step, however short, meets the tolerance, because a load or motion "
       "jumps here or the tolerance is below rounding; smooth the jump or give a larger rtol");
}

void AdaptiveStep::step(double t_limit) {
  check_limit(t_limit);
  if (t_limit == time_) return;
  begin_step();
  const double remaining = t_limit - time_;
  if (step_ <= 0.0) step_ = starting_step(remaining);
  if (max_step_ > 0.0) step_ = std::min(step_, max_step_);
  for (bool cut_before = false;; cut_before = true) {
    // A step cut short by a hard stop may be as short as it likes; only the wish itself can collapse.
    if (step_ < smallest_step(time_)) collapse();
    const double h = limited_step(step_, remaining);
    const double t_end = h == remaining ? t_limit : time_ + h;
    bad_component_ = IntegrationError::no_component;
    end_derivative_known_ = false;
    double e = 0.0;
    bool finite = try_step(h, t_end);
    if (finite) e = error(h);
    // A pair whose estimate does without the derivative at the end needs it of an accepted step only.
    if (finite && e <= 1.0 && !end_derivative_known_) {
      finite = stage(t_end, end_state_.data(), end_derivative_.data());
    }
    if (finite && e <= 1.0 && has_leapt(h)) e = std::numeric_limits<double>::infinity();
    if (finite && e <= 1.0) {
      accept(t_end);
      after_success(h, e, cut_before, h < step_);
      return;
    }
    ++counters_.rejected_steps;
    // Not finite where components beyond the tolerances overflow, or after a leap: cut as hard as allowed.
    const double cut = std::isfinite(e) ? safety * std::pow(e, -alpha_) : 0.0;
    step_ = h * (finite ? std::max(strongest_cut, cut) : blind_cut);
  }
}

/// A stop may be met by a stage without weight alone, which throws the others clear of it: their estimate is
/// zero, and the step ends far behind the stop. Only the slope there tells, out of all proportion to the
/// slope at the start and to how far the step went.
bool AdaptiveStep::has_leapt(double h) {
  const ErrorNorm::Lanes start = norm_.norms(start_derivative_.data(), state_.data()),
                         end = norm_.norms(end_derivative_.data(), end_state_.data());
  for (std::size_t lane = 0; lane < norm_.lanes(); ++lane) {
    const double seen = h * start[lane], slope = h * end[lane];
    if (!(slope > 1.0 && slope > leap * seen)) continue;  // as nearly always: the way is not asked for
    if (slope > leap * (seen + norm_.distances(end_state_.data(), state_.data())[lane])) return true;
  }
  return false;
}

void AdaptiveStep::after_success(double h, double error, bool cut_before, bool truncated) {
  double growth = strongest_growth;
  if (error > 0.0) {
    growth = std::clamp(safety * std::pow(error_memory_, beta_) * std::pow(error, -alpha_), strongest_cut,
                        strongest_growth);
  }
  if (cut_before) growth = std::min(growth, 1.0);
  // The error of a step cut short says nothing about the step wanted where it only asks for the largest
  // growth.
  if (truncated && growth == strongest_growth) {
    step_ = std::max(step_, growth * h);
    return;
  }
  step_ = preferred_step(h, growth * h);
  // Nor does one cut to the resolution of time say that no step does.
  if (truncated) step_ = std::max(step_, 2.0 * smallest_step(time_));
  if (!truncated) error_memory_ = std::max(error, least_error_memory);
}

}  // namespace seacrane
