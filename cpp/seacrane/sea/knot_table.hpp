#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "seacrane/sea/require.hpp"

namespace seacrane {

/// Value, first and second derivative of all channels at one time, scaled by 1, step, step^2.
struct TableKnot {
  static constexpr std::size_t lanes = 8;
  static constexpr std::int64_t empty = std::numeric_limits<std::int64_t>::min();
  std::int64_t number = empty;
  double value[lanes] = {}, rate[lanes] = {}, acceleration[lanes] = {};
};

/// Weights of Hermite interpolation at s in [0, 1] through value, rate and acceleration at -1, 0, 1, 2:
/// L^3 (1 - 3 l1 d + (6 l1^2 - 3 l2) d^2), L^3 d (1 - 3 l1 d) and L^3 d^2 / 2 per node, with d = s - node and
/// L = 1 + l1 d + l2 d^2 + ... its cubic Lagrange polynomial.
struct HermiteWeights {
  double value[4], rate[4], acceleration[4];

  explicit HermiteWeights(double s) {
    constexpr double slope[4] = {-11.0 / 6.0, -0.5, 0.5, 11.0 / 6.0}, bend[4] = {1.0, -1.0, -1.0, 1.0};
    const double d[4] = {s + 1.0, s, s - 1.0, s - 2.0};
    const double lagrange[4] = {d[1] * d[2] * d[3] * (-1.0 / 6.0), d[0] * d[2] * d[3] * 0.5,
                                d[0] * d[1] * d[3] * -0.5, d[0] * d[1] * d[2] * (1.0 / 6.0)};
    for (int k = 0; k < 4; ++k) {
      const double cube = lagrange[k] * lagrange[k] * lagrange[k], l = slope[k];
      value[k] = cube * (1.0 + d[k] * (-3.0 * l + d[k] * (6.0 * l * l - 3.0 * bend[k])));
      rate[k] = cube * d[k] * (1.0 - 3.0 * l * d[k]);
      acceleration[k] = 0.5 * cube * d[k] * d[k];
    }
  }
};

/// All channels at s, through these four knots.
void interpolate(double s, const TableKnot* const (&knots)[4], double (&out)[TableKnot::lanes]);

inline constexpr double hermite_remainder = 0.177978515625 / 479001600.0;  // 0.5625^3 / 12!

template <class Source>
class KnotTable;

/// What a block keeps to get from knot to knot, of a source whose phases turn on: Source::KnotPhases.
template <class Source>
struct KnotPhasesOf {
  KnotPhasesOf() = default;
  KnotPhasesOf(const Source&, double /*step*/) {}
  static constexpr bool any = false;
};
template <class Source>
requires requires { typename Source::KnotPhases; }
struct KnotPhasesOf<Source> {
  std::optional<typename Source::KnotPhases> phases;
  KnotPhasesOf() = default;
  KnotPhasesOf(const Source& source, double step) : phases(std::in_place, source, step) {}
  static constexpr bool any = true;
};

/// Scratch of one run for one table: the last used knots, each in the slot its number gives, replaced when
/// time moves on. A fixed size for any duration; backward jumps only cost the knots that must be made again.
template <class Source>
class KnotBlock {
 public:
  KnotBlock() = default;
  /// How many knots have been computed so far.
  std::int64_t knots_computed() const { return computed_; }

 private:
  friend class KnotTable<Source>;
  std::vector<TableKnot> knots_;
  std::shared_ptr<const Source> source_;  // whose knots these are; kept alive, so never mistaken
  KnotPhasesOf<Source> phases_;
  double step_ = 0.0;
  std::int64_t computed_ = 0;
};

/// A sum of harmonics by Hermite interpolation of degree 11 between knots k x step of one global grid, so
/// that values do not depend on the order of calls. In every interval |error_j| <= c step^12 max |d^12 F_j /
/// dt^12| with c = max |(s+1) s (s-1) (s-2)|^3 / 12! = 0.5625^3 / 12! (Hermite remainder, P. J. Davis,
/// Interpolation and Approximation, 1963, theorem 3.5.1). Continuous up to the second derivative. Immutable.
///
/// A Source has `channels` (8 at most), `object`, evaluate(t, value, rate, acceleration), and bounds(): of
/// the value and of the twelfth derivative, at any time.
template <class Source>
class KnotTable {
 public:
  using Channels = typename Source::Channels;
  static constexpr std::size_t channels = Source::channels;
  static_assert(channels <= TableKnot::lanes);

  /// Knots are computed when a run reaches them. The step is the largest that keeps the bound below
  /// `relative_bound` x the bound of the value for every channel.
  explicit KnotTable(std::shared_ptr<const Source> source, double relative_bound = 1e-9)
      : source_(std::move(source)) {
    require(relative_bound);
    const auto [size, twelfth] = source_->bounds();
    step_ = largest_step(size, twelfth, relative_bound);
    inverse_step_ = 1.0 / step_;
    for (std::size_t j = 0; j < channels; ++j)
      error_bound_[j] = hermite_remainder * std::pow(step_, 12) * twelfth[j];
  }

  KnotBlock<Source> make_block() const {
    KnotBlock<Source> block;
    block.knots_.resize(slots);
    block.phases_ = KnotPhasesOf<Source>(*source_, step_);
    block.source_ = source_;
    block.step_ = step_;
    return block;
  }

  /// The block must come from make_block() of this table.
  void evaluate(double t, KnotBlock<Source>& block, double* out) const {
    if (block.source_ != source_ || block.step_ != step_) [[unlikely]] {
      throw std::logic_error(std::string(Source::object) +
                             " table: the block belongs to another table; use make_block() of this one");
    }
    const double place = std::floor(t * inverse_step_);
    if (!(std::fabs(place) < largest_number)) [[unlikely]] {
      sea::require(false, Source::object, "time", t, "give a finite time in s within 2^52 table steps");
    }
    const auto number = static_cast<std::int64_t>(place);
    const TableKnot* knots[4];
    for (int k = 0; k < 4; ++k) knots[k] = &this->knot(number + k - 1, block);
    double sum[TableKnot::lanes];
    interpolate((t - place * step_) * inverse_step_, knots, sum);
    std::copy_n(sum, channels, out);
  }

  double step() const { return step_; }
  /// Bound of |table - exact sum| per channel, at any time; rounding comes on top.
  const Channels& error_bound() const { return error_bound_; }
  const std::shared_ptr<const Source>& exact() const { return source_; }

 private:
  static constexpr std::size_t slots = 64;          // a power of two
  static constexpr double largest_number = 0x1p52;  // step x number stays apart from its neighbours

  void require(double relative_bound) const {
    if (!source_) {
      throw std::invalid_argument(std::string(Source::object) + " table: the load is absent; give one");
    }
    sea::require(relative_bound >= 1e-14 && relative_bound <= 1e-2, std::string(Source::object) + " table",
                 "relative_bound", relative_bound, "give 1e-14 (rounding) to 1e-2; 1e-9 is the default");
  }

  static double largest_step(const Channels& size, const Channels& twelfth, double relative_bound) {
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < channels; ++j) {
      if (twelfth[j] > 0.0)
        step =
            std::min(step, std::pow(relative_bound * size[j] / (hermite_remainder * twelfth[j]), 1.0 / 12.0));
    }
    return std::isfinite(step) ? step : 1.0;  // constant or no load at all: any grid is exact
  }

  TableKnot computed(std::int64_t number, KnotBlock<Source>& block) const {
    TableKnot k;
    if constexpr (KnotPhasesOf<Source>::any) {
      block.phases_.phases->move_to(number);
      source_->evaluate(*block.phases_.phases, k.value, k.rate, k.acceleration);
    } else {
      source_->evaluate(static_cast<double>(number) * step_, k.value, k.rate, k.acceleration);
    }
    for (std::size_t j = 0; j < channels; ++j) {
      k.rate[j] *= step_;
      k.acceleration[j] *= step_ * step_;
    }
    k.number = number;
    return k;
  }

  const TableKnot& knot(std::int64_t number, KnotBlock<Source>& block) const {
    TableKnot& k = block.knots_[static_cast<std::size_t>(number) & (slots - 1)];
    if (k.number != number) [[unlikely]] {
      k = computed(number, block);
      ++block.computed_;
    }
    return k;
  }

  std::shared_ptr<const Source> source_;
  double step_ = 0.0, inverse_step_ = 0.0;
  Channels error_bound_{};
};

}  // namespace seacrane
