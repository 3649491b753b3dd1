#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "seacrane/sea/wave_components.hpp"

namespace seacrane {

/// What a wave load delivers: three forces (N), three moments (N m), and the wave elevation (m).
inline constexpr std::size_t wave_channels = 7;
using WaveChannels = std::array<double, wave_channels>;

struct WavePoint {
  double x = 0.0, y = 0.0;  // m, inertial frame
};

/// First-order wave load of a vessel at its mean position as the sum over all components,
/// F_j(t) = Re sum_i a_i X_ij exp(i (omega_i t + phase_i - k_i (x cos b_i + y sin b_i))), in the axes and
/// about the reference point of the transfer X. Immutable, so that threads can share it; nothing is allocated
/// after construction. A sum of n terms carries a rounding error of a few 1e-16 (1 + omega t) sum |a X|.
class ExactWaveLoad {
 public:
  static constexpr std::size_t channels = wave_channels;
  static constexpr const char* object = "wave load";
  using Channels = WaveChannels;

  /// X: one row per component, six columns, N/m and N m/m, time factor exp(+i omega t). `position` is where
  /// the phase of X refers to; the elevation is that at `elevation_point`.
  ExactWaveLoad(WaveComponents waves, const Eigen::Ref<const Eigen::MatrixXcd>& transfer,
                WavePoint position = {}, WavePoint elevation_point = {});

  /// out[0..5]: load; out[6]: elevation.
  void evaluate(double t, double* out) const;
  /// Value, first and second derivative in time, seven each.
  void evaluate(double t, double* value, double* rate, double* acceleration) const;

  /// exp(-i omega k step) of the components at knot k of a table. Turned on from knot to knot, from sines and
  /// cosines every `restart` knots, so that they depend on the number of the knot alone. Scratch of one run.
  class KnotPhases {
   public:
    static constexpr std::int64_t restart = 64;
    KnotPhases(const ExactWaveLoad& load, double step);
    void move_to(std::int64_t number);

   private:
    friend class ExactWaveLoad;
    void turn();
    std::vector<double> omega_, turn_cosine_, turn_sine_, cosine_, sine_;
    double largest_omega_, step_;
    std::int64_t number_ = std::numeric_limits<std::int64_t>::min();
  };
  /// Evaluates the load at the knot that the phases are moved to.
  void evaluate(const KnotPhases& phases, double* value, double* rate, double* acceleration) const;

  const WaveComponents& waves() const { return waves_; }
  /// a X exp(i phase) of a component at the mean position, of a channel.
  std::complex<double> coefficient(std::size_t component, std::size_t channel) const {
    const Coefficients& c = coefficients_[component];
    return {c.real[channel / side][channel % side], c.imaginary[channel / side][channel % side]};
  }
  /// sum_i |a_i X_ij| omega_i^n per channel for n = 0 and 12: no |d^n F_j / dt^n| ever exceeds it.
  std::array<WaveChannels, 2> bounds() const;

 private:
  static constexpr std::size_t lanes = 8;  // channels, padded to whole packs
  static constexpr std::size_t side = 2;   // of a pack
  static constexpr std::size_t packs = lanes / side;
  // Two doubles in one register of every 64-bit processor; gcc and clang spell it alike. Four go through
  // memory where a processor has no such register, at twenty times the price.
  using Pack = double __attribute__((vector_size(side * sizeof(double))));
  struct Coefficients {
    Pack real[packs], imaginary[packs];
  };
  template <std::size_t orders>
  using Sums = Pack[orders][packs];
  /// Adds the components from `first` on, with cosine and sine of each omega t.
  template <std::size_t orders>
  void add(std::size_t first, std::size_t count, const double* cosine, const double* sine,
           Sums<orders>& sums) const;
  template <std::size_t orders>
  void sum(double t, double (&out)[orders][lanes]) const;

  WaveComponents waves_;
  std::vector<Coefficients> coefficients_;
  double largest_omega_ = 0.0;
};

}  // namespace seacrane
