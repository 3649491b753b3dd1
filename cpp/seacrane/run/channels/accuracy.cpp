#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

/// The mass matrix of the paper's kinematics is not symmetric: there is no energy.
bool has_energy(const Model& m) { return !m.paper_kinematics; }

void write_constraint_error(const Output& o, double* out) { *out = o.residual; }

void write_constraint_rate_error(const Output& o, double* out) { *out = o.residual_rate; }

void write_constraint_error_before_projection(const Output& o, double* out) {
  *out = o.residual_before_projection;
}

void write_energy_balance(const Output& o, double* out) { *out = o.energy_balance; }

void write_absolute_work(const Output& o, double* out) { *out = o.state[o.system.model().layout.work + 1]; }

}  // namespace

std::vector<Channel> accuracy_channels() {
  return {
      {.name = "constraint_error",
       .axes = {},
       .unit = "m or rad",
       .text = "largest absolute constraint residual",
       .needs = {.residual = true},
       .peaks = Peaks::of_none,
       .write = write_constraint_error},
      {.name = "constraint_rate_error",
       .axes = {},
       .unit = "m/s or rad/s",
       .text = "largest absolute velocity residual",
       .needs = {.residual = true},
       .peaks = Peaks::of_none,
       .write = write_constraint_rate_error},
      {.name = "constraint_error_before_projection",
       .axes = {},
       .unit = "m or rad",
       .text = "largest absolute residual before projection since the last output",
       .peaks = Peaks::of_none,
       .write = write_constraint_error_before_projection},
      {.name = "energy_balance",
       .axes = {},
       .unit = "J",
       .text = "mechanical energy change minus work of all non-conservative loads",
       .needs = {.energy = true},
       .peaks = Peaks::of_none,
       .offered = has_energy,
       .write = write_energy_balance},
      {.name = "absolute_work",
       .axes = {},
       .unit = "J",
       .text = "integral of the absolute power of the non-conservative loads",
       .peaks = Peaks::of_none,
       .offered = has_energy,
       .write = write_absolute_work},
  };
}

}  // namespace seacrane
