#include "seacrane/sea/wave_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

const char* const object = "wave table";
constexpr double largest_number = 0x1p52;  // of a knot: step x number stays apart from its neighbours
constexpr std::int64_t empty = std::numeric_limits<std::int64_t>::min();

/// Weights of quintic Hermite interpolation at s in [0, 1]: value at the right knot (the left has one minus
/// it), rate left and right, acceleration left and right.
struct Hermite {
  double value, rate0, rate1, acceleration0, acceleration1;
  explicit Hermite(double s) {
    const double s2 = s * s, s3 = s2 * s, u = 1.0 - s, u3 = u * u * u;
    value = s3 * (10.0 + s * (6.0 * s - 15.0));
    rate0 = u3 * s * (1.0 + 3.0 * s);
    rate1 = -s3 * u * (1.0 + 3.0 * u);
    acceleration0 = 0.5 * u3 * s2;
    acceleration1 = 0.5 * s3 * u * u;
  }
};

}  // namespace

WaveTable::WaveTable(std::shared_ptr<const ExactWaveLoad> load, double relative_bound)
    : load_(std::move(load)) {
  if (!load_) throw std::invalid_argument("wave table: load is absent; give an ExactWaveLoad");
  sea::require(relative_bound >= 1e-14 && relative_bound <= 1e-2, object, "relative_bound", relative_bound,
               "give 1e-14 (rounding) to 1e-2; 1e-9 is the default");
  const WaveChannels size = load_->magnitude(0), sixth = load_->magnitude(6);
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < wave_channels; ++j) {
    if (sixth[j] > 0.0)
      step = std::min(step, std::pow(46080.0 * relative_bound * size[j] / sixth[j], 1.0 / 6.0));
  }
  step_ = std::isfinite(step) ? step : 1.0;  // no load at all: any grid is exact
  inverse_step_ = 1.0 / step_;
  for (std::size_t j = 0; j < wave_channels; ++j) error_bound_[j] = std::pow(step_, 6) / 46080.0 * sixth[j];
}

WaveTableBlock WaveTable::make_block() const {
  WaveTableBlock block;
  block.knots_.resize(slots);
  for (auto& k : block.knots_) k.number = empty;
  block.load_ = load_;
  block.step_ = step_;
  return block;
}

const WaveTableBlock::Knot& WaveTable::knot(std::int64_t number, WaveTableBlock& block) const {
  WaveTableBlock::Knot& k = block.knots_[static_cast<std::size_t>(number) & (slots - 1)];
  if (k.number == number) [[likely]] {
    return k;
  }
  load_->evaluate(static_cast<double>(number) * step_, k.value, k.rate, k.acceleration);
  for (std::size_t j = 0; j < WaveTableBlock::lanes; ++j) {
    k.rate[j] *= step_;
    k.acceleration[j] *= step_ * step_;
  }
  k.number = number;
  ++block.computed_;
  return k;
}

void WaveTable::evaluate(double t, WaveTableBlock& block, double* out) const {
  if (block.load_ != load_ || block.step_ != step_) [[unlikely]] {
    throw std::logic_error("wave table: the block belongs to another table; use make_block() of this one");
  }
  const double place = std::floor(t * inverse_step_);
  if (!(std::fabs(place) < largest_number)) [[unlikely]] {
    sea::require(false, object, "time", t, "give a finite time in s within 2^52 table steps");
  }
  const auto number = static_cast<std::int64_t>(place);
  const WaveTableBlock::Knot& a = knot(number, block);
  const WaveTableBlock::Knot& b = knot(number + 1, block);
  const Hermite w((t - place * step_) * inverse_step_);
  double sum[WaveTableBlock::lanes];
  for (std::size_t j = 0; j < WaveTableBlock::lanes; ++j) {
    sum[j] = a.value[j] + w.value * (b.value[j] - a.value[j]) + w.rate0 * a.rate[j] + w.rate1 * b.rate[j] +
             w.acceleration0 * a.acceleration[j] + w.acceleration1 * b.acceleration[j];
  }
  std::copy_n(sum, wave_channels, out);
}

}  // namespace seacrane
