#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

bool has_limits(const Model& m) { return !m.limits.empty(); }

/// Zero of limits that do not hold.
void write_limit_force(const Output& o, double* out) {
  for (const Limit& limit : o.system.model().limits) {
    *out++ = limit.element < 0 ? 0.0 : limit_force(limit, o.terms, o.system.multipliers().data());
  }
}

void write_impact_loss(const Output& o, double* out) { *out = o.impact_loss; }

}  // namespace

std::vector<Channel> limit_channels() {
  return {
      {.name = "limit_force",
       .axes = {&axes::limit},
       .unit = "N or N m",
       .text = "tension of a wire, push of a stop, pressure on a seat",
       .needs = {.solution = true},
       .peaks = Peaks::of_limits,
       .write = write_limit_force},
      {.name = "impact_loss",
       .axes = {},
       .unit = "J",
       .text = "mechanical energy lost in impacts of limits since the start",
       .peaks = Peaks::of_none,
       .offered = has_limits,
       .write = write_impact_loss},
  };
}

}  // namespace seacrane
