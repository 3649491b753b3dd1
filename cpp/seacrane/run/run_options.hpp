#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace seacrane {

struct RunOptions {
  std::string formulation = "redundant";
  std::string integrator = "dopri5";
  /// Local error of a step in units of the scale of each state: absolute, so that results do not depend on
  /// where the origin is.
  double scaled_tolerance = 1e-6;
  std::optional<double> fixed_step;       // s, of fixed-step methods; none: the method's own
  std::optional<double> max_step;         // s; none: no limit
  std::optional<double> spectral_radius;  // of generalized-alpha; none: the method's own
  std::optional<double> energy_limit;     // of the energy balance, see EnergyWatch; none: no limit
  std::vector<double> output_times;       // increasing; those before the start are left out
  std::optional<std::size_t> capacity;    // outputs to take memory for; none: all
  std::set<std::string> channels;
  std::set<std::string> extremes;  // channels of which least and largest values between outputs are kept
  std::set<std::string> trail;     // channels whose values at every step are kept, see Trail
  std::chrono::milliseconds ask_every{20};  // of wall time: how often advance() asks whether to go on
};

}  // namespace seacrane
