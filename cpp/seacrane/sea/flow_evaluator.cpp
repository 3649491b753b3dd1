#include "seacrane/sea/flow_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

constexpr double rounding = 0x1p-53;
constexpr double few_cut = 1e-9;  // of the few, whose amplitudes may be above those of the sea

std::string shown(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// Of the first components as many, in whole packs, behind which none is felt.
std::size_t felt(const std::vector<double>& amplitude, std::size_t count) {
  while (count > 0 && amplitude[count - 1] == 0.0) --count;
  return (count + SeaField::lanes - 1) / SeaField::lanes * SeaField::lanes;
}

/// Whether knots and regions have numbers there: a step that goes astray may ask for anything.
bool is_numbered(const NearSea& sea, double t, const Vec3d& place) {
  constexpr double most = 0x1p50;  // neighbours are whole numbers apart
  return std::fabs(t) < most * sea.step() && place.head<2>().cwiseAbs().sum() < most * sea.spacing();
}

/// A line from its highest point downwards, so that decays only become smaller.
struct Descent {
  std::size_t last;
  bool rises;
  Vec3d top, down;

  Descent(const Vec3d& first, const Vec3d& step, std::size_t last_point)
      : last(last_point),
        rises(step.z() > 0.0),
        top(rises ? Vec3d(first + static_cast<double>(last) * step) : first),
        down(rises ? Vec3d(-step) : step) {}
  double z(std::size_t n) const { return top.z() + static_cast<double>(n) * down.z(); }
};

/// Phasors of waves that are met at the highest point, and what turns them; how many are felt at all.
std::size_t start(const SeaField& field, double t, const Descent& way, bool whole, sea::FlowScratch& s) {
  if (whole) sea::filter_amplitudes(field, field.padded(), way.down.x(), way.down.y(), s);
  const std::size_t count = felt(s.amplitude, field.padded());
  sea::set_phasors(field, count, t, way.top.x(), way.top.y(), s);
  if (way.last > 0) sea::set_turns(field, count, way.down.x(), way.down.y(), s);
  return count;
}

/// Without stretching, below the still water: decays follow from those of the point before.
void descend(const SeaField& field, std::size_t reached, std::size_t n, const Descent& way, double cut,
             bool first_below, sea::FlowScratch& s) {
  if (!first_below) return sea::step_decays(reached, s);
  s.images = field.images(way.z(way.last), cut);
  sea::forget_decays(s);
  sea::set_decays(field, reached, way.z(n), 0.0, s);
  sea::set_decay_steps(field, reached, way.down.z(), s);
}

}  // namespace

FlowEvaluator::FlowEvaluator(std::shared_ptr<const SeaField> field, FlowStencil stencil,
                             std::shared_ptr<sea::FlowScratch> scratch, std::shared_ptr<NearWaves> near,
                             const QuietLevels* quiet)
    : field_(std::move(field)),
      stencil_(std::move(stencil)),
      scratch_(scratch ? std::move(scratch)
                       : std::make_shared<sea::FlowScratch>(field_ ? field_->padded() : 0)),
      near_(std::move(near)),
      summed_(field_.get()),
      flow_(stencil_.count),
      slopes_(stencil_.count) {
  sea::require(stencil_.count > 0, stencil_.name, "number of points", stencil_.count, "give at least one");
  sea::require(stencil_.waves >= 0.0 && stencil_.waves <= 100.0, stencil_.name, "waves", stencil_.waves,
               "give 0 to 100 times those of the sea");
  sea::require(stencil_.cut >= 1e-14 && stencil_.cut <= 1e-2, stencil_.name, "cut", stencil_.cut,
               "give 1e-14 (rounding) to 1e-2; 1e-5 is the default");
  if (field_ && stencil_.sinks()) {
    const QuietLevels levels = quiet ? *quiet : QuietLevels(*field_, stencil_.cut);
    calm_ = levels.calm;
    still_ = levels.still;
  }
}

std::size_t FlowEvaluator::Reach::of(const SeaField& field, double level, double cut) {
  if (level >= low_ && level <= high_) return count_;
  const std::size_t found = field.reach(level, cut);
  low_ = found == count_ ? std::min(low_, level) : level;
  high_ = found == count_ ? std::max(high_, level) : level;
  return count_ = found;
}

void FlowEvaluator::require_above_floor(double z) const {
  constexpr double give = 1.01;  // what lies on the sea floor may sink into it a little
  if (!(z < -give * field_->depth())) return;
  throw std::domain_error(stencil_.name + ": is at z = " + shown(z) +
                          " m, below the sea floor at z = " + shown(-field_->depth()) +
                          " m; make the sea deeper, or stop the load above its floor");
}

void FlowEvaluator::meet_waves(std::size_t count) {
  const double* const from = summed_->arrays().amplitude.data();
  for (std::size_t i = 0; i < count; ++i) scratch_->amplitude[i] = stencil_.waves * from[i];
  std::fill_n(scratch_->gain.begin(), count, 0.0);
}

void FlowEvaluator::add_surface(std::size_t n, std::size_t count, LocalFlow<double>& out) {
  const auto add = n > 0 ? sea::add_next_surface : sea::add_surface;
  add(*summed_, count, *scratch_, out);
}

void FlowEvaluator::interior(std::size_t count, double level, LocalFlow<double>& out) {
  sea::add_interior(*summed_, count, *scratch_, out);
  add_current(level, out);
}

void FlowEvaluator::add_current(double level, LocalFlow<double>& out) {
  const auto current = field_->current().at<double>(level);
  out.velocity += Vec3d(current.x, current.y, 0.0);
}

void FlowEvaluator::take(std::size_t count, double z, double height, LocalFlow<double>& out) {
  const Depth at = sink(count, z, height, out.elevation, false);
  interior(at.reached, at.level, out);
}

FlowEvaluator::Depth FlowEvaluator::sink(std::size_t count, double z, double height, double elevation,
                                         bool calm) {
  const WetHeight<double> wet = calm ? WetHeight<double>{z, height} : wet_height(z, height, elevation);
  const double level = calm ? z : field_->level(wet.middle, elevation);
  const double top = std::min(level + 0.5 * wet.height, 0.0);
  const bool few = scratch_->split;
  const double cut = few ? few_cut : stencil_.cut;
  const std::size_t reached = std::min(count, (few ? few_reach_ : reach_).of(*summed_, top, cut));
  scratch_->images = summed_->images(level - 0.5 * wet.height, cut);
  sea::set_decays(*summed_, reached, level, wet.height, *scratch_);
  return {level, reached};
}

std::size_t FlowEvaluator::feel(const FlowPoint& at, std::size_t most) {
  const bool turns = !at.turning.isZero(0.0);
  const Mat3d rate = turns ? Mat3d(skew<double>(at.turning) * at.extents) : Mat3d(Mat3d::Zero());
  meet_waves(most);
  for (int j = 0; j < 3; ++j) {
    const double x = at.extents(0, j), y = at.extents(1, j);
    if (turns) {
      sea::filter_turning(*summed_, most, x, y, rate(0, j), rate(1, j), *scratch_);
    } else if (x != 0.0 || y != 0.0) {
      sea::filter_amplitudes(*summed_, most, x, y, *scratch_);
    }
  }
  const std::size_t count = felt(scratch_->amplitude, most);
  if (turns) sea::take_quotients(count, *scratch_);
  return count;
}

void FlowEvaluator::write_calm(double t, const FlowPoint& at, std::size_t most, LocalFlow<double>& out) {
  const double z = at.position.z();
  if (most == 0) return add_current(z, out);
  const std::size_t count = feel(at, most);
  sea::set_phasors(*field_, count, t, at.position.x(), at.position.y(), *scratch_);
  scratch_->images = field_->images(z - 0.5 * at.height, stencil_.cut);
  sea::forget_decays(*scratch_);
  sea::set_decays(*field_, count, z, at.height, *scratch_);
  interior(count, z, out);
}

std::span<const LocalFlow<double>> FlowEvaluator::cloud(double t, std::span<const FlowPoint> points) {
  row_ = {};
  for (std::size_t n = 0; n < flow_.size(); ++n) {
    LocalFlow<double>& out = flow_[n] = {};
    if (!field_) continue;
    const FlowPoint& at = points[n];
    require_above_floor(at.position.z());
    const std::size_t count = feel(at, field_->padded());
    sea::set_phasors(*field_, count, t, at.position.x(), at.position.y(), *scratch_);
    sea::forget_decays(*scratch_);
    sea::add_surface(*field_, count, *scratch_, out);
    take(count, at.position.z(), at.height, out);
  }
  return flow_;
}

void FlowEvaluator::add_row(std::size_t count, const FlowPoint& first, const Vec3d& step) {
  if (flow_.size() > 1) sea::set_turns(*summed_, count, step.x(), step.y(), *scratch_);
  sea::forget_decays(*scratch_);
  for (std::size_t n = 0; n < flow_.size(); ++n) {
    add_surface(n, count, flow_[n]);
    take(count, first.position.z() + static_cast<double>(n) * step.z(), first.height, flow_[n]);
  }
}

NearWaves::Met FlowEvaluator::meet_few(double t, const FlowPoint& first, const Vec3d& step, bool sloped) {
  const SeaField& few = near_->sea().few();
  const Vec3d middle = first.position + 0.5 * static_cast<double>(flow_.size() - 1) * step;
  const double s = few.arrays().x[0] * middle.x() + few.arrays().y[0] * middle.y();
  const NearWaves::Met met = near_->at(t, s, *scratch_, sloped);
  summed_ = &few;
  scratch_->split = true;
  return met;
}

void FlowEvaluator::leave_few() {
  summed_ = field_.get();
  scratch_->split = false;
}

void FlowEvaluator::write_near(double t, const FlowPoint& first, const Vec3d& step) {
  const SeaField& few = near_->sea().few();
  const double x = few.arrays().x[0], y = few.arrays().y[0];
  const NearWaves::Met met = meet_few(t, first, step, false);
  const std::size_t count = feel(first, few.padded());
  sea::set_phasors(few, count, 0.0, first.position.x() - met.s * x, first.position.y() - met.s * y,
                   *scratch_);
  sea::take_amplitudes(met.amplitudes, few.padded(), count, *scratch_);
  add_row(count, first, step);
  leave_few();
}

FlowEvaluator::Sum FlowEvaluator::sum(double t, const FlowPoint& first, const Vec3d& step) {
  const double z = first.position.z(), top = z + 0.5 * first.height;
  require_above_floor(std::min(z, z + static_cast<double>(flow_.size() - 1) * step.z()));
  if (top < still_) return {0, false, true};
  const bool calm = top < calm_;
  const std::size_t most = calm ? reach_.of(*field_, std::min(top, 0.0), stencil_.cut) : field_->padded();
  const bool few =
      near_ && most > near_->sea().few().padded() && is_numbered(near_->sea(), t, first.position + step);
  return {most, few, calm && !few};
}

void FlowEvaluator::write_row(double t, const FlowPoint& first, const Vec3d& step) {
  const Sum sum = this->sum(t, first, step);
  if (sum.few) return write_near(t, first, step);
  if (sum.calm) return write_calm(t, first, sum.most, flow_.front());
  const std::size_t count = feel(first, sum.most);
  sea::set_phasors(*field_, count, t, first.position.x(), first.position.y(), *scratch_);
  add_row(count, first, step);
}

std::span<const LocalFlow<double>> FlowEvaluator::row(double t, const FlowPoint& first, const Vec3d& step) {
  if (t == row_.t && first == row_.first && step == row_.step) return flow_;
  row_ = {};
  std::ranges::fill(flow_, LocalFlow<double>());
  if (field_) write_row(t, first, step);
  row_ = {t, first, step};
  return flow_;
}

void FlowEvaluator::write_slopes(double t, const FlowPoint& first, const Vec3d& step) {
  const Sum sum = this->sum(t, first, step);
  const NearWaves::Met met = sum.few ? meet_few(t, first, step, true) : NearWaves::Met{0.0, nullptr};
  const SeaField& field = *summed_;
  const std::size_t count = sum.few ? field.padded() : sum.most;
  meet_waves(count);
  sea::set_filters(field, count, first.extents, skew<double>(first.turning) * first.extents, *scratch_);
  for (std::size_t n = 0; n < slopes_.size(); ++n) {
    const Vec3d at = first.position + static_cast<double>(n) * step;
    const auto add_waves = [&](const double* amplitudes, FlowSlopes& out) {
      sea::set_phasors(field, count, sum.few ? 0.0 : t, at.x() - met.s * field.arrays().x[0],
                       at.y() - met.s * field.arrays().y[0], *scratch_);
      if (amplitudes) sea::take_amplitudes(amplitudes, count, count, *scratch_);
      if (!sum.calm) sea::add_surface_slopes(field, count, *scratch_, out);
    };
    FlowSlopes& out = slopes_[n] = {};
    out.wide = !first.extents.isZero(0.0);
    out.calm = sum.calm;
    out.blended = met.slopes != nullptr;
    add_waves(met.amplitudes, out);
    sea::forget_decays(*scratch_);
    const Depth depth = sink(count, at.z(), first.height, out.value.elevation, sum.calm);
    sea::add_interior_slopes(field, depth.reached, *scratch_, out);
    if (!out.blended) continue;
    FlowSlopes by_place;
    add_waves(met.slopes, by_place);
    sea::add_interior_slopes(field, depth.reached, *scratch_, by_place);
    out.place = by_place.value;
  }
  leave_few();
}

std::span<const FlowSlopes> FlowEvaluator::slopes(double t, const FlowPoint& first, const Vec3d& step) {
  const Row asked{t, first, step};
  if (asked == sloped_) return slopes_;
  sloped_ = {};
  write_slopes(t, first, step);
  sloped_ = asked;
  return slopes_;
}

std::span<const LocalFlow<double>> FlowEvaluator::line(double t, const Vec3d& first, const Vec3d& step,
                                                       bool whole) {
  row_ = {};
  std::ranges::fill(flow_, LocalFlow<double>());
  if (!field_) return flow_;
  const Descent way(first, step, flow_.size() - 1);
  require_above_floor(way.z(way.last));
  meet_waves(field_->padded());
  sea::forget_decays(*scratch_);
  const std::size_t count = start(*field_, t, way, whole, *scratch_);
  const bool straight = field_->stretching() == Stretching::none;
  bool first_below = true;
  for (std::size_t n = 0; n <= way.last; ++n) {
    LocalFlow<double>& out = flow_[way.rises ? way.last - n : n];
    const double z = way.z(n);
    add_surface(n, count, out);
    if (straight && z < 0.0 && z >= -field_->depth()) {
      const std::size_t reached = std::min(count, field_->reach(z, stencil_.cut));
      descend(*field_, reached, n, way, stencil_.cut, std::exchange(first_below, false), *scratch_);
      interior(reached, z, out);
    } else {
      take(count, z, 0.0, out);
    }
  }
  return flow_;
}

LocalFlow<double> FlowEvaluator::error_bound(double t, double x, double y) const {
  LocalFlow<double> out;
  if (!field_) return out;
  const double points = static_cast<double>(stencil_.count), terms = static_cast<double>(field_->size());
  const double share = rounding * (8.0 * points + terms + 16.0 + 4.0 * field_->largest_angle(t, x, y));
  const LocalFlow<double> size = field_->magnitude();
  LocalFlow<double>::each(size, out, [&](double from, double& to) { to = stencil_.waves * share * from; });
  const double missed = near_ ? stencil_.waves * (NearSea::relative_bound + NearSea::knot_bound) : 0.0;
  LocalFlow<double>::each(size, out, [&](double from, double& to) { to += missed * from; });
  const double lost = stencil_.waves * stencil_.cut;
  for (int i = 0; i < 3; ++i) {
    out.velocity[i] += lost * size.velocity[i];
    out.acceleration[i] += lost * size.acceleration[i];
  }
  out.pressure += lost * size.pressure;
  return out;
}

}  // namespace seacrane
