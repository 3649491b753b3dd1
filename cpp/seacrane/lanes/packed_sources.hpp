#pragma once

#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include "seacrane/math/pack.hpp"
#include "seacrane/sea/drift_load.hpp"
#include "seacrane/sea/exact_wave_load.hpp"

namespace seacrane {

/// Value, first and second derivative in time of L sources, a lane for each: evaluated one by one, or, of
/// wave loads, which a table asks for often, side by side.
template <int L, class Source>
class PackedSources {
 public:
  static constexpr std::size_t channels = Source::channels;
  using Loads = std::array<std::shared_ptr<const Source>, L>;

  explicit PackedSources(const Loads& loads) : loads_(loads) {}

  void evaluate(double t, Pack<L>* value, Pack<L>* rate, Pack<L>* acceleration) const {
    double of_one[3][channels];
    for (int lane = 0; lane < L; ++lane) {
      loads_[static_cast<std::size_t>(lane)]->evaluate(t, of_one[0], of_one[1], of_one[2]);
      for (std::size_t j = 0; j < channels; ++j) {
        value[j].set(lane, of_one[0][j]);
        rate[j].set(lane, of_one[1][j]);
        acceleration[j].set(lane, of_one[2][j]);
      }
    }
  }

 private:
  Loads loads_;
};

template <int L>
class PackedSources<L, ExactWaveLoad> {
 public:
  static constexpr std::size_t channels = ExactWaveLoad::channels;
  using Loads = std::array<std::shared_ptr<const ExactWaveLoad>, L>;

  explicit PackedSources(const Loads& loads) {
    std::size_t most = 0;
    for (const auto& load : loads) most = std::max(most, load->waves().size());
    components_.resize(most);
    for (int lane = 0; lane < L; ++lane) put(*loads[static_cast<std::size_t>(lane)], lane);
  }

  void evaluate(double t, Pack<L>* value, Pack<L>* rate, Pack<L>* acceleration) const {
    Pack<L> sum[3][channels];
    for (auto& order : sum) std::fill_n(order, channels, Pack<L>(0.0));
    for (const Component& c : components_) {
      const Pack<L> angle = c.omega * t;
      Pack<L> re = cos(angle), im = -sin(angle);
      for (auto& order : sum) {
        for (std::size_t j = 0; j < channels; ++j) order[j] += c.real[j] * re + c.imaginary[j] * im;
        // d/dt of (cos, -sin) is omega (-sin, -cos).
        const Pack<L> turned = -c.omega * re;
        re = c.omega * im;
        im = turned;
      }
    }
    std::copy_n(sum[0], channels, value);
    std::copy_n(sum[1], channels, rate);
    std::copy_n(sum[2], channels, acceleration);
  }

 private:
  struct Component {
    Pack<L> omega = Pack<L>(0.0), real[channels], imaginary[channels];
    Component() {
      std::fill_n(real, channels, Pack<L>(0.0));
      std::fill_n(imaginary, channels, Pack<L>(0.0));
    }
  };

  void put(const ExactWaveLoad& load, int lane) {
    for (std::size_t i = 0; i < load.waves().size(); ++i) {
      Component& c = components_[i];
      c.omega.set(lane, load.waves().omega()[i]);
      for (std::size_t j = 0; j < channels; ++j) {
        const std::complex<double> of_channel = load.coefficient(i, j);
        c.real[j].set(lane, of_channel.real());
        c.imaginary[j].set(lane, of_channel.imag());
      }
    }
  }

  std::vector<Component> components_;  // zero where a sea has fewer than another
};

}  // namespace seacrane
