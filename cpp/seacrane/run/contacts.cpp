#include "seacrane/run/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace seacrane {
namespace {

constexpr double kMisfit = 1e-3;     // m or rad: of a state that is none of the scene
constexpr double kTouch = 1e-10;     // m or rad: gaps below it are closed, and overlaps rounding
constexpr double kStill = 1e-9;      // m/s or rad/s: rates that are rounding
constexpr double kFall = 1e-9;       // m/s2 or rad/s2: likewise
constexpr double kRounding = 1e-12;  // of the largest impulse
constexpr double kLikelyDip = 0.25;  // of the smaller end: an estimated minimum below it is looked at
constexpr std::size_t kChatterCount = 64;
constexpr double kChatterTime = 1e-6;  // s

std::string at_time(double t) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", t);
  return text;
}

/// Where in (0, 1) the cubic through values and slopes (times the step) at both ends is least, for a slope
/// that is negative at first and positive at last; its value there.
std::pair<double, double> least_of_cubic(double y0, double m0, double y1, double m1) {
  const double rise = y1 - y0, b = 3.0 * rise - 2.0 * m0 - m1, a = m0 + m1 - 2.0 * rise;
  const double s = -m0 / (b + std::sqrt(std::max(0.0, b * b - 3.0 * a * m0)));
  return {s, y0 + s * (m0 + s * (b + s * a))};
}

/// The same of the parabola through values at 0, 1/2 and 1; at 0 where it is least at an end.
std::pair<double, double> least_of_parabola(double y0, double ym, double y1) {
  const double c = 2.0 * (y0 - 2.0 * ym + y1), b = -3.0 * y0 + 4.0 * ym - y1;
  const double s = c > 0.0 ? -b / (2.0 * c) : 0.0;
  if (!(s > 0.0 && s < 1.0)) return {0.0, y0};
  return {s, y0 + s * (b + s * c)};
}

double acceleration_of(const CoordinateRow<double>& row, const Vec6d& first, const Vec6d& second) {
  return row.da.dot(first) + row.db.dot(second) - row.gamma;
}

}  // namespace

const char* to_text(EventKind kind) {
  switch (kind) {
    case EventKind::contact:
      return "contact";
    case EventKind::rebound:
      return "rebound";
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
      middle_(model.limits.size()) {}

Contacts::Watched Contacts::gap(const Limit& limit, const RedundantSystem& system) const {
  const auto& bodies = system.bodies();
  const CoordinateRow<double> row = evaluate_limit(limit, bodies.data());
  const JointData& joint = limit.coordinate.joint;
  const double rate = coordinate_rate(row, bodies[idx(joint.first)], bodies[idx(joint.second)]);
  return {limit.side * row.value, limit.side * rate};
}

void Contacts::check(Stepper& at, double t, const double* bodies) const {
  at.system.residual(t, bodies);
  for (const Limit& limit : at.model->limits) {
    double misfit = 0.0;
    if (limit.element >= 0) {
      const auto& phi = at.system.blocks()[idx(limit.element)].phi;
      misfit = phi.head(at.model->elements[idx(limit.element)].rows).cwiseAbs().maxCoeff();
    } else if (limit.kind != LimitKind::seat) {
      misfit = -gap(limit, at.system).value;
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
    at.system.read_kinematics(t, bodies);
  }
}

double Contacts::watched_value(Stepper& at, const Limit& limit, double t, const double* y) {
  std::copy_n(y, at.stepped.size(), state_.data());
  at.stepped.project(t, state_.data(), false);
  at.stepped.write_bodies(t, state_.data(), bodies_.data());
  if (limit.element < 0) {
    at.system.read_kinematics(t, bodies_.data());
    return gap(limit, at.system).value;
  }
  at.system.derivative(t, bodies_.data(), rate_.data());
  return limit_force(limit, at.system, at.system.multipliers().data());
}

void Contacts::watch(Stepper& at, double t, const double* bodies) {
  state_.resize(at.stepped.size());
  probe_.resize(at.stepped.size());
  evaluate(at, t, bodies);
  for (std::size_t i = 0; i < after_.size(); ++i) {
    const Limit& limit = at.model->limits[i];
    if (limit.element >= 0) {
      after_[i] = {limit_force(limit, at.system, at.system.multipliers().data()), 0.0};
    } else if (limit.kind != LimitKind::seat) {
      after_[i] = gap(limit, at.system);
    }
  }
}

/// Forces of closed limits in the middle of the last step.
void Contacts::look_inside(Stepper& at) {
  const double t = 0.5 * (at.integrator->previous_time() + at.integrator->time());
  at.integrator->interpolate(t, state_.data());
  at.stepped.project(t, state_.data(), false);
  at.stepped.write_bodies(t, state_.data(), bodies_.data());
  at.system.derivative(t, bodies_.data(), rate_.data());
  for (std::size_t i = 0; i < middle_.size(); ++i) {
    const Limit& limit = at.model->limits[i];
    if (limit.element >= 0) middle_[i] = limit_force(limit, at.system, at.system.multipliers().data());
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
  if (limit.kind == LimitKind::seat) return {};
  if (to.value < -kTouch) return {1.0, true, to.value};
  if (!(from.rate < 0.0 && to.rate > 0.0)) return {};
  const double h = at.integrator->time() - at.integrator->previous_time();
  const auto [s, least] = least_of_cubic(from.value, h * from.rate, to.value, h * to.rate);
  return least < kLikelyDip * std::min(from.value, to.value) ? Dip{s, false, 0.0} : Dip{};
}

std::optional<double> Contacts::find(Stepper& at) {
  const Integrator& integrator = *at.integrator;
  const double start = integrator.previous_time(), end = integrator.time();
  if (at.model->closed != 0) look_inside(at);
  before_.swap(after_);
  at.stepped.write_bodies(end, integrator.state(), bodies_.data());
  watch(at, end, bodies_.data());
  std::optional<double> first;
  for (std::size_t i = 0; i < after_.size(); ++i) {
    Dip d = dip(at, i);
    if (d.part == 0.0) continue;
    const Limit& limit = at.model->limits[i];
    const double until = d.part == 1.0 ? end : start + d.part * (end - start);
    if (!d.negative) {
      integrator.interpolate(until, probe_.data());
      d.value = watched_value(at, limit, until, probe_.data());
      if (!(d.value < (limit.element < 0 ? -kTouch : 0.0))) continue;
    }
    const double t = locate(at, i, until, d.value);
    if ((first && *first <= t) || (limit.element < 0 && !approached(at, limit, t))) continue;
    first = t;
    found_ = static_cast<int>(i);
    unresolved_ = limit.element < 0 && before_[i].value < -kTouch;
  }
  return first;
}

/// A gap that is negative and does not get smaller is an error of the integration, after a release above all.
bool Contacts::approached(Stepper& at, const Limit& limit, double t) {
  at.integrator->interpolate(t, probe_.data());
  watched_value(at, limit, t, probe_.data());
  return gap(limit, at.system).rate < -kStill;
}

/// A step starts with nothing negative but rounding, whatever the sign of that.
double Contacts::locate(Stepper& at, std::size_t i, double until, double value) {
  const double start = at.integrator->previous_time();
  const double at_start = std::max(before_[i].value, -1e-3 * value);
  const auto located = at.integrator->locate([&](double t, const double* y) {
    if (t <= start) return at_start;
    return t >= until ? value : watched_value(at, at.model->limits[i], t, y);
  });
  return located.value_or(until);
}

void Contacts::note(const Event& event) {
  events_.push_back(event);
  if (events_.size() < kChatterCount) return;
  const double since = events_[events_.size() - kChatterCount].time;
  if (event.time - since > kChatterTime) return;
  report_chatter(event.time, event.limit, "events within " + to_text(kChatterTime) + " s");
}

void Contacts::report_chatter(double t, int limit, const std::string& what) const {
  const Limit& at = model_.limits[idx(limit)];
  throw ChatteringError("limit '" + at.name + "' on joint '" + model_.description.joints[idx(at.joint)].name +
                        "': chatters, " + std::to_string(kChatterCount) + " " + what +
                        " at t = " + at_time(t) +
                        " s; give a sticking_speed above the speed of its last rebounds, a lower "
                        "restitution, shorter steps or a soft stop");
}

ClosedSet Contacts::pass(double t, double* bodies, ClosedSet closed) {
  stalled_ = t - last_pass_ <= kChatterTime / static_cast<double>(kChatterCount) ? stalled_ + 1 : 0;
  last_pass_ = t;
  if (stalled_ >= kChatterCount) report_chatter(t, found_, "passes that took no time");
  late_ = unresolved_ ? late_ + 1 : 0;
  if (late_ >= kChatterCount) report_chatter(t, found_, "rebounds shorter than a step");
  const ClosedSet bit = bit_of(found_);
  if ((closed & bit) != 0) {
    note({t, found_, EventKind::release});
    return settle(t, bodies, closed & ~bit);
  }
  return settle(t, bodies, hit(t, bodies, closed, found_));
}

ClosedSet Contacts::settle(double t, double* bodies, ClosedSet closed) {
  const int count = static_cast<int>(model_.limits.size());
  for (int turn = 0; turn < 4 * count + 16; ++turn) {
    Stepper& at = stepper_(closed);
    at.system.project(t, bodies, false);
    at.system.derivative(t, bodies, rate_.data());
    int wrong = 0;
    bool struck = false;
    for (; wrong < count; ++wrong) {
      const Limit& limit = at.model->limits[idx(wrong)];
      if (limit.element >= 0) {
        if (limit_force(limit, at.system, at.system.multipliers().data()) < 0.0) break;
        continue;
      }
      if (limit.kind == LimitKind::seat) continue;
      const Watched g = gap(limit, at.system);
      if (g.value > kTouch || g.rate > kStill) continue;
      struck = g.rate < -kStill;
      const JointData& joint = limit.coordinate.joint;
      const auto& a = at.system.acceleration();
      const CoordinateRow<double> row = evaluate_limit(limit, at.system.bodies().data());
      if (struck || limit.side * acceleration_of(row, a[idx(joint.first)], a[idx(joint.second)]) < -kFall)
        break;
    }
    if (wrong == count) return closed;
    if (struck) {
      closed = hit(t, bodies, closed, wrong);
    } else {
      closed ^= bit_of(wrong);
      note({t, wrong, holds(closed, wrong) ? EventKind::contact : EventKind::release});
    }
  }
  throw ChatteringError("scene '" + model_.description.name +
                        "': no set of its limits is consistent at t = " + at_time(t) +
                        " s (friction-free contacts that depend on each other); remove redundant stops");
}

/// What is hit at the same time as limit `found`, or touched and approached then. `slow`: none of them faster
/// than its sticking_speed.
ClosedSet Contacts::struck_with(Stepper& at, double t, const double* bodies, int found, bool& slow) {
  at.system.read_kinematics(t, bodies);
  ClosedSet out = 0;
  slow = true;
  for (int i = 0; i < static_cast<int>(model_.limits.size()); ++i) {
    const Limit& limit = at.model->limits[idx(i)];
    if (limit.element >= 0 || limit.kind == LimitKind::seat) continue;
    const Watched g = gap(limit, at.system);
    const bool here = i == found ? g.rate <= kStill : g.value <= kTouch && g.rate < -kStill;
    if (!here) continue;
    out |= bit_of(i);
    slow = slow && -g.rate <= limit.sticking_speed;
  }
  return out;
}

/// A slow impact lets nothing go: limits that hit and free each other by turns would otherwise do so without
/// end, slower and slower. What would pull then, settle() opens by its force.
ClosedSet Contacts::hit(double t, double* bodies, ClosedSet closed, int found) {
  const int count = static_cast<int>(model_.limits.size());
  bool slow = true;
  const ClosedSet struck = struck_with(stepper_(closed), t, bodies, found, slow);
  ClosedSet kept = closed | struck;
  for (;;) {
    Stepper& at = stepper_(kept);
    const Impact impact = collide(at, t, bodies, struck);
    double largest = 0.0;
    for (const double impulse : impact.impulse) largest = std::max(largest, std::abs(impulse));
    const double pull = -kRounding * largest;
    int pulls = 0;
    while (pulls < count && !(holds(kept, pulls) && impact.impulse[idx(pulls)] < pull)) ++pulls;
    if (pulls < count && !slow) {
      kept &= ~bit_of(pulls);
      continue;
    }
    for (int b = 0; b < model_.body_count(); ++b) {
      view<6>(bodies + model_.layout.twist(b)) += impact.change[idx(b)];
    }
    double lost = 0.0;
    for (int i = 0; i < count; ++i) lost += impact.lost[idx(i)];
    bodies[model_.layout.work] += impact.driver_work - lost;
    bodies[model_.layout.work + 1] += std::abs(impact.driver_work) + std::abs(lost);
    energy_lost_ += lost;
    for (int i = 0; i < count; ++i) {
      if (holds(closed, i) && !holds(kept, i)) note({t, i, EventKind::release});
      if (!holds(struck, i) || !holds(kept, i)) continue;
      const bool back = impact.rebounds[idx(i)];
      note({t, i, back ? EventKind::rebound : EventKind::contact, impact.speed[idx(i)],
            impact.impulse[idx(i)], impact.lost[idx(i)]});
      if (back) kept &= ~bit_of(i);
    }
    return kept;
  }
}

/// The impact in which the limits of `at` hold and those of `struck` are hit.
Contacts::Impact Contacts::collide(Stepper& at, double t, const double* bodies, ClosedSet struck) {
  RedundantSystem& system = at.system;
  const auto count = model_.limits.size(), rows = idx(at.model->rows());
  Impact out;
  out.impulse.assign(count, 0.0);
  out.speed.assign(count, 0.0);
  out.lost.assign(count, 0.0);
  out.rebounds.assign(count, false);
  system.derivative(t, bodies, rate_.data());
  std::vector<double> before(rows), right(rows), impulse(rows);
  system.rate_residual(bodies, before.data());
  for (std::size_t r = 0; r < rows; ++r) right[r] = -before[r];
  for (std::size_t i = 0; i < count; ++i) {
    const Limit& limit = at.model->limits[i];
    if (limit.element < 0 || !holds(struck, static_cast<int>(i))) continue;
    const auto row = idx(at.model->elements[idx(limit.element)].row);
    out.speed[i] = -limit.side * before[row];
    out.rebounds[i] = limit.restitution > 0.0 && out.speed[i] > limit.sticking_speed;
    if (out.rebounds[i]) right[row] *= 1.0 + limit.restitution;
  }
  out.change.assign(idx(model_.body_count()) + 1, Vec6d::Zero());
  system.solve(std::vector<Vec6d>(out.change), right, out.change, impulse);
  for (std::size_t i = 0; i < count; ++i) {
    const Limit& limit = at.model->limits[i];
    if (limit.element < 0) continue;
    out.impulse[i] = limit_force(limit, system, impulse.data());
    if (!holds(struck, static_cast<int>(i))) continue;
    const auto row = idx(at.model->elements[idx(limit.element)].row);
    out.lost[i] = -impulse[row] * (before[row] + 0.5 * right[row]);
  }
  for (std::size_t e = 0; e < at.model->elements.size(); ++e) {
    const ElementModel& element = at.model->elements[e];
    if (element.driver) out.driver_work += impulse[idx(element.row)] * system.blocks()[e].nu[0];
  }
  return out;
}

}  // namespace seacrane
