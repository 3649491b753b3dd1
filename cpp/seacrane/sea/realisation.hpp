#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "seacrane/sea/spectrum.hpp"
#include "seacrane/sea/wave_components.hpp"

namespace seacrane {

struct RealisationOptions {
  long count = 200;
  /// rad/s. When absent: min(0.3, peak / 2) and max(2.5, 3 x peak), which leaves out less than 1.6 % of the
  /// energy of any JONSWAP or Pierson-Moskowitz spectrum, hence less than 0.8 % of its hs.
  std::optional<double> omega_min, omega_max;
  double direction = 0.0;  // rad, travelling to, from +x towards +y
  std::uint64_t seed = 0;
  double depth = std::numeric_limits<double>::infinity();
  double gravity = standard_gravity;
};

/// Long-crested sea. [omega_min, omega_max] is cut into `count` bins of one width. Component i has the energy
/// of bin i exactly, a = sqrt(2 x integral of S), a frequency placed uniformly in it (no common period) and a
/// uniform phase; both from Philox with the seed as key, streams 0 and 1, index i. Energy outside the range
/// is left out, neither rescaled nor lumped into the end bins: compare realised_hs() with the spectrum's. On
/// other platforms the same seed gives the same random bits; the derived doubles agree up to libm.
WaveComponents realise(const Spectrum& spectrum, const RealisationOptions& options);

}  // namespace seacrane
