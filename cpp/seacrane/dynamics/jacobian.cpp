#include "seacrane/dynamics/jacobian.hpp"

#include <algorithm>

#include "seacrane/dynamics/maximal.hpp"

namespace seacrane {
namespace {

/// Into the first rows and columns of matrices of zeros.
void write_matrices(const Memory& memory, MemoryMatrices& m) {
  const int n = memory.states();
  const VecXd rest = VecXd::Zero(m.c.rows());
  for (int j = 0; j < n; ++j) {
    const VecXd unit = VecXd::Unit(n, j);
    memory.evaluate<double>(rest.data(), unit.data(), m.a.col(j).data(), m.c.col(j).data());
  }
}

}  // namespace

std::vector<MemoryMatrices> group_matrices(const Model& model) {
  std::vector<MemoryMatrices> out;
  for (const HydroGroup& group : model.groups) {
    const int n = group.memory.states();
    out.push_back({MatXd::Zero(n, n), MatXd::Zero(group.motions(), n)});
    write_matrices(group.memory, out.back());
  }
  return out;
}

std::vector<MemoryMatrices> memory_matrices(const Model& model) {
  std::vector<MemoryMatrices> out;
  for (const Vessel& vessel : model.vessels) {
    const int n = vessel.memory_states(), fluid = vessel.fluid_states();
    MemoryMatrices& m = out.emplace_back(MemoryMatrices{MatXd::Zero(n, n), MatXd::Zero(6, n)});
    if (fluid > 0) write_matrices(std::get<Memory>(vessel.memory), m);
    for (int j = fluid; j < n; ++j) {
      const VecXd unit = VecXd::Unit(n - fluid, j - fluid);
      vessel.fast->rates<double>(Vec3d::Zero(), unit.data(), m.a.col(j).data() + fluid);
    }
  }
  return out;
}

double memory_power_sign(const Vessel& vessel, const YawFrame<double>& frame, const double* x,
                         double* x_rate) {
  if (vessel.fluid_states() == 0) return 1.0;
  Vec6d mu = Vec6d::Zero();
  std::get<Memory>(vessel.memory).evaluate<double>(frame.twist.data(), x, x_rate, mu.data());
  return sign(-frame.twist.dot(mu));
}

void write_wave_slopes(const Vessel& vessel, const BodyResidual::WaveSlopes& slopes, MatXd& c) {
  if (!vessel.fast) return;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 6; ++j) c(j, vessel.fluid_states() + 3 * i) = slopes.over_pose[j][i];
  }
}

TurningMatrix turning(Orientation orientation, const double* angles) {
  if (orientation == Orientation::euler_xyz) return euler_xyz_to_omega<double>(view<3>(angles));
  // Vector part of 2 dq q^-1, for a quaternion of any length.
  const auto q = view<4>(angles);
  const Vec3d u = q.tail<3>();
  Eigen::Matrix<double, 3, 4> out;
  out << -u, q[0] * Mat3d::Identity() + skew<double>(u);
  return out * (2.0 / q.squaredNorm());
}

TurningRate::TurningRate(Orientation orientation, const double* angles, const Vec3d& omega) {
  if (orientation == Orientation::quaternion) {
    in_angles.resize(4, 4);
    in_omega.resize(4, 3);
    for (int i = 0; i < 4; ++i) in_angles.col(i) = quaternion_rate<double>(Vec4d::Unit(i), omega);
    for (int i = 0; i < 3; ++i) in_omega.col(i) = quaternion_rate<double>(view<4>(angles), Vec3d::Unit(i));
    return;
  }
  using Angle = Dual<3>;
  Vec3<Angle> phi;
  for (int i = 0; i < 3; ++i) phi[i] = Angle::variable(angles[i], i);
  const Vec3<Angle> rate = euler_xyz_rate<Angle>(phi, omega.cast<Angle>());
  in_angles.resize(3, 3);
  in_omega.resize(3, 3);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) in_angles(i, j) = rate[i].slope[idx(j)];
    in_omega.col(i) = euler_xyz_rate<double>(view<3>(angles), Vec3d::Unit(i));
  }
}

MaximalJacobian::MaximalJacobian(const Model& model)
    : model_(&model),
      residual_(model),
      memory_(memory_matrices(model)),
      groups_(group_matrices(model)),
      load_(idx(model.body_count()) + 1, Vec6d::Zero()),
      acceleration_(load_),
      given_(idx(model.rows())),
      lambda_(given_),
      column_(idx(model.layout.size)),
      own_(VecXd::Zero(model.inertial_tensions)),
      response_(model.layout.size, 6) {}

void MaximalJacobian::evaluate(MaximalSystem& system, double t, const double* y, double* out) {
  system_ = &system;
  const Model& m = *model_;
  std::fill_n(out, idx(m.layout.size) * idx(m.layout.size), 0.0);
  residual_.start(system.terms(), t,
                  {system.accelerations().data(), system.multipliers().data(), nullptr, y + m.layout.memory});
  for (int b = 0; b < m.body_count(); ++b) {
    residual_.differentiate(b);
    write_body_columns(b, y, out);
  }
  write_memory_columns(y, out);
  write_state_columns(out);
  write_pose_rates(y, out);
}

/// Rates of twists and work from load_, given_ and own_; those of the memory and of loads' states are the
/// caller's.
void MaximalJacobian::solve_column(double* column, double power, double absolute_power) {
  const Model& m = *model_;
  system_->solver().solve(load_, given_, acceleration_, lambda_);
  InertialTensions& tensions = system_->tensions();
  if (tensions.any()) {
    const VecXd& change = tensions.change(own_, acceleration_.data());
    tensions.add_loads(change, load_.data());
    power += tensions.power(change);
    absolute_power += tensions.absolute_power(change);
    system_->solver().solve(load_, given_, acceleration_, lambda_);
  }
  for (int b = 0; b < m.body_count(); ++b) view<6>(column + m.layout.twist(b)) = acceleration_[idx(b)];
  for (const DriverData& driver : m.drivers) {
    const auto row = idx(m.elements[idx(driver.element)].row);
    const double rate = system_->terms().blocks()[idx(driver.element)].nu[0];
    power += rate * lambda_[row];
    absolute_power += sign(rate * system_->multipliers()[row]) * rate * lambda_[row];
  }
  column[m.layout.work] = power;
  column[m.layout.work + 1] = absolute_power;
}

void MaximalJacobian::write_body_columns(int b, const double* y, double* out) {
  const Model& m = *model_;
  const int pose = m.layout.pose(b), vessel = m.bodies[idx(b)].vessel;
  const auto n = m.layout.size;
  const auto turn = turning(m.description.orientation, y + pose + 3);
  Eigen::Map<MatXd> jacobian(out, n, n);
  Eigen::Map<VecXd> column(column_.data(), n);
  for (int k = 0; k < BodyResidual::kDirections; ++k) {
    const auto d = idx(k);
    for (auto& load : load_) load.setZero();
    for (int touched : residual_.touched()) load_[idx(touched)] = residual_.load(touched).col(k);
    for (std::size_t r = 0; r < given_.size(); ++r) given_[r] = residual_.acceleration_rows()[r].slope[d];
    write_slopes(residual_.inertial_tensions(), k, own_.data());
    column.setZero();
    solve_column(column_.data(), residual_.sum().power.slope[d], residual_.sum().absolute_power.slope[d]);
    if (vessel >= 0) {
      const Vessel& v = m.vessels[idx(vessel)];
      for (int i = 0; i < v.memory_states(); ++i) {
        column[v.memory_offset + i] = residual_.memory_rates()[idx(i)].slope[d];
      }
      const HydroGroup* const group = m.group_of(vessel);
      for (int i = 0; group && i < group->memory.states(); ++i) {
        column[group->memory_offset + i] = residual_.group_rates()[idx(i)].slope[d];
      }
    }
    write_slopes(residual_.state_rates(), k, column_.data() + m.layout.loads);
    if (k < 3) {
      jacobian.col(pose + k) = column;
    } else if (k < 6) {
      for (int j = 0; j < turn.cols(); ++j) jacobian.col(pose + 3 + j) += turn(k - 3, j) * column;
    } else {
      jacobian.col(m.layout.twist(b) + k - 6) = column;
    }
  }
}

/// The memory is linear: six unit loads in the yaw frame tell how its states act.
void MaximalJacobian::write_memory_columns(const double* y, double* out) {
  const Model& m = *model_;
  const auto n = m.layout.size;
  Eigen::Map<MatXd> jacobian(out, n, n);
  for (std::size_t v = 0; v < m.vessels.size(); ++v) {
    const Vessel& vessel = m.vessels[v];
    const int states = vessel.memory_states();
    if (states == 0) continue;
    const YawFrame<double>& frame = system_->terms().frames()[v];
    const double direction = memory_power_sign(vessel, frame, y + vessel.memory_offset, column_.data());
    respond_to_motions(v, direction);
    const BodyResidual::WaveSlopes& waves = residual_.wave_slopes(v);
    write_wave_slopes(vessel, waves, memory_[v].c);
    jacobian.middleCols(vessel.memory_offset, states).noalias() = -response_ * memory_[v].c;
    for (int i = vessel.fluid_states(); i < states; ++i) {
      jacobian(m.layout.work + 1, vessel.memory_offset + i) +=
          (direction - waves.direction) * frame.twist.dot(memory_[v].c.col(i));
    }
    jacobian.block(vessel.memory_offset, vessel.memory_offset, states, states) += memory_[v].a;
  }
  for (std::size_t g = 0; g < m.groups.size(); ++g) write_group_columns(g, y, jacobian);
}

void MaximalJacobian::write_group_columns(std::size_t g, const double* y, Eigen::Map<MatXd>& jacobian) {
  const HydroGroup& group = model_->groups[g];
  const int states = group.memory.states(), at = group.memory_offset;
  if (states == 0) return;
  const std::vector<YawFrame<double>>& frames = system_->terms().frames();
  HydroGroup::Motions<double> mu;
  group.remember(frames.data(), y + at, column_.data(), mu);
  for (std::size_t k = 0; k < group.vessels.size(); ++k) {
    const auto v = idx(group.vessels[k]);
    respond_to_motions(v, sign(-frames[v].twist.dot(Eigen::Map<const Vec6d>(&mu[6 * k]))));
    jacobian.middleCols(at, states).noalias() -=
        response_ * groups_[g].c.middleRows<6>(static_cast<Eigen::Index>(6 * k));
  }
  jacobian.block(at, at, states, states) += groups_[g].a;
}

/// response_: to unit loads of a vessel's motions, whose power has this sign.
void MaximalJacobian::respond_to_motions(std::size_t v, double direction) {
  const YawFrame<double>& frame = system_->terms().frames()[v];
  response_.setZero();
  std::fill(given_.begin(), given_.end(), 0.0);
  own_.setZero();
  for (int i = 0; i < 6; ++i) {
    const Vec6d unit = Vec6d::Unit(i);
    for (auto& load : load_) load.setZero();
    load_[idx(model_->vessels[v].body)] = frame.to_inertial(unit);
    solve_column(response_.col(i).data(), frame.twist[i], direction * frame.twist[i]);
  }
}

void MaximalJacobian::write_state_columns(double* out) {
  const Model& m = *model_;
  const auto n = m.layout.size;
  const int states = static_cast<int>(m.load_states.size());
  Eigen::Map<MatXd> jacobian(out, n, n);
  std::fill(given_.begin(), given_.end(), 0.0);
  for (int i = 0; i < states; ++i) {
    const int k = i % BodyResidual::kDirections;
    if (k == 0) residual_.differentiate_states(i);
    for (auto& load : load_) load.setZero();
    for (int touched : residual_.touched()) load_[idx(touched)] = residual_.load(touched).col(k);
    write_slopes(residual_.inertial_tensions(), k, own_.data());
    double* const column = jacobian.col(m.layout.loads + i).data();
    solve_column(column, residual_.sum().power.slope[idx(k)], residual_.sum().absolute_power.slope[idx(k)]);
    write_slopes(residual_.state_rates(), k, column + m.layout.loads);
  }
}

void MaximalJacobian::write_pose_rates(const double* y, double* out) const {
  const Model& m = *model_;
  Eigen::Map<MatXd> jacobian(out, m.layout.size, m.layout.size);
  for (int b = 0; b < m.body_count(); ++b) {
    const int pose = m.layout.pose(b), angle = pose + 3, twist = m.layout.twist(b),
              n = m.layout.pose_size - 3;
    const TurningRate rate(m.description.orientation, y + angle,
                           system_->terms().bodies()[idx(b)].angular_velocity);
    jacobian.block<3, 3>(pose, twist).setIdentity();
    jacobian.block(angle, angle, n, n) = rate.in_angles;
    jacobian.block(angle, twist + 3, n, 3) = rate.in_omega;
  }
}

}  // namespace seacrane
