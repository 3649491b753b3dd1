#include "seacrane/sea/realisation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "seacrane/sea/philox.hpp"
#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

constexpr std::uint64_t jitter_stream = 0, phase_stream = 1;
const char* const object = "wave realisation";

void check(const RealisationOptions& o, double from, double to) {
  sea::require(o.count >= 1 && o.count <= 1'000'000, object, "count", o.count,
               "give 1 to 1000000 components; 200 is the default");
  sea::require(std::isfinite(from) && from >= 0.0, object, "omega_min", from,
               "give a frequency of zero or more in rad/s");
  sea::require(std::isfinite(to) && to > from, object, "omega_max", to,
               "give a finite frequency in rad/s above omega_min");
  sea::require_finite(o.direction, object, "direction", "rad");
}

}  // namespace

WaveComponents realise(const Spectrum& spectrum, const RealisationOptions& o) {
  const double from = o.omega_min.value_or(std::min(0.3, 0.5 * spectrum.peak_omega()));
  const double to = o.omega_max.value_or(std::max(2.5, 3.0 * spectrum.peak_omega()));
  check(o, from, to);
  const auto n = static_cast<std::size_t>(o.count);
  const double width = (to - from) / static_cast<double>(n);
  std::vector<double> omega(n), amplitude(n), phase(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double left = from + static_cast<double>(i) * width;
    const double right = from + static_cast<double>(i + 1) * width;
    omega[i] = left + Philox::uniform(o.seed, jitter_stream, i) * width;
    amplitude[i] = std::sqrt(2.0 * spectrum.energy(left, right));
    phase[i] = 2.0 * std::numbers::pi * Philox::uniform(o.seed, phase_stream, i);
  }
  std::vector<double> direction(n, o.direction);
  return {std::move(omega), std::move(amplitude), std::move(phase), std::move(direction), o.depth, o.gravity};
}

}  // namespace seacrane
