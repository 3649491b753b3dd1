#include "seacrane/dynamics/jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {
namespace {

/// Step of the central differences of a function force, m, rad and per s: error about 1e-10 of its scale.
constexpr double kStep = 1e-5;

template <class Load>
bool acts_on(const Load& load, int body) {
  if constexpr (requires { load.coordinate; }) {
    return load.coordinate.joint.first == body || load.coordinate.joint.second == body;
  } else if constexpr (requires { load.second; }) {
    return load.first == body || load.second == body;
  } else {
    return load.body == body;
  }
}

double sign(double x) { return x < 0.0 ? -1.0 : 1.0; }

template <int N>
BodyKinematics<Dual<N>> constant(const BodyKinematics<double>& k) {
  using T = Dual<N>;
  return {k.position.cast<T>(), k.rotation.cast<T>(), k.velocity.cast<T>(), k.angular_velocity.cast<T>()};
}

BodyKinematics<double> moved(const BodyKinematics<double>& k, int direction, double step) {
  const Vec3d along = step * Vec3d::Unit(direction % 3);
  BodyKinematics<double> out = k;
  if (direction < 3) {
    out.position += along;
  } else if (direction < 6) {
    out.rotation = Eigen::AngleAxisd(step, Vec3d::Unit(direction % 3)) * k.rotation;
  } else if (direction < 9) {
    out.velocity += along;
  } else {
    out.angular_velocity += along;
  }
  return out;
}

/// Rotation vector (inertial axes) per change of the orientation's variables: 3 x 4 or 3 x 3.
Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 4> turning(Orientation orientation, const double* angles) {
  if (orientation == Orientation::euler_xyz) return euler_xyz_to_omega<double>(view<3>(angles));
  // Vector part of 2 dq q^-1, for a quaternion of any length.
  const auto q = view<4>(angles);
  const Vec3d u = q.tail<3>();
  Eigen::Matrix<double, 3, 4> out;
  out << -u, q[0] * Mat3d::Identity() + skew<double>(u);
  return out * (2.0 / q.squaredNorm());
}

}  // namespace

RedundantJacobian::RedundantJacobian(const Model& model)
    : model_(&model),
      wrench_(idx(model.body_count()) + 1),
      moved_wrench_(wrench_.size()),
      right_(idx(model.rows())),
      load_(wrench_.size(), Vec6d::Zero()),
      acceleration_(wrench_.size(), Vec6d::Zero()),
      given_(right_.size()),
      lambda_(right_.size()),
      column_(idx(model.layout.size)),
      response_(model.layout.size, 6) {
  int most = 0;
  for (const Vessel& vessel : model.vessels) {
    const int n = vessel.memory_states();
    most = std::max(most, n);
    MemoryMatrices& m = memory_.emplace_back(MemoryMatrices{MatXd::Zero(n, n), MatXd::Zero(6, n)});
    for (int j = 0; j < n; ++j) {
      const VecXd unit = VecXd::Unit(n, j);
      Vec6d mu = Vec6d::Zero();
      std::get<Memory>(vessel.memory).evaluate<double>(Vec6d::Zero(), unit.data(), m.a.col(j).data(), mu);
      m.c.col(j) = mu;
    }
  }
  memory_state_.resize(idx(most));
  memory_rate_.resize(idx(most));
}

void RedundantJacobian::evaluate(RedundantSystem& system, double t, const double* y, double* out) {
  system_ = &system;
  const Model& m = *model_;
  std::fill_n(out, idx(m.layout.size) * idx(m.layout.size), 0.0);
  bodies_.clear();
  for (const auto& k : system.bodies()) bodies_.push_back(constant<kDirections>(k));
  moved_ = system.bodies();
  for (int b = 0; b < m.body_count(); ++b) {
    seed(system.bodies()[idx(b)], bodies_[idx(b)]);
    for (auto& w : wrench_) w = Wrench<Scalar>();
    std::fill(right_.begin(), right_.end(), Scalar());
    const LoadInput<double> now = system.load_input(t);
    const LoadInput<Scalar> input{t, now.curve_limit, bodies_.data(), now.slots};
    LoadSum<Scalar> sum{wrench_.data()};
    add_inertia(b);
    add_loads(b, input, sum);
    add_hydrodynamics(b, input, y, sum);
    add_waves(b, t, sum);
    add_rows(b, t);
    write_body_columns(b, y, sum, out);
    bodies_[idx(b)] = constant<kDirections>(system.bodies()[idx(b)]);
  }
  write_memory_columns(y, out);
  write_pose_rates(y, out);
}

void RedundantJacobian::seed(const BodyKinematics<double>& k, BodyKinematics<Scalar>& out) const {
  for (int i = 0; i < 3; ++i) {
    out.position[i] = Scalar::variable(k.position[i], i);
    out.velocity[i] = Scalar::variable(k.velocity[i], 6 + i);
    out.angular_velocity[i] = Scalar::variable(k.angular_velocity[i], 9 + i);
    const Mat3d turned = skew<double>(Vec3d::Unit(i)) * k.rotation;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) out.rotation(r, c).slope[idx(3 + i)] = turned(r, c);
    }
  }
}

/// -(M vdot + b), eqs (5) and (12) about the state point, with the added mass of a vessel.
void RedundantJacobian::add_inertia(int b) {
  const BodyModel& body = model_->bodies[idx(b)];
  const auto& k = bodies_[idx(b)];
  const Vec6<Scalar> rate = system_->acceleration()[idx(b)].cast<Scalar>();
  const Vec3<Scalar> a = rate.head<3>(), alpha = rate.tail<3>(), omega = k.angular_velocity;
  const Mat3<Scalar> inertia = body.inertia.cast<Scalar>();
  const auto about_center = [&](const Vec3<Scalar>& w) -> Vec3<Scalar> {
    const Vec3<Scalar> in_body = k.rotation.transpose() * w;
    const Vec3<Scalar> momentum = inertia * in_body;
    return k.rotation * momentum;
  };
  const Vec3<Scalar> c = k.rotation * body.center_of_mass.cast<Scalar>();
  const Vec3<Scalar> swing = cross<Scalar>(omega, cross<Scalar>(omega, c));
  const Vec3<Scalar> at_center = a + cross<Scalar>(alpha, c) + swing;
  const Vec3<Scalar> force = Scalar(body.mass) * at_center;
  Wrench<Scalar>& out = wrench_[idx(b)];
  out.force -= force;
  out.moment -= about_center(alpha) + cross<Scalar>(omega, about_center(omega)) + cross<Scalar>(c, force);
  if (body.vessel < 0) return;
  const YawFrame<Scalar> frame(k);
  const Vec6<Scalar> fluid =
      model_->vessels[idx(body.vessel)].added_mass.cast<Scalar>() * frame.twist_rate(rate);
  const Vec6<Scalar> added = frame.to_inertial(fluid);
  out.force -= added.head<3>();
  out.moment -= added.tail<3>();
}

void RedundantJacobian::add_loads(int b, const LoadInput<Scalar>& input, LoadSum<Scalar>& sum) {
  for (const Gravity& load : model_->gravity) {
    if (load.body == b) load.apply<Scalar>(input, sum);
  }
  for_each_load_type([&]<class Load>() {
    for (const Load& load : std::get<std::vector<Load>>(model_->loads)) {
      if (!acts_on(load, b)) continue;
      if constexpr (std::is_same_v<Load, FunctionForce>) {
        add_differences(load, input.time, sum);
      } else {
        load.template apply<Scalar>(input, sum);
      }
    }
  });
}

void RedundantJacobian::add_differences(const FunctionForce& load, double t, LoadSum<Scalar>& sum) {
  const auto b = idx(load.body);
  LoadInput<double> input = system_->load_input(t);
  input.bodies = moved_.data();
  const auto at = [&](int direction, double step) {
    moved_[b] = moved(system_->bodies()[b], direction, step);
    moved_wrench_[b] = Wrench<double>();
    LoadSum<double> out{moved_wrench_.data()};
    load.apply<double>(input, out);
    return (Eigen::Matrix<double, 7, 1>() << moved_wrench_[b].force, moved_wrench_[b].moment, out.power)
        .finished();
  };
  const double power_here = at(0, 0.0)[6];
  for (int d = 0; d < kDirections; ++d) {
    const Eigen::Matrix<double, 7, 1> slope = (at(d, kStep) - at(d, -kStep)) / (2.0 * kStep);
    for (int i = 0; i < 3; ++i) {
      wrench_[b].force[i].slope[idx(d)] += slope[i];
      wrench_[b].moment[i].slope[idx(d)] += slope[3 + i];
    }
    sum.power.slope[idx(d)] += slope[6];
    sum.absolute_power.slope[idx(d)] += sign(power_here) * slope[6];
  }
  moved_[b] = system_->bodies()[b];
}

void RedundantJacobian::add_hydrodynamics(int b, const LoadInput<Scalar>& input, const double* y,
                                          LoadSum<Scalar>& sum) {
  const int v = model_->bodies[idx(b)].vessel;
  if (v < 0) return;
  const Vessel& vessel = model_->vessels[idx(v)];
  const YawFrame<Scalar> frame(bodies_[idx(b)]);
  std::copy_n(y + vessel.memory_offset, vessel.memory_states(), memory_state_.begin());
  vessel.apply<Scalar>(input, frame, memory_state_.data(), memory_rate_.data(), sum);
}

void RedundantJacobian::add_waves(int b, double t, LoadSum<Scalar>& sum) {
  for (std::size_t i = 0; i < model_->wave_loads.size(); ++i) {
    const WaveLoad& wave = model_->wave_loads[i];
    if (wave.body != b) continue;
    const YawFrame<Scalar> frame(bodies_[idx(b)]);
    Vec6<Scalar> force = system_->waves(i).sum().cast<Scalar>();
    if (wave.sources.positioned) {
      const Vec3d& place = system_->bodies()[idx(b)].position;
      double slopes[6][3];
      wave.sources.positioned->slopes(t, place.x(), place.y(), frame.yaw.value, slopes);
      for (int k = 0; k < 6; ++k) {
        const double* over = slopes[k];
        force[k] += over[2] * (frame.yaw - Scalar(frame.yaw.value));
        force[k].slope[0] += over[0];
        force[k].slope[1] += over[1];
      }
    }
    const Vec6<Scalar> inertial = frame.to_inertial(force);
    wrench_[idx(b)].force += inertial.head<3>();
    wrench_[idx(b)].moment += inertial.tail<3>();
    sum.add_power(force.dot(frame.twist));
  }
}

void RedundantJacobian::add_rows(int b, double t) {
  const Model& m = *model_;
  for_each_joint_type([&]<class Type>(std::size_t kind) {
    for (const JointData& joint : m.joints[kind]) {
      if (joint.first != b && joint.second != b) continue;
      RowBlock<Scalar> block;
      const JointGeometry<Scalar> g(joint, bodies_[idx(joint.first)], bodies_[idx(joint.second)]);
      Type::template evaluate<Scalar>(g, joint, block);
      add_rows(block, m.elements[idx(joint.element)]);
    }
  });
  for (const DriverData& driver : m.drivers) {
    const JointData& joint = driver.coordinate.joint;
    if (joint.first != b && joint.second != b) continue;
    RowBlock<Scalar> block;
    evaluate_driver<Scalar>(driver, driver.curve.at(t, system_->curve_limit()), bodies_[idx(joint.first)],
                            bodies_[idx(joint.second)], block);
    add_rows(block, m.elements[idx(driver.element)]);
  }
}

/// D^T lambda on both bodies, and gamma - D vdot.
void RedundantJacobian::add_rows(const RowBlock<Scalar>& block, const ElementModel& element) {
  const double beta = model_->description.baumgarte;
  const int bodies[2] = {element.first, element.second};
  for (int r = 0; r < element.rows; ++r) {
    Scalar& s = right_[idx(element.row + r)];
    s = block.gamma[r];
    if (beta > 0.0) s -= (beta * beta) * block.phi[r] - (2.0 * beta) * block.nu[r];
    const double lambda = system_->multipliers()[idx(element.row + r)];
    for (int side = 0; side < 2; ++side) {
      if (bodies[side] == model_->body_count()) continue;
      const auto b = idx(bodies[side]);
      const Vec6d& rate = system_->acceleration()[b];
      for (int i = 0; i < 6; ++i) {
        const Scalar& d = block.d[side](r, i);
        auto& load = i < 3 ? wrench_[b].force[i] : wrench_[b].moment[i - 3];
        load += lambda * d;
        s -= rate[i] * d;
        if (beta > 0.0) {
          s -= (2.0 * beta) * (d * (i < 3 ? bodies_[b].velocity[i] : bodies_[b].angular_velocity[i - 3]));
        }
      }
    }
  }
}

/// Rates of twists and work from load_ and given_; the memory's are the caller's.
void RedundantJacobian::solve_column(double* column, double power, double absolute_power) {
  const Model& m = *model_;
  system_->solve(load_, given_, acceleration_, lambda_);
  for (int b = 0; b < m.body_count(); ++b) view<6>(column + m.layout.twist(b)) = acceleration_[idx(b)];
  for (const DriverData& driver : m.drivers) {
    const auto row = idx(m.elements[idx(driver.element)].row);
    const double rate = system_->blocks()[idx(driver.element)].nu[0];
    power += rate * lambda_[row];
    absolute_power += sign(rate * system_->multipliers()[row]) * rate * lambda_[row];
  }
  column[m.layout.work] = power;
  column[m.layout.work + 1] = absolute_power;
}

void RedundantJacobian::write_body_columns(int b, const double* y, const LoadSum<Scalar>& sum, double* out) {
  const Model& m = *model_;
  const int pose = m.layout.pose(b), vessel = m.bodies[idx(b)].vessel;
  const auto n = m.layout.size;
  const auto turn = turning(m.description.orientation, y + pose + 3);
  Eigen::Map<MatXd> jacobian(out, n, n);
  Eigen::Map<VecXd> column(column_.data(), n);
  for (int k = 0; k < kDirections; ++k) {
    const auto d = idx(k);
    for (std::size_t i = 0; i < load_.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        load_[i][c] = wrench_[i].force[c].slope[d];
        load_[i][3 + c] = wrench_[i].moment[c].slope[d];
      }
    }
    for (std::size_t r = 0; r < right_.size(); ++r) given_[r] = right_[r].slope[d];
    column.setZero();
    solve_column(column_.data(), sum.power.slope[d], sum.absolute_power.slope[d]);
    if (vessel >= 0) {
      const Vessel& v = m.vessels[idx(vessel)];
      for (int i = 0; i < v.memory_states(); ++i) column[v.memory_offset + i] = memory_rate_[idx(i)].slope[d];
    }
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
void RedundantJacobian::write_memory_columns(const double* y, double* out) {
  const Model& m = *model_;
  const auto n = m.layout.size;
  Eigen::Map<MatXd> jacobian(out, n, n);
  for (std::size_t v = 0; v < m.vessels.size(); ++v) {
    const Vessel& vessel = m.vessels[v];
    const int states = vessel.memory_states();
    if (states == 0) continue;
    const YawFrame<double>& frame = system_->frame(static_cast<int>(v));
    Vec6d mu = Vec6d::Zero();
    std::get<Memory>(vessel.memory)
        .evaluate<double>(frame.twist, y + vessel.memory_offset, column_.data(), mu);
    const double direction = sign(-frame.twist.dot(mu));
    response_.setZero();
    std::fill(given_.begin(), given_.end(), 0.0);
    for (auto& load : load_) load.setZero();
    for (int i = 0; i < 6; ++i) {
      const Vec6d unit = Vec6d::Unit(i);
      load_[idx(vessel.body)] = frame.to_inertial(unit);
      solve_column(response_.col(i).data(), frame.twist[i], direction * frame.twist[i]);
    }
    jacobian.middleCols(vessel.memory_offset, states).noalias() = -response_ * memory_[v].c;
    jacobian.block(vessel.memory_offset, vessel.memory_offset, states, states) += memory_[v].a;
  }
}

void RedundantJacobian::write_pose_rates(const double* y, double* out) const {
  const Model& m = *model_;
  Eigen::Map<MatXd> jacobian(out, m.layout.size, m.layout.size);
  for (int b = 0; b < m.body_count(); ++b) {
    const int pose = m.layout.pose(b), angle = pose + 3, twist = m.layout.twist(b);
    jacobian.block<3, 3>(pose, twist).setIdentity();
    const Vec3d& omega = system_->bodies()[idx(b)].angular_velocity;
    if (m.description.orientation == Orientation::quaternion) {
      const auto q = view<4>(y + angle);
      for (int i = 0; i < 4; ++i) {
        jacobian.block<4, 1>(angle, angle + i) = quaternion_rate<double>(Vec4d::Unit(i), omega);
      }
      for (int i = 0; i < 3; ++i) {
        jacobian.block<4, 1>(angle, twist + 3 + i) = quaternion_rate<double>(q, Vec3d::Unit(i));
      }
      continue;
    }
    using Angle = Dual<3>;
    Vec3<Angle> phi;
    for (int i = 0; i < 3; ++i) phi[i] = Angle::variable(y[angle + i], i);
    const Vec3<Angle> rate = euler_xyz_rate<Angle>(phi, omega.cast<Angle>());
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) jacobian(angle + i, angle + j) = rate[i].slope[idx(j)];
      jacobian.block<3, 1>(angle, twist + 3 + i) = euler_xyz_rate<double>(view<3>(y + angle), Vec3d::Unit(i));
    }
  }
}

}  // namespace seacrane
