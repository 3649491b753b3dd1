#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "seacrane/sea/spectrum.hpp"
#include "seacrane/sea/wave_components.hpp"

namespace seacrane {

enum class FrequencyPlacement {
  jittered,  // uniformly at random within each bin: no common period
  uniform    // multiples of one bin width, for the FFT: the sea repeats after 2 pi / width
};

struct BinOptions {
  long count = 200;
  /// rad/s. When absent: Spectrum::default_range(), which leaves out less than 1.6 % of the energy of any
  /// JONSWAP or Pierson-Moskowitz spectrum, hence less than 0.8 % of its hs.
  std::optional<double> omega_min, omega_max;
  FrequencyPlacement placement = FrequencyPlacement::jittered;
};

struct RealisationOptions : BinOptions {
  double direction = 0.0;  // rad, travelling to, from +x towards +y
  std::uint64_t seed = 0;
  std::uint64_t system = 0;  // of a sea of several wave systems: each has random numbers of its own
  double depth = std::numeric_limits<double>::infinity();
  double gravity = standard_gravity;
};

/// Philox streams of one wave system: 3 x system + use.
enum class RandomUse : std::uint64_t { jitter = 0, phase = 1, direction = 2 };

/// A spectrum cut into bins of one width, from which one seed after another makes a long-crested sea.
/// Component i has the energy of bin i exactly, a = sqrt(2 x integral of S), a frequency in it by `placement`
/// and a uniform phase; both random numbers from Philox with the seed as key, stream by RandomUse, index i.
/// Uniform placement shifts the bins by at most half a width, so that their centres are multiples of it.
/// Energy outside the range is left out, neither rescaled nor lumped into the end bins: compare realised_hs()
/// with the spectrum's. On other platforms the same seed gives the same random bits; the derived doubles
/// agree up to libm.
class WaveBins {
 public:
  WaveBins(const Spectrum& spectrum, const BinOptions& options);
  WaveComponents realise(const RealisationOptions& options) const;

 private:
  bool uniform_;
  double from_ = 0.0, width_ = 0.0;  // rad/s
  std::vector<double> amplitude_;    // m
};

inline WaveComponents realise(const Spectrum& spectrum, const RealisationOptions& options) {
  return WaveBins(spectrum, options).realise(options);
}

}  // namespace seacrane
