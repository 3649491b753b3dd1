#include "seacrane/run/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "seacrane/dynamics/constraints.hpp"

namespace seacrane {
namespace {

constexpr double kMisfit = 1e-3;  // m or rad: of a state that is none of the scene
constexpr double kFallSpeed =
    1e-3;                          // of the sticking_speed: an overlap that grows slower is one of the method
constexpr double kThrough = 1e-3;  // m below a seat's plane: no rounding, and no wear of a step
constexpr double kSingularPitch = 0.05;  // cos(pitch) below which roll and yaw tell too little
constexpr double kLikelyDip = 0.25;      // of the smaller end: an estimated minimum below it is looked at

/// Where in (0, 1) the cubic through values and slopes (times the step) at both ends is least, for a slope
/// that is negative at first and positive at last; its value there.
std::pair<double, double> least_of_cubic(double y0, double m0, double y1, double m1) {
  const double rise = y1 - y0, b = 3.0 * rise - 2.0 * m0 - m1, a = m0 + m1 - 2.0 * rise;
  const double root = std::sqrt(std::max(0.0, b * b - 3.0 * a * m0));
  // One number has two forms: this is the one without cancellation. Rounding may still leave the step.
  const double s = std::clamp(b > 0.0 ? -m0 / (b + root) : (root - b) / (3.0 * a), 0.0, 1.0);
  return {s, y0 + s * (m0 + s * (b + s * a))};
}

/// Place and value of the least of the parabola through values at 0, 1/2 and 1; at 0 where it is least at an
/// end.
std::pair<double, double> least_of_parabola(double y0, double ym, double y1) {
  const double c = 2.0 * (y0 - 2.0 * ym + y1), b = -3.0 * y0 + 4.0 * ym - y1;
  const double s = c > 0.0 ? -b / (2.0 * c) : 0.0;
  if (!(s > 0.0 && s < 1.0)) return {0.0, y0};
  return {s, y0 + s * (b + s * c)};
}

/// Roll and yaw jump where pitch passes 90 deg.
bool has_pole(const Limit& limit) {
  const CoordinateKind kind = limit.coordinate.kind;
  return limit.kind->of_coordinate && (kind == CoordinateKind::roll || kind == CoordinateKind::yaw);
}

}  // namespace

std::string Contacts::at_time(double t) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", t);
  return text;
}

const char* to_text(EventKind kind) {
  switch (kind) {
    case EventKind::contact:
      return "contact";
    case EventKind::rebound:
      return "rebound";
    case EventKind::through:
      return "through";
    default:
      return "release";
  }
}

Contacts::Contacts(const Model& model, SetStepper stepper)
    : model_(model),
      stepper_(std::move(stepper)),
      before_(model.limits.size()),
      after_(model.limits.size()),
      bodies_(idx(model.layout.size)),
      rate_(idx(model.layout.size)),
      middle_(model.limits.size()),
      above_seat_(model.limits.size(), Vec3d::Zero()),
      below_(model.limits.size(), 0),
      axis_before_(model.limits.size(), Vec3d::UnitX()),
      axis_after_(model.limits.size(), Vec3d::UnitX()) {}

Contacts::Watched Contacts::gap(const Limit& limit, const Terms& terms) const {
  const auto& bodies = terms.bodies();
  const CoordinateRow<double> row = evaluate_limit(limit, bodies.data());
  const JointData& joint = limit.coordinate.joint;
  const double rate = coordinate_rate(row, bodies[idx(joint.first)], bodies[idx(joint.second)]);
  return {limit.side * row.value, limit.side * rate, 0.0};
}

/// How far a limit that holds is open all the same: projection shares what rows that contradict each other
/// leave. With the rows last evaluated.
double Contacts::slack(const Limit& limit, const Stepper& at) {
  if (!limit.kind->closes_again) return 0.0;
  return limit.side * at.system.terms().blocks()[idx(limit.element)].phi[0];
}

void Contacts::check(Stepper& at, double t, const double* bodies) const {
  constraint_residual(at.system.terms(), t, bodies);
  for (const Limit& limit : at.model->limits) {
    double misfit = 0.0;
    if (limit.element >= 0) {
      const auto& phi = at.system.terms().blocks()[idx(limit.element)].phi;
      misfit = phi.head(at.model->elements[idx(limit.element)].rows).cwiseAbs().maxCoeff();
    } else if (limit.kind->closes_again) {
      misfit = -gap(limit, at.system.terms()).value;
    }
    if (misfit <= kMisfit) continue;
    throw std::invalid_argument("state: limit '" + limit.name + "' is " +
                                (limit.element >= 0 ? "to hold, but open" : "passed") + " by " +
                                to_text(misfit) + " m or rad; give a state of this scene");
  }
}

void Contacts::evaluate(Stepper& at, double t, const double* bodies) {
  if (at.model->closed != 0) {
    at.system.derivative(t, bodies, rate_.data());
  } else {
    at.system.terms().read(t, bodies);
  }
}

double Contacts::watched_value(Stepper& at, const Limit& limit, double t, const double* y) {
  std::copy_n(y, at.stepped.size(), state_.data());
  at.stepped.project(t, state_.data(), false);
  at.write_bodies(t, state_.data(), bodies_.data());
  if (limit.element < 0) {
    at.system.terms().read(t, bodies_.data());
    return gap(limit, at.system.terms()).value;
  }
  at.system.derivative(t, bodies_.data(), rate_.data());
  return limit_force(limit, at.system.terms(), at.system.multipliers().data());
}

void Contacts::watch(Stepper& at, double t, const double* bodies) {
  state_.resize(at.stepped.size());
  probe_.resize(at.stepped.size());
  evaluate(at, t, bodies);
  for (std::size_t i = 0; i < after_.size(); ++i) {
    const Limit& limit = at.model->limits[i];
    if (limit.element >= 0) {
      after_[i] = {limit_force(limit, at.system.terms(), at.system.multipliers().data()), 0.0,
                   slack(limit, at)};
    } else if (limit.kind->closes_again) {
      after_[i] = gap(limit, at.system.terms());
    } else {
      above_seat_[i] = offset_of_seat(limit, at.system.terms().bodies().data());
    }
  }
  read_axes(at);
}

void Contacts::read_axes(const Stepper& at) {
  for (std::size_t i = 0; i < axis_after_.size(); ++i) {
    const Limit& limit = at.model->limits[i];
    if (!has_pole(limit)) continue;
    const JointData& joint = limit.coordinate.joint;
    const auto& k = at.system.terms().bodies();
    const JointGeometry<double> g(joint, k[idx(joint.first)], k[idx(joint.second)]);
    axis_after_[i] = g.a.transpose() * g.b.col(0);
  }
}

void Contacts::start(Stepper& at, double t, const double* bodies) {
  watch(at, t, bodies);
  look_below_seats(at, t, false);
  axis_before_ = axis_after_;
  check_poles(t);
}

/// Notes what has gone below the plane of the seat that it left, within reach of it; seats have no contact
/// that would stop it. What is below where a run starts was told of before, or never lay there.
void Contacts::look_below_seats(Stepper& at, double t, bool stepped) {
  for (std::size_t i = 0; i < below_.size(); ++i) {
    const Limit& limit = at.model->limits[i];
    if (limit.kind->closes_again || limit.element >= 0) continue;
    const bool below = above_seat_[i].z() < -kThrough, was = below_[i] != 0;
    below_[i] = below ? 1 : 0;
    if (!below || was || !watching_) continue;
    const auto offset_at = [&](double time, const double* y) {
      if (time >= t) return above_seat_[i];
      at.write_bodies(time, y, bodies_.data());
      at.system.terms().read(time, bodies_.data());
      return offset_of_seat(limit, at.system.terms().bodies().data());
    };
    const auto height = [&](double time, const double* y) { return offset_at(time, y).z() + kThrough; };
    const double when = stepped ? at.integrator->locate(height).value_or(t) : t;
    if (when < t) at.integrator->interpolate(when, probe_.data());
    if (offset_at(when, probe_.data()).head<2>().norm() > limit.reach) continue;  // beside it, there
    events_.push_back({when, static_cast<int>(i), EventKind::through});
  }
  watching_ = true;
}

/// Within 3 deg of pitch 90 deg, at the end of the step or on the way there.
void Contacts::check_poles(double t) const {
  for (std::size_t i = 0; i < model_.limits.size(); ++i) {
    const Limit& limit = model_.limits[i];
    if (!has_pole(limit)) continue;
    const Vec3d &from = axis_before_[i], &to = axis_after_[i], way = from.cross(to);
    const bool passed =
        from.head<2>().dot(to.head<2>()) < 0.0 && std::abs(way.z()) < kSingularPitch * way.norm();
    if (!passed && to.head<2>().norm() >= kSingularPitch) continue;
    throw std::domain_error(
        "limit '" + limit.name + "' on joint '" + model_.description.joints[idx(limit.joint)].name +
        "': pitch is near 90 deg at t = " + at_time(t) + " s, where " + limit.described.coordinate +
        " is not defined; keep pitch within bounds by a stop, or take a joint whose "
        "frame keeps its pitch small");
  }
}

/// Forces of closed limits in the middle of the last step.
void Contacts::look_inside(Stepper& at) {
  const double t = 0.5 * (at.integrator->previous_time() + at.integrator->time());
  at.integrator->interpolate(t, state_.data());
  at.stepped.project(t, state_.data(), false);
  at.write_bodies(t, state_.data(), bodies_.data());
  at.system.derivative(t, bodies_.data(), rate_.data());
  for (std::size_t i = 0; i < middle_.size(); ++i) {
    const Limit& limit = at.model->limits[i];
    if (limit.element >= 0)
      middle_[i] = limit_force(limit, at.system.terms(), at.system.multipliers().data());
  }
}

void Contacts::read_forces(const Stepper& at, double* out) const {
  for (std::size_t i = 0; i < after_.size(); ++i) {
    const bool holds = at.model->limits[i].element >= 0;
    out[i] = holds ? middle_[i] : 0.0;
    out[after_.size() + i] = holds ? after_[i].value : 0.0;
  }
}

/// Where in the last step, as a part of it, a limit's quantity is surely negative, or may be least; 0:
/// nowhere.
Contacts::Dip Contacts::dip(Stepper& at, std::size_t i) const {
  const Limit& limit = at.model->limits[i];
  const Watched &from = before_[i], &to = after_[i];
  if (limit.element >= 0) {
    if (middle_[i] < 0.0) return {0.5, true, middle_[i]};
    if (to.value < 0.0) return {1.0, true, to.value};
    const auto [s, least] = least_of_parabola(from.value, middle_[i], to.value);
    return least < kLikelyDip * std::min(from.value, to.value) ? Dip{s, false, 0.0} : Dip{};
  }
  if (!limit.kind->closes_again) return {};
  if (to.value < -kTouch) return {1.0, true, to.value};
  if (!(from.rate < 0.0 && to.rate > 0.0)) return {};
  const double h = at.integrator->time() - at.integrator->previous_time();
  const auto [s, least] = least_of_cubic(from.value, h * from.rate, to.value, h * to.rate);
  return least < kLikelyDip * std::min(from.value, to.value) ? Dip{s, false, 0.0} : Dip{};
}

std::optional<double> Contacts::find(Stepper& at) {
  const Integrator& integrator = *at.integrator;
  const double end = integrator.time();
  if (at.model->closed != 0) look_inside(at);
  before_.swap(after_);
  axis_before_.swap(axis_after_);
  at.write_bodies(end, integrator.state(), bodies_.data());
  watch(at, end, bodies_.data());
  std::optional<double> first;
  const auto found = [&](double t, std::size_t i, bool parted) {
    first = t;
    found_ = static_cast<int>(i);
    parted_ = parted;
  };
  for (std::size_t i = 0; i < after_.size(); ++i) {
    if (after_[i].slack > kParted) {
      const double t = locate_parting(at, i);
      if (!first || t < *first) found(t, i, true);
    }
    const std::optional<double> t = locate_change(at, i);
    if (t && (!first || *t < *first)) found(*t, i, false);
  }
  if (first) {
    integrator.interpolate(*first, probe_.data());
    at.stepped.project(*first, probe_.data(), false);
    at.write_bodies(*first, probe_.data(), bodies_.data());
    at.system.terms().read(*first, bodies_.data());
    read_axes(at);
  } else {
    look_below_seats(at, end, true);
  }
  check_poles(first.value_or(end));
  return first;
}

/// When in the last step a limit begins to hold or lets go.
std::optional<double> Contacts::locate_change(Stepper& at, std::size_t i) {
  const Integrator& integrator = *at.integrator;
  const double start = integrator.previous_time(), end = integrator.time();
  const Limit& limit = at.model->limits[i];
  Dip d = dip(at, i);
  if (d.part == 0.0) return std::nullopt;
  const double until = d.part == 1.0 ? end : std::min(end, start + d.part * (end - start));
  if (!d.negative) {
    integrator.interpolate(until, probe_.data());
    d.value = watched_value(at, limit, until, probe_.data());
    if (!(d.value < (limit.element < 0 ? -kTouch : 0.0))) return std::nullopt;
  }
  if (limit.element < 0) return locate_overlap(at, i, until, d.value);
  return locate(at, i, start, until, d.value, 0.0);
}

/// Where a gap that is negative at `until` closes; nothing where it does not get smaller there: that overlap
/// is an error of the integration, after a release above all. A bound that is left and reached again is
/// searched from where the gap is largest on: rounding at the start would pass for the bound reached. A hop
/// too low to be distinguished from zero ends there, and the limit holds.
std::optional<double> Contacts::locate_overlap(Stepper& at, std::size_t i, double until, double value) {
  const Watched& from = before_[i];
  const Limit& limit = at.model->limits[i];
  const double start = at.integrator->previous_time();
  const auto gap_at = [&](double t, const double* y) {
    watched_value(at, limit, t, y);
    return gap(limit, at.system.terms());
  };
  const auto look = [&](double t) {
    at.integrator->interpolate(t, probe_.data());
    return gap_at(t, probe_.data());
  };
  if (from.value > kTouch) return locate(at, i, start, until, value, 0.0);
  if (from.rate <= kStill) {
    if (from.value <= -kTouch) return start;
    const double t = locate(at, i, start, until, value, kTouch);
    const bool falls = look(t).rate < -std::max(kStill, kFallSpeed * limit.sticking_speed);
    return falls || value < -0.1 * kMisfit ? std::optional(t) : std::nullopt;
  }
  const double last_rate = look(until).rate;
  if (!(last_rate < 0.0)) return std::nullopt;
  const double top = at.integrator
                         ->locate([&](double t, const double* y) {
                           if (t <= start) return from.rate;
                           return t >= until ? last_rate : gap_at(t, y).rate;
                         })
                         .value_or(until);
  return look(top).value > 0.0 ? locate(at, i, top, until, value, 0.0) : top;
}

/// Where limits that hold cannot all do so any more.
double Contacts::locate_parting(Stepper& at, std::size_t i) {
  const double start = at.integrator->previous_time(), end = at.integrator->time();
  const auto located = at.integrator->locate([&](double t, const double* y) {
    if (t <= start) return std::max(kParted - before_[i].slack, 1e-3 * kParted);
    if (t >= end) return kParted - after_[i].slack;
    std::copy_n(y, at.stepped.size(), state_.data());
    at.stepped.project(t, state_.data(), false);
    at.write_bodies(t, state_.data(), bodies_.data());
    constraint_residual(at.system.terms(), t, bodies_.data());
    return kParted - slack(at.model->limits[i], at);
  });
  return located.value_or(end);
}

/// Where a quantity falls below -`level` between `since` and `until`, where it is `value`. It starts with
/// nothing negative but rounding, whatever the sign of that.
double Contacts::locate(Stepper& at, std::size_t i, double since, double until, double value, double level) {
  const double first = std::max(before_[i].value, -1e-3 * value) + level;
  const auto located = at.integrator->locate([&](double t, const double* y) {
    if (t <= since) return first;
    return (t >= until ? value : watched_value(at, at.model->limits[i], t, y)) + level;
  });
  return located.value_or(until);
}

}  // namespace seacrane
