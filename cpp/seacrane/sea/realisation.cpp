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

const char* const kRealisation = "wave realisation";

void check(const RealisationOptions& o, double from, double to) {
  sea::require(o.count >= 1 && o.count <= 1'000'000, kRealisation, "count", o.count,
               "give 1 to 1000000 components; 200 is the default");
  sea::require(std::isfinite(from) && from >= 0.0, kRealisation, "minimum_omega", from,
               "give a frequency of zero or more in rad/s");
  sea::require(std::isfinite(to) && to > from, kRealisation, "maximum_omega", to,
               "give a finite frequency in rad/s above minimum_omega");
  sea::require_finite(o.direction, kRealisation, "direction", "rad");
}

std::uint64_t stream(const RealisationOptions& o, RandomUse use) {
  return 3 * o.system + static_cast<std::uint64_t>(use);
}

}  // namespace

WaveComponents realise(const Spectrum& spectrum, const RealisationOptions& o) {
  const auto [low, high] = spectrum.default_range();
  double from = o.omega_min.value_or(low);
  const double to = o.omega_max.value_or(high);
  check(o, from, to);
  const auto n = static_cast<std::size_t>(o.count);
  const double width = (to - from) / static_cast<double>(n);
  const bool uniform = o.placement == FrequencyPlacement::uniform;
  if (uniform) from = (std::max(1.0, std::ceil(from / width - 1e-9)) - 0.5) * width;
  std::vector<double> omega(n), amplitude(n), phase(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double left = from + static_cast<double>(i) * width;
    const double right = from + static_cast<double>(i + 1) * width;
    omega[i] = uniform ? std::round(left / width + 0.5) * width
                       : left + Philox::uniform(o.seed, stream(o, RandomUse::jitter), i) * width;
    amplitude[i] = std::sqrt(2.0 * spectrum.energy(left, right));
    phase[i] = 2.0 * std::numbers::pi * Philox::uniform(o.seed, stream(o, RandomUse::phase), i);
  }
  std::vector<double> direction(n, o.direction);
  return {std::move(omega), std::move(amplitude), std::move(phase), std::move(direction), o.depth, o.gravity};
}

}  // namespace seacrane
