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

void check(const BinOptions& o, double from, double to) {
  sea::require(o.count >= 1 && o.count <= 1'000'000, kRealisation, "count", o.count,
               "give 1 to 1000000 components; 200 is the default");
  sea::require(std::isfinite(from) && from >= 0.0, kRealisation, "minimum_omega", from,
               "give a frequency of zero or more in rad/s");
  sea::require(std::isfinite(to) && to > from, kRealisation, "maximum_omega", to,
               "give a finite frequency in rad/s above minimum_omega");
}

std::uint64_t stream(const RealisationOptions& o, RandomUse use) {
  return 3 * o.system + static_cast<std::uint64_t>(use);
}

}  // namespace

WaveBins::WaveBins(const Spectrum& spectrum, const BinOptions& o)
    : uniform_(o.placement == FrequencyPlacement::uniform) {
  const auto [low, high] = spectrum.default_range();
  from_ = o.omega_min.value_or(low);
  const double to = o.omega_max.value_or(high);
  check(o, from_, to);
  const auto n = static_cast<std::size_t>(o.count);
  width_ = (to - from_) / static_cast<double>(n);
  if (uniform_) from_ = (std::max(1.0, std::ceil(from_ / width_ - 1e-9)) - 0.5) * width_;
  amplitude_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double left = from_ + static_cast<double>(i) * width_;
    const double right = from_ + static_cast<double>(i + 1) * width_;
    amplitude_[i] = std::sqrt(2.0 * spectrum.energy(left, right));
  }
}

WaveComponents WaveBins::realise(const RealisationOptions& o) const {
  sea::require_finite(o.direction, kRealisation, "direction", "rad");
  const std::size_t n = amplitude_.size();
  std::vector<double> omega(n), phase(n), direction(n, o.direction);
  for (std::size_t i = 0; i < n; ++i) {
    const double left = from_ + static_cast<double>(i) * width_;
    omega[i] = uniform_ ? std::round(left / width_ + 0.5) * width_
                        : left + Philox::uniform(o.seed, stream(o, RandomUse::jitter), i) * width_;
    phase[i] = 2.0 * std::numbers::pi * Philox::uniform(o.seed, stream(o, RandomUse::phase), i);
  }
  return {std::move(omega), amplitude_, std::move(phase), std::move(direction), o.depth, o.gravity};
}

}  // namespace seacrane
