#include "seacrane/dynamics/maximal.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/projection.hpp"
#include "seacrane/dynamics/state_names.hpp"
#include "seacrane/math/rotation.hpp"

namespace seacrane {

MaximalSystem::MaximalSystem(std::shared_ptr<const Model> model)
    : MaximalSystem(std::make_shared<Terms>(std::move(model))) {}

MaximalSystem::MaximalSystem(std::shared_ptr<Terms> terms)
    : terms_(std::move(terms)),
      model_(terms_->model()),
      solver_(*terms_),
      positions_(model_),
      tensions_(model_) {
  for (auto* vectors : {&acceleration_, &correction_, &direction_}) {
    vectors->assign(idx(model_.body_count()) + 1, Vec6d::Zero());
  }
  for (auto* values : {&lambda_, &gamma_, &residual_, &no_right_, &response_multipliers_}) {
    values->assign(idx(model_.rows()), 0.0);
  }
  inertial_multipliers_ = MatXd::Zero(model_.rows(), tensions_.count());
  find_joined();
}

/// A tension moves what joints, and the water between hulls, join to the bodies that it acts on.
void MaximalSystem::find_joined() {
  const int ground = model_.body_count();
  std::vector<int> group(idx(ground) + 1);
  std::iota(group.begin(), group.end(), 0);
  std::vector<char> joined(group.size());
  const auto join = [&](int first, int second) {
    joined[idx(first)] = joined[idx(second)] = true;
    if (first == ground || second == ground) return;
    const int from = group[idx(first)], to = group[idx(second)];
    std::ranges::replace(group, from, to);
  };
  for (const ElementModel& e : model_.elements) join(e.first, e.second);
  for (const MassCoupling& c : terms_->couplings()) join(c.first, c.second);
  std::vector<std::vector<int>> moved(idx(tensions_.count()));
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const std::vector<int>& on = tensions_.bodies(static_cast<Eigen::Index>(i));
    alone_.push_back(std::ranges::none_of(on, [&](int b) { return joined[idx(b)]; }));
    for (int b = 0; b < ground; ++b) {
      const bool moves = std::ranges::any_of(on, [&](int c) { return group[idx(b)] == group[idx(c)]; });
      if (moves) moved[i].push_back(b);
    }
  }
  tensions_.confine(std::move(moved));
}

double MaximalSystem::tension(int element) const {
  const ElementModel& e = model_.elements[idx(element)];
  if (e.driver) return lambda_[idx(e.row)];
  return e.unique_reaction ? -lambda_[idx(e.row)] : std::numeric_limits<double>::quiet_NaN();
}

void MaximalSystem::derivative(double t, const double* y, double* ydot) {
  evaluated_at_ = t;
  terms_->evaluate(t, y, ydot);
  if (model_.description.baumgarte > 0.0) rate_residual(*terms_, y, residual_.data());
  solver_.factor();
  solve_acceleration();
  if (tensions_.any()) add_inertial_tensions();
  if (model_.paper_kinematics || !solver_.is_regular()) ++dense_solves_;
  write_rates(y, ydot);
}

void MaximalSystem::solve_acceleration() {
  const Model& m = model_;
  const double beta = m.description.baumgarte;
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    const RowBlock<double>& block = terms_->blocks()[e];
    for (int r = 0; r < element.rows; ++r) {
      double g = block.gamma[r];
      if (beta > 0.0) g -= beta * beta * block.phi[r] + 2.0 * beta * residual_[idx(element.row + r)];
      gamma_[idx(element.row + r)] = g;
    }
  }
  if (m.paper_kinematics) {
    solver_.solve_unsymmetric(terms_->loads(), gamma_, acceleration_, lambda_);
    return;
  }
  solver_.solve(terms_->loads(), gamma_, acceleration_, lambda_);
  if (!solver_.misses(acceleration_)) return;
  solver_.factor_anew();
  solver_.solve(terms_->loads(), gamma_, acceleration_, lambda_);
}

void MaximalSystem::add_inertial_tensions() {
  tensions_.start(*terms_, acceleration_.data());
  for (Eigen::Index i = 0; i < tensions_.count(); ++i) {
    const std::vector<Vec6d>& unit = tensions_.unit(i);
    std::vector<Vec6d>& response = tensions_.response(i);
    if (alone_[idx(i)]) {
      for (const int b : tensions_.bodies(i))
        response[idx(b)] = solve_inertia(terms_->inertia(b), unit[idx(b)]);
      continue;
    }
    load_response(unit, response);
    inertial_multipliers_.col(i) = Eigen::Map<const VecXd>(response_multipliers_.data(), model_.rows());
  }
  const VecXd& tension = tensions_.finish(*terms_);
  tensions_.add_accelerations(acceleration_);
  Eigen::Map<VecXd>(lambda_.data(), model_.rows()).noalias() += inertial_multipliers_ * tension;
}

void MaximalSystem::write_pose_rates(const double* y, double* ydot) const {
  const Model& m = model_;
  for (int b = 0; b < m.body_count(); ++b) {
    const BodyKinematics<double>& k = terms_->bodies()[idx(b)];
    double* pose = ydot + m.layout.pose(b);
    const double* angles = y + m.layout.pose(b) + 3;
    view<3>(pose) = k.velocity;
    if (m.description.orientation == Orientation::quaternion) {
      view<4>(pose + 3) = quaternion_rate<double>(view<4>(angles), k.angular_velocity);
    } else {
      view<3>(pose + 3) = euler_xyz_rate<double>(view<3>(angles), k.angular_velocity);
    }
  }
}

void MaximalSystem::write_rates(const double* y, double* ydot) {
  const Model& m = model_;
  write_pose_rates(y, ydot);
  for (int b = 0; b < m.body_count(); ++b) view<6>(ydot + m.layout.twist(b)) = acceleration_[idx(b)];
  // Drivers do work lambda nu on the system.
  for (std::size_t e = m.elements.size() - m.drivers.size(); e < m.elements.size(); ++e) {
    terms_->add_driver_power(lambda_[idx(m.elements[e].row)] * terms_->blocks()[e].nu[0]);
  }
  ydot[m.layout.work] = terms_->power().sum;
  ydot[m.layout.work + 1] = terms_->power().absolute;
}

void MaximalSystem::move_poses(double* y) {
  const Model& m = model_;
  for (int b = 0; b < m.body_count(); ++b) {
    const Vec6d& step = correction_[idx(b)];
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

/// Drift removal on position and velocity level in the mass metric.
bool MaximalSystem::project(double t, double* y, bool evaluated_here) {
  const Model& m = model_;
  if (m.rows() == 0) return false;
  if (!evaluated_here) {
    terms_->read(t, y);
    terms_->evaluate_inertia(t, y + m.layout.memory);
    terms_->evaluate_rows(t);
    solver_.factor();
  }
  const double worst = position_residual(*terms_);
  before_projection_ = std::max(before_projection_, worst);
  const double tolerance = position_tolerance(terms_->bodies().data(), m.body_count());
  const bool moved = projection::close_positions(worst, tolerance, [&](int i) {
    for (std::size_t e = 0; e < m.elements.size(); ++e) {
      const Vec6d& phi = terms_->blocks()[e].phi;
      for (int r = 0; r < m.elements[e].rows; ++r) residual_[idx(m.elements[e].row + r)] = phi[r];
    }
    solver_.correct(residual_, correction_);
    move_poses(y);
    terms_->read(t, y);
    terms_->evaluate_rows(t);
    if (i >= 2) {  // the frozen factorisation converges too slowly
      terms_->evaluate_inertia(t, y + m.layout.memory);
      solver_.factor();
    }
    return position_residual(*terms_);
  });
  const bool turned = projection::close_rates([&] { return rate_residual(*terms_, y, residual_.data()); },
                                              [&] {
                                                solver_.correct(residual_, correction_);
                                                for (int b = 0; b < m.body_count(); ++b)
                                                  view<6>(y + m.layout.twist(b)) -= correction_[idx(b)];
                                              });
  return moved || turned;
}

double MaximalSystem::take_residual_before_projection() { return std::exchange(before_projection_, 0.0); }

ConstraintRank MaximalSystem::rank(double t, const double* y, int skipped) {
  terms_->read(t, y);
  terms_->evaluate_inertia(t, y + model_.layout.memory);
  terms_->evaluate_rows(t);
  return solver_.rank(skipped);
}

bool MaximalSystem::jacobian(double t, const double* y, double* out) {
  if (model_.paper_kinematics) return false;
  if (!jacobian_) {
    jacobian_.emplace(model_);
    jacobian_rate_.resize(size());
  }
  derivative(t, y, jacobian_rate_.data());
  if (!missing_jacobian().empty()) return false;
  jacobian_->evaluate(*this, t, y, out);
  return true;
}

std::string MaximalSystem::missing_jacobian() const {
  if (model_.paper_kinematics) return "kinematics \"paper\" is not differentiated";
  if (!solver_.enforces_all()) return "constraint rows depend on each other here";
  return "";
}

void MaximalSystem::read_bodies(double /*t*/, const double* bodies, double* y) {
  std::copy_n(bodies, size(), y);
}

void MaximalSystem::write_bodies(double /*t*/, const double* y, double* bodies) {
  std::copy_n(y, size(), bodies);
}

std::string MaximalSystem::describe(std::size_t component) const {
  return describe_state(model_, static_cast<int>(component));
}

void start_histories(MaximalSystem& system, double t, const double* y,
                     const std::vector<TwistHistory>& saved) {
  Terms& terms = system.terms();
  VesselHistories& histories = terms.histories();
  if (!saved.empty()) {
    histories.restore(t, saved);
  } else if (!histories.empty()) {
    // The load of the memory is zero here, whatever the start does.
    std::vector<double> rate(system.size());
    system.derivative(t, y, rate.data());
    histories.start(t, terms.frames(), system.accelerations());
  }
}

void sample_histories(Terms& terms, double t, const double* y) {
  terms.read(t, y);
  terms.histories().sample(t, terms.frames());
}

void MaximalSystem::load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) {
  solver_.solve(load, no_right_, acceleration, response_multipliers_);
}

void MaximalSystem::load_direction(const std::vector<Vec6d>& load, double* power, double* rates) {
  for (double* const out : {power, rates}) std::fill_n(out, size(), 0.0);
  load_response(load, direction_);
  for (int b = 0; b < model_.body_count(); ++b) {
    view<6>(power + model_.layout.twist(b)) = load[idx(b)];
    view<6>(rates + model_.layout.twist(b)) = direction_[idx(b)];
  }
}

void PoseMap::move(double h, double* y) {
  const Model& m = model_;
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
      // No angle jumps by a whole turn.
      for (int i = 0; i < 3; ++i) phi[i] += wrap_angle(turned[i] - phi[i]);
    }
  }
}

bool PoseMap::move_jacobian(double h, const double* y, double* out) {
  const StateLayout& s = model_.layout;
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

}  // namespace seacrane
