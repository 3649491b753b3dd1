#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "seacrane/math/pack.hpp"
#include "seacrane/sea/drift_load.hpp"
#include "seacrane/sea/exact_wave_load.hpp"
#include "seacrane/sea/knot_table.hpp"

namespace seacrane {

/// Value, first and second derivative in time of L sources, a lane for each, at the knots of a table:
/// evaluated one by one, or, of wave loads, which a table asks for often, side by side.
template <int L, class Source>
class PackedSources {
 public:
  static constexpr std::size_t channels = Source::channels;
  using Loads = std::array<std::shared_ptr<const Source>, L>;

  /// Knots are `step` apart.
  PackedSources(const Loads& loads, double step) : loads_(loads), step_(step) {}

  void evaluate(std::int64_t number, Pack<L>* value, Pack<L>* rate, Pack<L>* acceleration) {
    const double t = static_cast<double>(number) * step_;
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
  double step_;
};

/// Wave components are turned on from knot to knot, from sines and cosines every `restart` knots, so that a
/// knot depends on its number alone.
template <int L>
class PackedSources<L, ExactWaveLoad> {
 public:
  static constexpr std::size_t channels = 6;  // the load, without the elevation
  using Loads = std::array<std::shared_ptr<const ExactWaveLoad>, L>;

  PackedSources(const Loads& loads, double step) : step_(step) {
    std::size_t most = 0;
    for (const auto& load : loads) most = std::max(most, load->waves().size());
    components_.resize(most);
    for (int lane = 0; lane < L; ++lane) put(*loads[static_cast<std::size_t>(lane)], lane);
    for (Component& c : components_) c.turn = Phase(c.omega * step);
  }

  void evaluate(std::int64_t number, Pack<L>* value, Pack<L>* rate, Pack<L>* acceleration) {
    move_to(number);
    Pack<L> sums[3][channels];
    for (auto& order : sums) std::fill_n(order, channels, Pack<L>(0.0));
    for (std::size_t first = 0; first < components_.size(); first += chunk) {
      add(first, std::min(chunk, components_.size() - first), sums);
    }
    std::copy_n(sums[0], channels, value);
    std::copy_n(sums[1], channels, rate);
    std::copy_n(sums[2], channels, acceleration);
  }

 private:
  static constexpr std::int64_t restart = 64;
  static constexpr std::size_t chunk = 32;  // phases held on the stack
  struct Phase {
    Pack<L> re, im;     // of exp(-i angle)
    Phase() = default;  // not set
    explicit Phase(const Pack<L>& angle) {
      const auto [cosine, sine] = cos_sin(angle);
      re = cosine;
      im = -sine;
    }
  };
  struct Component {
    Pack<L> omega = Pack<L>(0.0);
    Phase turn, now;
    Pack<L> real[channels], imaginary[channels];
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

  void move_to(std::int64_t number) {
    const std::int64_t since = ((number % restart) + restart) % restart, begin = number - since;
    if (!(begin <= number_ && number_ <= number)) {
      for (Component& c : components_) c.now = Phase(c.omega * (static_cast<double>(begin) * step_));
      number_ = begin;
    }
    for (; number_ < number; ++number_) {
      for (Component& c : components_) {
        const Pack<L> re = c.now.re;
        c.now.re = re * c.turn.re - c.now.im * c.turn.im;
        c.now.im = re * c.turn.im + c.now.im * c.turn.re;
      }
    }
  }

  void add(std::size_t first, std::size_t count, Pack<L> (&sums)[3][channels]) const {
    const Component* const components = components_.data() + first;
    Phase phase[chunk];
    for (std::size_t i = 0; i < count; ++i) phase[i] = components[i].now;
    for (auto& sum : sums) {
      Pack<L> here[channels];
      std::copy_n(sum, channels, here);
      for (std::size_t i = 0; i < count; ++i) {
        const Component& c = components[i];
        const Pack<L> re = phase[i].re, im = phase[i].im;
        for (std::size_t j = 0; j < channels; ++j) here[j] += c.real[j] * re + c.imaginary[j] * im;
        // d/dt of (cos, -sin) is omega (-sin, -cos).
        phase[i].re = c.omega * im;
        phase[i].im = -c.omega * re;
      }
      std::copy_n(here, channels, sum);
    }
  }

  std::vector<Component> components_;  // zero where a sea has fewer than another
  double step_;
  std::int64_t number_ = std::numeric_limits<std::int64_t>::min();  // whose phases are held
};

/// The tables of L sources side by side: one grid, that of the table with the smallest step, so that the
/// interpolation has one set of weights and keeps the bound of every table. A knot depends on its number
/// alone.
template <int L, class Source>
class PackedTable {
 public:
  static constexpr std::size_t channels = PackedSources<L, Source>::channels;
  using Table = KnotTable<Source>;

  explicit PackedTable(const std::array<std::shared_ptr<const Table>, L>& tables)
      : step_(smallest_step(tables)), inverse_step_(1.0 / step_), sources_(loads_of(tables), step_) {}

  /// Writes one value for each channel.
  void evaluate(double t, Pack<L>* out) {
    const double place = std::floor(t * inverse_step_);
    const auto number = static_cast<std::int64_t>(place);
    const HermiteWeights w((t - place * step_) * inverse_step_);
    std::fill_n(out, channels, Pack<L>(0.0));
    for (int k = 0; k < 4; ++k) {
      const Knot& knot = this->knot(number + k - 1);
      for (std::size_t j = 0; j < channels; ++j) {
        out[j] +=
            w.value[k] * knot.value[j] + w.rate[k] * knot.rate[j] + w.acceleration[k] * knot.acceleration[j];
      }
    }
  }

 private:
  static constexpr std::size_t slots = 16;  // a power of two
  struct Knot {
    std::int64_t number = TableKnot::empty;
    Pack<L> value[channels], rate[channels], acceleration[channels];  // scaled by 1, step, step^2
  };

  const Knot& knot(std::int64_t number) {
    Knot& k = knots_[static_cast<std::size_t>(number) & (slots - 1)];
    if (k.number != number) [[unlikely]] {
      compute(number, k);
    }
    return k;
  }

  static double smallest_step(const std::array<std::shared_ptr<const Table>, L>& tables) {
    double step = tables.front()->step();
    for (const auto& table : tables) step = std::min(step, table->step());
    return step;
  }
  static auto loads_of(const std::array<std::shared_ptr<const Table>, L>& tables) {
    typename PackedSources<L, Source>::Loads out;
    for (std::size_t i = 0; i < L; ++i) out[i] = tables[i]->exact();
    return out;
  }

  void compute(std::int64_t number, Knot& k) {
    k.number = number;
    sources_.evaluate(number, k.value, k.rate, k.acceleration);
    for (std::size_t j = 0; j < channels; ++j) {
      k.rate[j] *= step_;
      k.acceleration[j] *= step_ * step_;
    }
  }

  double step_, inverse_step_;
  PackedSources<L, Source> sources_;
  std::array<Knot, slots> knots_;
};

}  // namespace seacrane
