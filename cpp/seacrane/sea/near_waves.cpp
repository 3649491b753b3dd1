#include "seacrane/sea/near_waves.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "seacrane/sea/knot_table.hpp"

namespace seacrane {
namespace {

constexpr std::size_t numbers = 4;  // of knots that are held of each region

std::size_t slot(std::int64_t number, std::size_t of) { return static_cast<std::size_t>(number) & (of - 1); }

}  // namespace

NearWaves::NearWaves(std::shared_ptr<const NearSea> sea, std::size_t stencils)
    : sea_(std::move(sea)),
      few_(sea_->few().padded()),
      regions_(std::bit_ceil(std::clamp<std::size_t>(2 * stencils, 8, 64))) {
  const std::size_t size = 2 * NearSea::sums * few_;
  for (const double k : sea_->few().arrays().k) {
    turn_cosine_.push_back(std::cos(k * sea_->spacing()));
    turn_sine_.push_back(std::sin(k * sea_->spacing()));
  }
  harmonics_.resize(3 * 2 * NearSea::sums * sea_->all().padded());
  knots_.resize(regions_ * numbers);
  for (Knot& one : knots_) {
    for (auto* of : {&one.value, &one.rate, &one.acceleration}) of->resize(size);
  }
  held_.resize(regions_);
  for (Held& one : held_) one.amplitudes.resize(size);
  blended_.resize(size);
  slopes_.resize(size);
}

NearWaves::Met NearWaves::at(double t, double s, sea::FlowScratch& scratch, bool sloped) {
  const double spacing = sea_->spacing(), place = std::floor(s / spacing);
  const double from = 0.5 * (1.0 - NearSea::overlap);
  const double part = std::clamp((s / spacing - place - from) / NearSea::overlap, 0.0, 1.0);
  const double share = part * part * part * (10.0 + part * (6.0 * part - 15.0));
  const auto region = static_cast<std::int64_t>(place);
  if (share == 0.0) return {place * spacing, amplitudes(region, t, scratch).data()};
  const std::vector<double>& next = amplitudes(region + 1, t, scratch);
  if (share == 1.0) return {(place + 1.0) * spacing, next.data()};
  const std::vector<double>& here = amplitudes(region, t, scratch);
  const auto blend = [&](double of_here, double of_next, double* out) {
    for (std::size_t set = 0; set < 2 * NearSea::sums * few_; set += 2 * few_) {
      for (std::size_t j = 0; j < few_; ++j) {
        const std::size_t c = set + j, q = c + few_;
        out[c] = of_here * here[c] + of_next * (next[c] * turn_cosine_[j] - next[q] * turn_sine_[j]);
        out[q] = of_here * here[q] + of_next * (next[q] * turn_cosine_[j] + next[c] * turn_sine_[j]);
      }
    }
  };
  blend(1.0 - share, share, blended_.data());
  if (!sloped) return {place * spacing, blended_.data()};
  const double rest = part * (1.0 - part), slope = 30.0 * rest * rest / (NearSea::overlap * spacing);
  blend(-slope, slope, slopes_.data());
  return {place * spacing, blended_.data(), slopes_.data()};
}

const std::vector<double>& NearWaves::amplitudes(std::int64_t region, double t, sea::FlowScratch& scratch) {
  Held& out = held_[slot(region, regions_)];
  if (out.time == t && out.region == region) return out.amplitudes;
  const double place = std::floor(t / sea_->step());
  out.time = std::numeric_limits<double>::quiet_NaN();
  std::array<std::array<const double*, 3>, numbers> around;
  for (std::size_t n = 0; n < numbers; ++n) {
    const Knot& one =
        knot(region, static_cast<std::int64_t>(place) + static_cast<std::int64_t>(n) - 1, scratch);
    around[n] = {one.value.data(), one.rate.data(), one.acceleration.data()};
  }
  sea::write_weighed(around, HermiteWeights(t / sea_->step() - place), out.amplitudes.size(),
                     out.amplitudes.data());
  out.time = t;
  out.region = region;
  return out.amplitudes;
}

const NearWaves::Knot& NearWaves::knot(std::int64_t region, std::int64_t number, sea::FlowScratch& scratch) {
  Knot& out = knots_[slot(region, regions_) * numbers + slot(number, numbers)];
  if (out.number == number && out.region == region) return out;
  const SeaField& all = sea_->all();
  const SeaField::Arrays& f = all.arrays();
  const double s = static_cast<double>(region) * sea_->spacing(), step = sea_->step();
  const std::size_t n = all.padded();
  std::fill_n(scratch.amplitude.begin(), n, 1.0);
  sea::set_phasors(all, n, static_cast<double>(number) * step, s * f.x[0], s * f.y[0], scratch);
  const double* const cosine = scratch.cosine.data();
  const double* const sine = scratch.sine.data();
  for (std::size_t set = 0; set < NearSea::sums; ++set) {
    const double* const factor = sea_->factors()[set].data();
    double* const to =
        harmonics_.data() + 6 * set * n;  // value, rate and acceleration, cosine and sine of each
    for (std::size_t i = 0; i < n; ++i) {
      const double turn = f.omega[i] * step, c = factor[i] * cosine[i], q = factor[i] * sine[i];
      to[i] = c, to[n + i] = q;
      to[2 * n + i] = -turn * q, to[3 * n + i] = turn * c;
      to[4 * n + i] = -turn * turn * c, to[5 * n + i] = -turn * turn * q;
    }
    double* const into[] = {out.value.data() + 2 * set * few_, out.rate.data() + 2 * set * few_,
                            out.acceleration.data() + 2 * set * few_};
    sea::sum_shares(sea_->shares().data(), to, n, few_, into[0], into[1], into[2]);
  }
  out.region = region;
  out.number = number;
  return out;
}

}  // namespace seacrane
