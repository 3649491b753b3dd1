#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <stdexcept>

#include "seacrane/compile/steps.hpp"
#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"

namespace seacrane {
namespace {

constexpr double kClosed = 1e-9;  // m, rad: a loop open by more than this is contradictory
constexpr int kRestarts = 6;      // of the projection's own Newton iterations

double largest(const ElementModel& e, const Vec6d& phi) {
  return e.rows == 0 ? 0.0 : phi.head(e.rows).cwiseAbs().maxCoeff();
}

/// Joints on the way from `from` to `to` that does not use element `without`; empty when there is none.
std::vector<std::string> path(const Model& m, int from, int to, std::size_t without) {
  std::vector<int> came_by(idx(m.body_count()) + 1, -2);
  came_by[idx(from)] = -1;
  std::queue<int> open({from});
  while (!open.empty() && came_by[idx(to)] == -2) {
    const int b = open.front();
    open.pop();
    for (std::size_t e = 0; e < m.elements.size(); ++e) {
      const ElementModel& element = m.elements[e];
      if (e == without || element.rows == 0 || element.driver) continue;
      if (element.first != b && element.second != b) continue;
      const int next = element.first == b ? element.second : element.first;
      if (came_by[idx(next)] != -2) continue;
      came_by[idx(next)] = static_cast<int>(e);
      open.push(next);
    }
  }
  std::vector<std::string> names;
  if (came_by[idx(to)] == -2) return names;
  for (int b = to; b != from;) {
    const ElementModel& e = m.elements[idx(came_by[idx(b)])];
    names.push_back(e.name);
    b = e.first == b ? e.second : e.first;
  }
  return names;
}

[[noreturn]] void report_open(const Model& m, const Terms& terms) {
  std::size_t worst = 0;
  double gap = 0.0;
  std::string names;
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const double r = largest(m.elements[e], terms.blocks()[e].phi);
    if (r > kClosed) {
      names += (names.empty() ? "'" : ", '") + m.elements[e].name + "' (" + to_text(r) + ")";
    }
    if (r > gap || !std::isfinite(r)) {
      gap = r;
      worst = e;
    }
  }
  const ElementModel& element = m.elements[worst];
  std::string loop = "'" + element.name + "'";
  for (const auto& name : path(m, element.first, element.second, worst)) loop += " - '" + name + "'";
  throw SceneError("joint '" + element.name + "': the loop " + loop + " does not close, " + to_text(gap) +
                   " m or rad are left at best; contradictory: " + names +
                   ". Correct their points, axes, lengths or drivers, or the described poses");
}

[[noreturn]] void report_rates(const Model& m, const Terms& terms, const double* y) {
  std::vector<double> rates(idx(m.rows()));
  const double worst = rate_residual(terms, y, rates.data());
  std::string names;
  for (const ElementModel& e : m.elements) {
    double left = 0.0;
    for (int i = 0; i < e.rows; ++i) left = std::max(left, std::abs(rates[idx(e.row + i)]));
    if (left > kClosed) names += (names.empty() ? "'" : ", '") + e.name + "' (" + to_text(left) + ")";
  }
  throw SceneError("scene '" + m.description.name + "': the prescribed rates contradict each other, " +
                   to_text(worst) + " m/s or rad/s are left at best; contradictory: " + names +
                   ". Correct the drivers' curves at the start, or remove a joint");
}

/// The direction between coincident points is undefined: no Newton step can start from there.
void check_regular(const Model& m, const Terms& terms) {
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const int rows = m.elements[e].rows;
    const RowBlock<double>& block = terms.blocks()[e];
    if (rows == 0 || (block.d[0].topRows(rows).allFinite() && block.d[1].topRows(rows).allFinite())) continue;
    throw SceneError(std::string(m.elements[e].driver ? "driver" : "joint") + " '" + m.elements[e].name +
                     "': its direction is undefined at the described poses (its two points coincide, or its "
                     "angles are singular); describe the bodies elsewhere");
  }
}

void close(Model& m, MaximalSystem& system) {
  double* y = m.initial_state.data();
  std::vector<double> best = m.initial_state;
  double least = std::numeric_limits<double>::infinity();
  try {
    for (int i = 0; i < kRestarts && !(least < 1e-12); ++i) {
      ++m.assembly.iterations;
      system.project(0.0, y, false);
      const double left = constraint_residual(system.terms(), 0.0, y).position;
      if (!(left < least)) continue;  // a mechanism that does not close wanders
      least = left;
      best = m.initial_state;
    }
    m.initial_state = best;
  } catch (const std::domain_error& error) {
    throw SceneError("scene '" + m.description.name +
                     "': its joints do not close from the described poses; " + error.what());
  }
}

/// Rows like u . w = 0 also hold with an axis turned by 180 deg: that is another assembly.
void check_branch(const Model& m, const Terms& terms) {
  for (const JointKind& kind : joint_kinds()) {
    if (!kind.parallel_axes) continue;
    for (const JointData& j : m.joints[kind.index]) {
      const Mat3d a = terms.bodies()[idx(j.first)].rotation * j.first_axes;
      const Mat3d b = terms.bodies()[idx(j.second)].rotation * j.second_axes;
      const bool flipped =
          a.col(2).dot(b.col(2)) < 0.0 || (kind.aligned_axes && a.col(0).dot(b.col(0)) < 0.0);
      if (flipped) {
        throw SceneError("joint '" + m.elements[idx(j.element)].name +
                         "': closes only with its axes turned by 180 deg; correct the axes of its frames");
      }
    }
  }
}

void report_moves(const Model& m, const std::vector<double>& before, AssemblyReport& out) {
  const auto rotation = [&](const std::vector<double>& y, int b) {
    const double* pose = &y[idx(m.layout.pose(b))] + 3;
    return m.layout.pose_size == 7 ? rotation_from_quaternion<double>(view<4>(pose))
                                   : rotation_from_euler_xyz<double>(view<3>(pose));
  };
  double most = 0.0;
  for (int b = 0; b < m.body_count(); ++b) {
    const auto p0 = view<3>(&before[idx(m.layout.pose(b))]),
               p1 = view<3>(&m.initial_state[idx(m.layout.pose(b))]);
    const double moved = (p1 - p0).norm();
    const Mat3d turn = rotation(m.initial_state, b) * rotation(before, b).transpose();
    const Vec3d axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    const double turned = std::atan2(0.5 * axis.norm(), 0.5 * (turn.trace() - 1.0));
    out.largest_translation = std::max(out.largest_translation, moved);
    out.largest_rotation = std::max(out.largest_rotation, turned);
    if (moved + turned > most) {
      most = moved + turned;
      out.most_moved = m.bodies[idx(b)].name;
    }
    const auto v0 = view<6>(&before[idx(m.layout.twist(b))]),
               v1 = view<6>(&m.initial_state[idx(m.layout.twist(b))]);
    out.velocity_change = std::max(out.velocity_change, (v1 - v0).cwiseAbs().maxCoeff());
  }
}

/// Elements open as described, worst first.
std::vector<std::pair<std::string, double>> open_elements(const Model& m, const Terms& terms) {
  std::vector<std::pair<std::string, double>> out;
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const double gap = largest(m.elements[e], terms.blocks()[e].phi);
    if (gap > kClosed) out.emplace_back(m.elements[e].name, gap);
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return out;
}

void mark_redundant(Model& m, const VecXd& shared) {
  for (auto& e : m.elements) {
    if (e.rows == 0) continue;
    e.unique_reaction = shared.size() == 0 || shared.segment(e.row, e.rows).norm() < 1e-7;
    if (!e.unique_reaction) m.assembly.redundant.push_back(e.name);
  }
}

}  // namespace

void assemble(Model& model) {
  if (model.rows() == 0) return;
  AssemblyReport& report = model.assembly;
  const std::vector<double> before = model.initial_state;
  std::vector<double>& y = model.initial_state;
  const std::shared_ptr<const Model> view(&model, [](const Model*) {});
  MaximalSystem system(view);
  // While the rank is unknown, Newton steps are minimum-norm, or take the rows that are independent there.
  model.redundant = !system.solver().has_many_rows();
  system.solver().choose_rows_at_each_pose();
  Terms& terms = system.terms();
  report.residual_before = constraint_residual(terms, 0.0, y.data()).position;
  report.open = open_elements(model, terms);
  check_regular(model, terms);
  close(model, system);
  const ConstraintResidual after = constraint_residual(terms, 0.0, y.data());
  report.residual_after = after.position;
  report.rate_residual_after = after.rate;
  if (!(after.position <= kClosed)) report_open(model, terms);
  check_branch(model, terms);
  if (!(after.rate <= kClosed)) {
    report_rates(model, terms, y.data());
  }
  report_moves(model, before, report);
  const ConstraintRank found = system.rank(0.0, y.data());
  report.rank = found.rank;
  report.condition = found.condition;
  model.redundant = found.rank < model.rows();
  const bool tells = system.solver().solves_dependent_rows() || found.condition <= kInaccuratePivot;
  if (model.redundant && !tells) {
    throw SceneError("scene '" + model.description.name +
                     "': has redundant joints (S_ii/d_i = " + to_text(found.condition) + "), " +
                     std::to_string(model.body_count()) + " bodies and " + std::to_string(model.rows()) +
                     " constraints; with more than " + std::to_string(kDenseLimit) +
                     " constraints and velocities, six a body, remove the redundant ones");
  }
  if (found.condition <= kInaccuratePivot) model.left_out = found.left_out;
  if (model.redundant) mark_redundant(model, found.shared);
}

}  // namespace seacrane
