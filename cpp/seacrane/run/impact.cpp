// Which limits hold from an event on: impacts, and limits that would pull.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/run/complementarity.hpp"
#include "seacrane/run/contacts.hpp"

namespace seacrane {
namespace {

constexpr double kFall = 1e-9;            // m/s2 or rad/s2: accelerations that are rounding
constexpr double kPullRounding = 1e-12;   // of the largest impulse
constexpr double kNoShare = 1e-9;         // of the largest force: limits that carry less let go
constexpr double kDependentImpact = 1e4;  // times the impulse that one body alone would take: rows depend
constexpr std::size_t kChatterCount = 64;
constexpr double kChatterTime = 1e-6;  // s

double acceleration_of(const CoordinateRow<double>& row, const Vec6d& first, const Vec6d& second) {
  return row.da.dot(first) + row.db.dot(second) - row.gamma;
}

/// Limits that are touched at once, and what forces along them do to the motion along each.
class Touched {
 public:
  Touched(Stepper& at, const std::vector<int>& limits)
      : at_(at),
        limits_(limits),
        load_(idx(at.model->body_count()) + 1, Vec6d::Zero()),
        change_(load_),
        right_(idx(at.model->rows()), 0.0),
        impulse_(right_) {}

  const Limit& limit(Eigen::Index i) const { return at_.model->limits[idx(limits_[idx(i)])]; }

  /// Row i, column j: along i for 1 N, or 1 N m, along j.
  MatXd responses() {
    const auto n = static_cast<Eigen::Index>(limits_.size());
    MatXd out(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      push(limit(j), 1.0);
      respond();
      for (Eigen::Index i = 0; i < n; ++i) {
        const CoordinateRow<double> row = row_of(limit(i));
        const JointData& joint = limit(i).coordinate.joint;
        out(i, j) =
            limit(i).side * (row.da.dot(change_[idx(joint.first)]) + row.db.dot(change_[idx(joint.second)]));
      }
    }
    return out;
  }
  /// The bodies' change for an impulse along each.
  const std::vector<Vec6d>& hit(const VecXd& impulses) {
    for (Eigen::Index j = 0; j < impulses.size(); ++j) push(limit(j), impulses[j]);
    respond();
    return change_;
  }
  /// Of the last change, J.
  double driver_work() const {
    double sum = 0.0;
    for (std::size_t e = 0; e < at_.model->elements.size(); ++e) {
      const ElementModel& element = at_.model->elements[e];
      if (element.driver) sum += impulse_[idx(element.row)] * at_.system.terms().blocks()[e].nu[0];
    }
    return sum;
  }
  /// Accelerations along each, at the last derivative.
  VecXd falls() const {
    VecXd out(static_cast<Eigen::Index>(limits_.size()));
    const auto& a = at_.system.accelerations();
    for (Eigen::Index j = 0; j < out.size(); ++j) {
      const JointData& joint = limit(j).coordinate.joint;
      out[j] = limit(j).side * acceleration_of(row_of(limit(j)), a[idx(joint.first)], a[idx(joint.second)]);
    }
    return out;
  }

 private:
  CoordinateRow<double> row_of(const Limit& limit) const {
    return evaluate_limit(limit, at_.system.terms().bodies().data());
  }
  void push(const Limit& limit, double force) {
    const CoordinateRow<double> row = row_of(limit);
    load_[idx(limit.coordinate.joint.first)] += force * limit.side * row.da;
    load_[idx(limit.coordinate.joint.second)] += force * limit.side * row.db;
  }
  void respond() {
    load_.back().setZero();
    at_.system.solver().solve(load_, right_, change_, impulse_);
    for (Vec6d& one : load_) one.setZero();
  }

  Stepper& at_;
  const std::vector<int>& limits_;
  std::vector<Vec6d> load_, change_;
  std::vector<double> right_, impulse_;
};

}  // namespace

/// Rebounds between several limits at one time are one impact, which ends by itself: times count.
void Contacts::note(const Event& event) {
  events_.push_back(event);
  if (!instants_.empty() && instants_.back() == event.time) return;
  instants_.push_back(event.time);
  if (instants_.size() < kChatterCount) return;
  const double since = instants_[instants_.size() - kChatterCount];
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

ClosedSet Contacts::carry_out(double t, double* bodies, ClosedSet closed) {
  stalled_ = t - last_pass_ <= kChatterTime / static_cast<double>(kChatterCount) ? stalled_ + 1 : 0;
  last_pass_ = t;
  if (stalled_ >= kChatterCount) report_chatter(t, found_, "passes that took no time");
  if (parted_) return release_loosest(t, bodies, closed);
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
    const auto inconsistent = [&](int i) { return consistency(at, i) != Consistency::holds; };
    int wrong = 0;
    while (wrong < count && !inconsistent(wrong)) ++wrong;
    if (wrong == count) return closed;
    if (consistency(at, wrong) == Consistency::struck) {
      closed = hit(t, bodies, closed, wrong);
    } else {
      closed ^= bit_of(wrong);
      note({t, wrong, holds(closed, wrong) ? EventKind::contact : EventKind::release});
    }
  }
  return settle_dependent(t, bodies, closed);
}

/// What a limit asks for at the state last evaluated: one that holds must not pull, one that is touched must
/// not be approached, and must not be pushed on.
Contacts::Consistency Contacts::consistency(const Stepper& at, int i) const {
  const Limit& limit = at.model->limits[idx(i)];
  if (limit.element >= 0) {
    const bool pulls = limit_force(limit, at.system.terms(), at.system.multipliers().data()) < 0.0;
    return pulls ? Consistency::changes : Consistency::holds;
  }
  if (!limit.kind->closes_again) return Consistency::holds;
  const Watched g = gap(limit, at.system.terms());
  if (g.value > kTouch || g.rate > kStill) return Consistency::holds;
  if (g.rate < -kStill) return Consistency::struck;
  const JointData& joint = limit.coordinate.joint;
  const auto& a = at.system.accelerations();
  const CoordinateRow<double> row = evaluate_limit(limit, at.system.terms().bodies().data());
  const double towards = limit.side * acceleration_of(row, a[idx(joint.first)], a[idx(joint.second)]);
  return towards < -kFall ? Consistency::changes : Consistency::holds;
}

/// Where limits cannot all hold, the loosest one lets go until the others can. Among equally loose ones it is
/// the one that carries least.
ClosedSet Contacts::release_loosest(double t, double* bodies, ClosedSet closed) {
  const int count = static_cast<int>(model_.limits.size());
  for (;;) {
    Stepper& at = stepper_(closed);
    at.system.project(t, bodies, false);
    at.system.derivative(t, bodies, rate_.data());
    double widest = 0.5 * kParted, least = 0.0;
    int loosest = -1;
    for (const bool choosing : {false, true}) {
      for (int i = 0; i < count; ++i) {
        const Limit& limit = at.model->limits[idx(i)];
        if (limit.element < 0) continue;
        const double open = slack(limit, at);
        const double force = limit_force(limit, at.system.terms(), at.system.multipliers().data());
        if (!choosing) {
          widest = std::max(widest, open);
        } else if (open >= 0.9 * widest && (loosest < 0 || force < least)) {
          loosest = i;
          least = force;
        }
      }
    }
    if (loosest < 0) return settle(t, bodies, closed);
    closed &= ~bit_of(loosest);
    note({t, loosest, EventKind::release});
  }
}

/// Contacts that depend on each other, where pivoting may go round in circles: impulses and forces of least
/// energy, without rebound. Limits that need not carry share the load where all of them push.
ClosedSet Contacts::settle_dependent(double t, double* bodies, ClosedSet closed) {
  const int count = static_cast<int>(model_.limits.size());
  ClosedSet seats = 0;
  for (int i = 0; i < count; ++i) {
    if (!model_.limits[idx(i)].kind->closes_again) seats |= closed & bit_of(i);
  }
  for (;;) {
    const ClosedSet next = least_energy(t, bodies, closed, seats);
    for (int i = 0; i < count; ++i) {
      if (holds(next, i) != holds(closed, i))
        note({t, i, holds(next, i) ? EventKind::contact : EventKind::release});
    }
    closed = next;
    Stepper& at = stepper_(closed);
    at.system.project(t, bodies, false);
    at.system.derivative(t, bodies, rate_.data());
    int lifted = -1;
    for (int i = 0; i < count; ++i) {
      const Limit& limit = at.model->limits[idx(i)];
      const bool pulls =
          limit.element >= 0 && limit_force(limit, at.system.terms(), at.system.multipliers().data()) < 0.0;
      if (pulls && holds(seats, i)) lifted = i;
      if (!pulls || holds(seats, i)) continue;
      throw ChatteringError("scene '" + model_.description.name +
                            "': no set of its limits is consistent at t = " + at_time(t) +
                            " s (friction-free contacts that depend on each other); remove redundant stops");
    }
    if (lifted < 0) return closed;
    seats &= ~bit_of(lifted);
  }
}

/// The limits that hold beside `seats` by the forces of least energy, after an impact of least energy where
/// any of them is approached.
ClosedSet Contacts::least_energy(double t, double* bodies, ClosedSet closed, ClosedSet seats) {
  Stepper& at = stepper_(seats);
  at.system.derivative(t, bodies, rate_.data());
  std::vector<int> near;
  for (int i = 0; i < static_cast<int>(model_.limits.size()); ++i) {
    const Limit& limit = at.model->limits[idx(i)];
    if (!limit.kind->closes_again) continue;
    const Watched g = gap(limit, at.system.terms());
    if (holds(closed, i) || (g.value <= kTouch && g.rate <= kStill)) near.push_back(i);
  }
  Touched touched(at, near);
  const MatXd g = touched.responses();
  VecXd rate(g.rows());
  for (Eigen::Index j = 0; j < rate.size(); ++j) rate[j] = gap(touched.limit(j), at.system.terms()).rate;
  if (rate.size() > 0 && rate.minCoeff() < -kStill) {
    const VecXd hit = complementary_forces(g, rate), after = rate + g * hit;
    double lost = 0.0;
    for (Eigen::Index j = 0; j < rate.size(); ++j) lost -= 0.5 * hit[j] * (rate[j] + after[j]);
    const std::vector<Vec6d>& change = touched.hit(hit);
    book(bodies, change, touched.driver_work(), lost);
    rate = after;
    at.system.derivative(t, bodies, rate_.data());
  }
  std::vector<Eigen::Index> stay;
  for (Eigen::Index j = 0; j < rate.size(); ++j) {
    if (rate[j] <= kStill) stay.push_back(j);
  }
  const MatXd g_stay = g(stay, stay);
  const VecXd fall = touched.falls()(stay), force = complementary_forces(g_stay, fall),
              left = g_stay * force + fall;
  ClosedSet carry = 0, idle = 0;
  const double none = kFall + kNoShare * (stay.empty() ? 0.0 : fall.cwiseAbs().maxCoeff());
  for (std::size_t k = 0; k < stay.size(); ++k) {
    const auto at_k = static_cast<Eigen::Index>(k);
    const ClosedSet bit = bit_of(near[idx(stay[k])]);
    if (force[at_k] > 0.0) carry |= bit;
    if (!(force[at_k] > 0.0) && left[at_k] <= none) idle |= bit;
  }
  return seats | carry | sharing(t, bodies, seats | carry, idle);
}

/// The limits of `idle` that push when they hold beside `carry`, and that let `carry` push.
ClosedSet Contacts::sharing(double t, const double* bodies, ClosedSet carry, ClosedSet idle) {
  const int count = static_cast<int>(model_.limits.size());
  while (idle != 0) {
    Stepper& at = stepper_(carry | idle);
    at.system.derivative(t, bodies, rate_.data());
    double least = 0.0, most = 0.0;
    int weakest = -1;
    for (int i = 0; i < count; ++i) {
      const Limit& limit = at.model->limits[idx(i)];
      if (limit.element < 0 || !limit.kind->closes_again) continue;
      const double force = limit_force(limit, at.system.terms(), at.system.multipliers().data());
      most = std::max(most, force);
      if (weakest >= 0 && force >= least) continue;
      least = force;
      weakest = i;
    }
    if (least > kNoShare * most) break;
    idle = holds(idle, weakest) ? idle & ~bit_of(weakest) : 0;
  }
  return idle;
}

/// The impulse that limit `i` takes in an impact, over what its two bodies alone would: large where rows
/// nearly depend on each other, and turn a slow impact into one that stops the motion.
double Contacts::amplification(Stepper& at, int i, double impulse, double speed) const {
  const Limit& limit = at.model->limits[idx(i)];
  const JointData& joint = limit.coordinate.joint;
  const CoordinateRow<double> row = evaluate_limit(limit, at.system.terms().bodies().data());
  double mobility = 0.0;
  for (const auto& [body, d] : {std::pair(joint.first, row.da), std::pair(joint.second, row.db)}) {
    if (body < model_.body_count()) mobility += d.dot(at.system.terms().mass_matrix(body).lu().solve(d));
  }
  return std::abs(impulse) * mobility / std::max(std::abs(speed), kStill);
}

/// Adds the change of twists by an impact; work takes up what it changed.
void Contacts::book(double* bodies, const std::vector<Vec6d>& change, double driver_work, double lost) {
  for (int b = 0; b < model_.body_count(); ++b) {
    view<6>(bodies + model_.layout.twist(b)) += change[idx(b)];
  }
  bodies[model_.layout.work] += driver_work - lost;
  bodies[model_.layout.work + 1] += std::abs(driver_work) + std::abs(lost);
  energy_lost_ += lost;
}

/// What is hit at the same time as limit `found`, or touched and approached then. `slow`: none of them faster
/// than its sticking_speed.
Contacts::Struck Contacts::struck_with(Stepper& at, double t, const double* bodies, int found) {
  at.system.terms().read(t, bodies);
  Struck out;
  for (int i = 0; i < static_cast<int>(model_.limits.size()); ++i) {
    const Limit& limit = at.model->limits[idx(i)];
    if (limit.element >= 0 || !limit.kind->closes_again) continue;
    const Watched g = gap(limit, at.system.terms());
    const bool here = i == found ? g.rate <= kStill : g.value <= kTouch && g.rate < -kStill;
    if (!here) continue;
    out.limits |= bit_of(i);
    out.slow = out.slow && -g.rate <= limit.sticking_speed;
  }
  return out;
}

/// The limit of least index that would pull in an impact; none where all push.
std::optional<int> Contacts::pulling(const Impact& impact, ClosedSet kept) const {
  double largest = 0.0;
  for (const double impulse : impact.impulse) largest = std::max(largest, std::abs(impulse));
  const double pull = -kPullRounding * largest;
  for (int i = 0; i < static_cast<int>(model_.limits.size()); ++i) {
    if (holds(kept, i) && impact.impulse[idx(i)] < pull) return i;
  }
  return std::nullopt;
}

/// Whether rows of struck limits nearly depend on each other in an impact.
bool Contacts::is_dependent(Stepper& at, const Impact& impact, ClosedSet struck) const {
  for (int i = 0; i < static_cast<int>(model_.limits.size()); ++i) {
    if (!holds(struck, i)) continue;
    if (amplification(at, i, impact.impulse[idx(i)], impact.speed[idx(i)]) > kDependentImpact) return true;
  }
  return false;
}

/// A slow impact releases no limit: limits that hit and release each other in turn would otherwise do so
/// without end, slower and slower. Where a limit would have to pull afterwards, settle() opens it by its
/// force.
ClosedSet Contacts::hit(double t, double* bodies, ClosedSet closed, int found) {
  const Struck struck = struck_with(stepper_(closed), t, bodies, found);
  for (ClosedSet kept = closed | struck.limits;;) {
    Stepper& at = stepper_(kept);
    const Impact impact = collide(at, t, bodies, struck.limits);
    const std::optional<int> pulls = pulling(impact, kept);
    if (!pulls || (struck.slow && !is_dependent(at, impact, struck.limits & kept))) {
      return end_impact(t, bodies, impact, closed, struck.limits, kept);
    }
    kept &= ~bit_of(*pulls);
  }
}

/// Changes the state by an impact and notes its events; returns the limits that hold afterwards.
ClosedSet Contacts::end_impact(double t, double* bodies, const Impact& impact, ClosedSet closed,
                               ClosedSet struck, ClosedSet kept) {
  double lost = 0.0;
  for (const double of_limit : impact.lost) lost += of_limit;
  book(bodies, impact.change, impact.driver_work, lost);
  for (int i = 0; i < static_cast<int>(model_.limits.size()); ++i) {
    if (holds(closed, i) && !holds(kept, i)) note({t, i, EventKind::release});
    if (!holds(struck, i) || !holds(kept, i)) continue;
    const bool back = impact.rebounds[idx(i)];
    note({t, i, back ? EventKind::rebound : EventKind::contact, impact.speed[idx(i)], impact.impulse[idx(i)],
          impact.lost[idx(i)]});
    if (back) kept &= ~bit_of(i);
  }
  return kept;
}

/// The impact in which the limits of `at` hold and those of `struck` are hit.
Contacts::Impact Contacts::collide(Stepper& at, double t, const double* bodies, ClosedSet struck) {
  MaximalSystem& system = at.system;
  const auto count = model_.limits.size(), rows = idx(at.model->rows());
  Impact out;
  out.impulse.assign(count, 0.0);
  out.speed.assign(count, 0.0);
  out.lost.assign(count, 0.0);
  out.rebounds.assign(count, false);
  system.derivative(t, bodies, rate_.data());
  std::vector<double> before(rows), right(rows), impulse(rows);
  rate_residual(system.terms(), bodies, before.data());
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
  system.solver().solve(std::vector<Vec6d>(out.change), right, out.change, impulse);
  for (std::size_t i = 0; i < count; ++i) {
    const Limit& limit = at.model->limits[i];
    if (limit.element < 0) continue;
    out.impulse[i] = limit_force(limit, system.terms(), impulse.data());
    if (!holds(struck, static_cast<int>(i))) continue;
    const auto row = idx(at.model->elements[idx(limit.element)].row);
    out.lost[i] = -impulse[row] * (before[row] + 0.5 * right[row]);
  }
  for (std::size_t e = 0; e < at.model->elements.size(); ++e) {
    const ElementModel& element = at.model->elements[e];
    if (element.driver) out.driver_work += impulse[idx(element.row)] * system.terms().blocks()[e].nu[0];
  }
  return out;
}

}  // namespace seacrane
