#include "seacrane/integrate/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace seacrane {
namespace {

void check_step_size(const char* name, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                " s; give a finite positive value, or 0 for the default");
  }
}

std::string describe(const std::string& method, double time, double step_size, std::size_t component,
                     const std::string& reason) {
  std::ostringstream text;
  text.precision(17);
  text << method << " stopped at t = " << time << " s: " << reason << " (step size " << step_size << " s";
  if (component != IntegrationError::no_component) text << ", state component " << component;
  text << ")";
  return text.str();
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

LastStep::LastStep(std::string name, std::size_t size)
    : state_(size), previous_state_(size), name_(std::move(name)), event_state_(size) {}

std::optional<double> LastStep::locate(const EventFunction& event) {
  double a = previous_time_;
  double b = time_;
  if (!(a < b)) return std::nullopt;
  // The ends are judged on the projected states that neighbouring steps share: judged on the dense output
  // an event within the projection's correction would fall between two steps.
  double ga = event(a, previous_state_.data());
  double gb = event(b, state_.data());
  if (std::isnan(ga) || std::isnan(gb)) {
    throw IntegrationError(name_, b, b - a, IntegrationError::no_component,
                           "an event function is not a number");
  }
  if (ga == 0.0 || (gb != 0.0 && std::signbit(ga) == std::signbit(gb))) return std::nullopt;
  int last_side = 0;
  bool bisect = false;
  const double resolution = 2.0 * kEpsilon * std::max(std::abs(a), std::abs(b));
  while (b - a > resolution) {
    // Illinois regula falsi, with a bisection whenever the bracket has not halved.
    const double width = b - a;
    double t = bisect ? a + 0.5 * width : b - gb * width / (gb - ga);
    t = std::clamp(t, a + 0.5 * resolution, b - 0.5 * resolution);
    if (!(t > a && t < b)) break;
    interpolate(t, event_state_.data());
    const double g = event(t, event_state_.data());
    if (std::isnan(g)) {
      throw IntegrationError(name_, t, b - a, IntegrationError::no_component,
                             "an event function is not a number");
    }
    const bool past = g == 0.0 || std::signbit(g) != std::signbit(ga);
    if (past) {
      b = t;
      gb = g;
      if (last_side == 1) ga *= 0.5;
    } else {
      a = t;
      ga = g;
      if (last_side == -1) gb *= 0.5;
    }
    last_side = past ? 1 : -1;
    bisect = b - a > 0.5 * width;
  }
  return b;
}

IntegrationError::IntegrationError(std::string method, double time, double step_size, std::size_t component,
                                   std::string reason)
    : std::runtime_error(describe(method, time, step_size, component, reason)),
      method_(std::move(method)),
      time_(time),
      step_size_(step_size),
      component_(component),
      reason_(std::move(reason)) {}

}  // namespace seacrane
