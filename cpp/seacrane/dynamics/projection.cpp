#include "seacrane/dynamics/projection.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/redundant.hpp"

/// Drift removal on position and velocity level in the mass metric, and what is left of it.
namespace seacrane {
namespace {

constexpr double kRedundantPivot = 1.0 / (kRedundantSingularValue * kRedundantSingularValue);

}  // namespace

double RedundantSystem::position_residual() const {
  double largest = 0.0;
  for (std::size_t e = 0; e < blocks_.size(); ++e) {
    for (int r = 0; r < model_->elements[e].rows; ++r) {
      const double v = std::abs(blocks_[e].phi[r]);
      if (!(v <= largest)) largest = v;
    }
  }
  return largest;
}

double RedundantSystem::rate_residual(const double* y, double* out) const {
  const Model& m = *model_;
  double largest = 0.0;
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    if (element.rows == 0) continue;
    Vec6d rate = -blocks_[e].nu;
    if (element.first < m.body_count()) {
      rate += blocks_[e].d[0] * view<6>(y + m.layout.twist(element.first));
    }
    if (element.second < m.body_count()) {
      rate += blocks_[e].d[1] * view<6>(y + m.layout.twist(element.second));
    }
    for (int r = 0; r < element.rows; ++r) {
      out[element.row + r] = rate[r];
      const double v = std::abs(rate[r]);
      if (!(v <= largest)) largest = v;
    }
  }
  return largest;
}

/// impulse_ := M^-1 D^T S^-1 residual_, the smallest motion in the mass metric that removes the residual.
void RedundantSystem::correct() {
  if (!regular_) {
    dense_->solve(nullptr, residual_.data(), impulse_.data(), gamma_.data());
    return;
  }
  model_->schur.solve(values_.data(), residual_.data());
  multiplier_load(residual_.data(), impulse_);
  for (int b = 0; b < model_->body_count(); ++b) {
    impulse_[idx(b)] = solve_inertia(inertia_[idx(b)], impulse_[idx(b)]);
  }
}

void RedundantSystem::move_poses(double* y) {
  const Model& m = *model_;
  for (int b = 0; b < m.body_count(); ++b) {
    const Vec6d& step = impulse_[idx(b)];
    double* pose = y + m.layout.pose(b);
    view<3>(pose) -= step.head<3>();
    const Vec3d turn = -step.tail<3>();
    if (m.description.orientation == Orientation::quaternion) {
      auto q = view<4>(pose + 3);
      q = rotate_quaternion(turn, q);
    } else {
      auto phi = view<3>(pose + 3);
      phi += euler_xyz_rate<double>(phi, turn);
    }
  }
}

void RedundantSystem::move(double h, double* y) {
  const Model& m = *model_;
  for (int b = 0; b < m.body_count(); ++b) {
    double* pose = y + m.layout.pose(b);
    const double* twist = y + m.layout.twist(b);
    view<3>(pose) += h * view<3>(twist);
    const Vec3d turn = h * view<3>(twist + 3);
    if (m.description.orientation == Orientation::quaternion) {
      auto q = view<4>(pose + 3);
      q = rotate_quaternion(turn, q);
    } else {
      auto phi = view<3>(pose + 3);
      const Vec4d q = rotate_quaternion(turn, quaternion_from_rotation(rotation_from_euler_xyz<double>(phi)));
      const Vec3d turned = euler_xyz_from_rotation(rotation_from_quaternion<double>(q));
      // The angles go on without a jump of a whole turn.
      for (int i = 0; i < 3; ++i) phi[i] += wrap_angle(turned[i] - phi[i]);
    }
  }
}

bool RedundantSystem::move_jacobian(double h, const double* y, double* out) {
  const StateLayout& s = model_->layout;
  Eigen::Map<MatXd> slopes(out, s.velocity, s.size - s.velocity);
  slopes.setZero();
  std::copy_n(y, s.size, moved_.data());
  move(h, moved_.data());
  for (int b = 0; b < s.bodies; ++b) {
    const int pose = s.pose(b), column = s.twist(b) - s.velocity;
    slopes.block<3, 3>(pose, column) = h * Mat3d::Identity();
    const Mat3d turn = h * exponential_slope(h * view<3>(y + s.twist(b) + 3));
    const double* angles = moved_.data() + pose + 3;
    for (int i = 0; i < 3; ++i) {
      if (s.pose_size == 7) {
        slopes.block<4, 1>(pose + 3, column + 3 + i) = quaternion_rate<double>(view<4>(angles), turn.col(i));
      } else {
        slopes.block<3, 1>(pose + 3, column + 3 + i) = euler_xyz_rate<double>(view<3>(angles), turn.col(i));
      }
    }
  }
  return true;
}

void RedundantSystem::move_twists(double* y) {
  for (int b = 0; b < model_->body_count(); ++b) {
    view<6>(y + model_->layout.twist(b)) -= impulse_[idx(b)];
  }
}

bool RedundantSystem::project(double t, double* y, bool evaluated_here) {
  const Model& m = *model_;
  if (m.rows() == 0) return false;
  if (!evaluated_here) {
    read_state(t, y);
    evaluate_inertia();
    evaluate_rows(t);
    factor();
  }
  const double worst = position_residual();
  before_projection_ = std::max(before_projection_, worst);
  const double tolerance = position_tolerance(bodies_.data(), m.body_count());
  const bool moved = projection::close_positions(worst, tolerance, [&](int i) {
    for (std::size_t e = 0; e < m.elements.size(); ++e) {
      for (int r = 0; r < m.elements[e].rows; ++r) residual_[idx(m.elements[e].row + r)] = blocks_[e].phi[r];
    }
    correct();
    move_poses(y);
    read_state(t, y);
    evaluate_rows(t);
    if (i >= 2) {  // the frozen factorisation converges too slowly
      evaluate_inertia();
      factor();
    }
    return position_residual();
  });
  const bool turned = projection::close_rates([&] { return rate_residual(y, residual_.data()); },
                                              [&] {
                                                correct();
                                                move_twists(y);
                                              });
  return moved || turned;
}

ConstraintResidual RedundantSystem::residual(double t, const double* y) {
  read_state(t, y);
  evaluate_rows(t);
  return residual_here(y);
}

ConstraintResidual RedundantSystem::residual_here(const double* y) {
  return {position_residual(), rate_residual(y, residual_.data())};
}

ConstraintRank RedundantSystem::rank(double t, const double* y, int skipped) {
  read_state(t, y);
  evaluate_inertia();
  evaluate_rows(t);
  factor();
  ConstraintRank out;
  out.condition = condition_;
  const double shape = shape_condition();
  if (row_space_) {
    out.rank =
        row_space_->factor(model_->elements, blocks_.data(), over_shape_.data(), kRedundantSingularValue);
    out.null_space = row_space_->null_space();
    out.smallest_singular_value = row_space_->singular_value(skipped);
    out.weakest = weakest_element(skipped);
  } else {
    out.rank = model_->rows() - (shape > kRedundantPivot ? 1 : 0);
  }
  return out;
}

/// The element with the largest part in a combination of rows.
int RedundantSystem::weakest_element(int combination) const {
  int weakest = -1;
  double largest = -1.0;
  for (std::size_t e = 0; e < model_->elements.size(); ++e) {
    const ElementModel& element = model_->elements[e];
    const double part = row_space_->combination(combination).segment(element.row, element.rows).norm();
    if (element.rows == 0 || !(part > largest)) continue;
    largest = part;
    weakest = static_cast<int>(e);
  }
  return weakest;
}

double RedundantSystem::take_residual_before_projection() {
  const double out = before_projection_;
  before_projection_ = 0.0;
  return out;
}

}  // namespace seacrane
