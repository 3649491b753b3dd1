#include "seacrane/integrate/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace seacrane {
namespace {

void check_step_size(const char* name, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                " s; give a finite positive value, or 0 for the default");
  }
}

}  // namespace

Integrator::Integrator(const IntegratorProperties& properties, std::size_t size)
    : LastStep(properties.name, size), properties_(properties) {
  if (size == 0) throw std::invalid_argument(name() + ": the system has no state");
}

void Integrator::set_state(double t, const double* y) {
  if (!std::isfinite(t)) throw std::invalid_argument(name() + ": the start time is not finite");
  const std::size_t bad = first_non_finite(y, state_.size());
  if (bad != IntegrationError::no_component) {
    throw std::invalid_argument(name() + ": component " + std::to_string(bad) +
                                " of the start state is not finite");
  }
  time_ = previous_time_ = t;
  std::copy_n(y, state_.size(), state_.data());
  std::copy_n(y, state_.size(), previous_state_.data());
}

void Integrator::check_limit(double t_limit) const {
  if (std::isfinite(t_limit) && t_limit >= time_) return;
  throw std::invalid_argument(name() + ": t_limit is " + std::to_string(t_limit) +
                              " s; give a finite time not before the present " + std::to_string(time_) +
                              " s");
}

double Integrator::inside_last_step(double t) const {
  const double slack = 8.0 * kEpsilon * std::max(std::abs(previous_time_), std::abs(time_));
  if (t >= previous_time_ - slack && t <= time_ + slack) return std::clamp(t, previous_time_, time_);
  throw std::invalid_argument(name() + ": dense output asked at " + std::to_string(t) +
                              " s, outside the last step from " + std::to_string(previous_time_) + " to " +
                              std::to_string(time_) + " s");
}

void check_step_sizes(const IntegratorOptions& options) {
  check_step_size("fixed_step", options.fixed_step);
  check_step_size("maximum_step", options.max_step);
  check_step_size("initial_step", options.initial_step);
}

double smallest_step(double t) { return 1e-14 * std::max(std::abs(t), 1.0); }

double limited_step(double proposed, double remaining) {
  // The margin takes up the rounding that many equal steps gather.
  if (remaining <= proposed * (1.0 + 1e-10)) return remaining;
  if (remaining < 1.1 * proposed) return 0.5 * remaining;
  return proposed;
}

}  // namespace seacrane
