#include "seacrane/integrate/last_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "seacrane/integrate/integration_error.hpp"
#include "seacrane/integrate/integrator.hpp"

namespace seacrane {

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

}  // namespace seacrane
