#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "seacrane/sea/exact_wave_load.hpp"

namespace seacrane {

/// Scratch of one run for one WaveTable: the last used knots, each in the slot its number gives, replaced
/// when time moves on. A fixed size for any duration; backward jumps only cost the knots that must be made
/// again.
class WaveTableBlock {
 public:
  WaveTableBlock() = default;
  /// How many knots have been computed so far.
  std::int64_t knots_computed() const { return computed_; }

 private:
  friend class WaveTable;
  static constexpr std::size_t lanes = 8;
  struct Knot {
    std::int64_t number;
    double value[lanes], rate[lanes], acceleration[lanes];  // scaled by 1, step, step^2
  };
  std::vector<Knot> knots_;
  std::shared_ptr<const ExactWaveLoad> load_;  // whose knots these are; kept alive, so never mistaken
  double step_ = 0.0;
  std::int64_t computed_ = 0;
};

/// A wave load by quintic Hermite interpolation between knots k x step of one global grid, so that values do
/// not depend on the order of calls. On one interval |error_j| <= step^6 / 46080 max |d^6 F_j / dt^6|
/// (Hermite remainder, P. J. Davis, Interpolation and Approximation, 1963, theorem 3.5.1; 6! x 2^6 = 46080),
/// and the sixth derivative never exceeds sum |a X_ij| omega^6. Continuous up to the second derivative.
/// Immutable.
class WaveTable {
 public:
  /// The step is the largest that keeps the bound below `relative_bound` x sum_i |a_i X_ij| for every channel
  /// j. The default 1e-9 is about 1e-8 of a load's standard deviation with 200 components: a hundred times
  /// below what an integrator at relative tolerance 1e-6 resolves, for about ten knots per second.
  explicit WaveTable(std::shared_ptr<const ExactWaveLoad> load, double relative_bound = 1e-9);

  WaveTableBlock make_block() const;
  /// out[0..5]: load; out[6]: elevation. The block must come from make_block() of this table.
  void evaluate(double t, WaveTableBlock& block, double* out) const;

  double step() const { return step_; }
  /// Bound of |table - exact sum| per channel, at any time; rounding comes on top (see ExactWaveLoad).
  const WaveChannels& error_bound() const { return error_bound_; }
  const std::shared_ptr<const ExactWaveLoad>& exact() const { return load_; }

 private:
  static constexpr std::size_t slots = 64;  // a power of two
  const WaveTableBlock::Knot& knot(std::int64_t number, WaveTableBlock& block) const;

  std::shared_ptr<const ExactWaveLoad> load_;
  double step_ = 0.0, inverse_step_ = 0.0;
  WaveChannels error_bound_{};
};

}  // namespace seacrane
