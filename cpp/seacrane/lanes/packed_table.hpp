#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "seacrane/lanes/packed_sources.hpp"
#include "seacrane/math/pack.hpp"
#include "seacrane/sea/knot_table.hpp"

namespace seacrane {

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
