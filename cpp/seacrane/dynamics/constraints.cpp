#include "seacrane/dynamics/constraints.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/driver.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"

namespace seacrane {
namespace {

void add_transpose(const RowBlock<double>& block, int side, int rows, const double* lambda, Vec6d& out) {
  for (int r = 0; r < rows; ++r) out += block.d[side].row(r).transpose() * lambda[r];
}

/// Calls f(row, rate residual) for every row.
template <class F>
void for_each_rate(const Terms& terms, const double* y, F&& f) {
  const Model& m = terms.model();
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    if (element.rows == 0) continue;
    const RowBlock<double>& block = terms.blocks()[e];
    Vec6d rate = -block.nu;
    if (element.first < m.body_count()) rate += block.d[0] * view<6>(y + m.layout.twist(element.first));
    if (element.second < m.body_count()) rate += block.d[1] * view<6>(y + m.layout.twist(element.second));
    for (int r = 0; r < element.rows; ++r) f(element.row + r, rate[r]);
  }
}

/// The larger magnitude; a number that is none stays.
void keep_largest(double value, double& largest) {
  const double v = std::abs(value);
  if (!(v <= largest)) largest = v;
}

}  // namespace

void evaluate_constraints(const Model& model, double t, double curve_limit,
                          const BodyKinematics<double>* bodies, RowBlock<double>* blocks) {
  for (const JointKind& kind : joint_kinds()) kind.evaluate(model.joints[kind.index], bodies, blocks);
  for (const DriverData& driver : model.drivers) {
    const JointData& joint = driver.coordinate.joint;
    evaluate_driver<double>(driver, driver.curve.at(t, curve_limit), bodies[joint.first],
                            bodies[joint.second], blocks[driver.element]);
  }
}

double position_residual(const Terms& terms) {
  double largest = 0.0;
  for (std::size_t e = 0; e < terms.blocks().size(); ++e) {
    for (int r = 0; r < terms.model().elements[e].rows; ++r) keep_largest(terms.blocks()[e].phi[r], largest);
  }
  return largest;
}

double rate_residual(const Terms& terms, const double* y, double* out) {
  double largest = 0.0;
  for_each_rate(terms, y, [&](int row, double rate) {
    out[row] = rate;
    keep_largest(rate, largest);
  });
  return largest;
}

ConstraintResidual constraint_residual(const Terms& terms, const double* y) {
  double largest = 0.0;
  for_each_rate(terms, y, [&](int, double rate) { keep_largest(rate, largest); });
  return {position_residual(terms), largest};
}

ConstraintResidual constraint_residual(Terms& terms, double t, const double* y) {
  terms.read(t, y);
  terms.evaluate_rows(t);
  return constraint_residual(terms, y);
}

void multiplier_load(const Terms& terms, const double* lambda, std::vector<Vec6d>& out) {
  const Model& m = terms.model();
  for (auto& load : out) load.setZero();
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    const RowBlock<double>& block = terms.blocks()[e];
    add_transpose(block, 0, element.rows, lambda + element.row, out[idx(element.first)]);
    add_transpose(block, 1, element.rows, lambda + element.row, out[idx(element.second)]);
  }
}

double position_tolerance(const BodyKinematics<double>* bodies, int count) {
  constexpr double usual = 1e-13, slow = 10.0;  // rad/s
  double squared = slow * slow;
  for (int b = 0; b < count; ++b) squared = std::max(squared, bodies[b].angular_velocity.squaredNorm());
  return usual * (slow * slow / squared);
}

double limit_force(const Limit& limit, const Terms& terms, const double* lambda) {
  const double* own = lambda + terms.model().elements[idx(limit.element)].row;
  if (limit.kind->closes_again) return limit.side * *own;
  const JointData& joint = limit.coordinate.joint;
  const Vec3d normal = terms.bodies()[idx(joint.first)].rotation * joint.first_axes.col(2);
  return normal.dot(view<3>(own));
}

}  // namespace seacrane
