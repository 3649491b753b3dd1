#include "seacrane/dynamics/recursive/recursive_jacobian.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "seacrane/dynamics/recursive/tree_branches.hpp"

namespace seacrane {
RecursiveJacobian::RecursiveJacobian(const Model& model, const BodyTree& tree)
    : model_(&model),
      tree_(tree),
      residual_(model, &tree.loops),
      memory_(memory_matrices(model)),
      groups_(group_matrices(model)),
      states_(model.layout.work - model.layout.memory),
      multipliers_(idx(model.rows())),
      power_(idx(model.body_count())),
      absolute_power_(power_),
      state_(idx(tree.positions + tree.speeds)),
      state_rate_(idx(tree.positions)),
      bodies_(idx(model.body_count()) + 1, BodyKinematics<Scalar>::ground()),
      kinematics_(tree, model.body_count()),
      acceleration_(bodies_.size(), Twist<Scalar>::zero()),
      force_(bodies_.size()),
      motion_(bodies_.size()),
      change_(bodies_.size()),
      torque_(tree.clusters.size()),
      load_(bodies_.size(), Vec6d::Zero()),
      response_(load_),
      given_load_(load_),
      coupled_(load_),
      own_(VecXd::Zero(model.inertial_tensions)) {
  for (int e : tree.loops) {
    for (int r = 0; r < model.elements[idx(e)].rows; ++r) rows_.emplace_back(e, r);
  }
  right_ = lambda_ = VecXd::Zero(static_cast<Eigen::Index>(rows_.size()));
  for (const Vessel& vessel : model.vessels) fluid_.emplace_back(vessel.memory_states(), kDirections);
  group_.resize(model.vessels.size());
  for (const HydroGroup& group : model.groups) {
    for (const int v : group.vessels) group_[idx(v)].resize(group.memory.states(), kDirections);
  }
  state_over_.assign(idx(model.body_count()),
                     Rates::Zero(static_cast<Eigen::Index>(model.load_states.size()), kDirections));
  inertial_over_.assign(idx(model.body_count()), Rates::Zero(model.inertial_tensions, kDirections));
  to_fluid_.resize(tree.positions + tree.speeds + states_ + 2, 6);
}

void RecursiveJacobian::evaluate(const TreeEvaluation& at, double t, const double* y, const double* rate,
                                 double* out) {
  at_ = &at;
  const int size = tree_.positions + tree_.speeds;
  const std::size_t n = idx(size + states_ + 2);
  std::fill_n(out, n * n, 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    multipliers_[idx(model_->elements[idx(rows_[i].first)].row + rows_[i].second)] =
        at.loops.multipliers()[static_cast<Eigen::Index>(i)];
  }
  differentiate_bodies(t, y);
  for (int first = 0; first < size; first += kDirections) differentiate_tree(first, y, rate, out);
  write_memory_columns(y, out);
  write_state_columns(out);
}

/// Slopes of every body's residual, and of the loops' rows, in the directions of every body.
void RecursiveJacobian::differentiate_bodies(double t, const double* y) {
  const Model& m = *model_;
  shares_.clear();
  row_shares_.clear();
  residual_.start(at_->terms, t,
                  {at_->acceleration, multipliers_.data(), nullptr, y + tree_.positions + tree_.speeds});
  for (int b = 0; b < m.body_count(); ++b) {
    residual_.differentiate(b);
    for (int to : residual_.touched()) {
      if (to < m.body_count()) shares_.push_back({to, b, residual_.load(to)});
    }
    const auto slopes = [](const Scalar& x) { return Row(Eigen::Map<const Row>(x.slope.data())); };
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const ElementModel& element = m.elements[idx(rows_[i].first)];
      if (element.first != b && element.second != b) continue;
      const Scalar& s = residual_.acceleration_rows()[idx(element.row + rows_[i].second)];
      row_shares_.push_back({static_cast<int>(i), b, slopes(s)});
    }
    power_[idx(b)] = slopes(residual_.sum().power);
    absolute_power_[idx(b)] = slopes(residual_.sum().absolute_power);
    for (std::size_t i = 0; i < m.load_states.size(); ++i) {
      state_over_[idx(b)].row(static_cast<Eigen::Index>(i)) = slopes(residual_.state_rates()[i]);
    }
    for (Eigen::Index i = 0; i < own_.size(); ++i) {
      inertial_over_[idx(b)].row(i) = slopes(residual_.inertial_tensions()[idx(i)]);
    }
    const int v = m.bodies[idx(b)].vessel;
    if (v < 0) continue;
    for (int i = 0; i < m.vessels[idx(v)].memory_states(); ++i) {
      fluid_[idx(v)].row(i) = slopes(residual_.memory_rates()[idx(i)]);
    }
    for (Eigen::Index i = 0; i < group_[idx(v)].rows(); ++i) {
      group_[idx(v)].row(i) = slopes(residual_.group_rates()[idx(i)]);
    }
  }
}

/// Columns of up to twelve positions and speeds, from `first` on.
void RecursiveJacobian::differentiate_tree(int first, const double* y, const double* rate, double* out) {
  const int size = tree_.positions + tree_.speeds, last = std::min(first + kDirections, size);
  const std::size_t n = idx(size + states_ + 2);
  for (int i = 0; i < size; ++i) state_[idx(i)] = Scalar(y[i]);
  for (int i = first; i < last; ++i) state_[idx(i)] = Scalar::variable(y[i], i - first);
  const Scalar* u = state_.data() + tree_.positions;
  kinematics_.place(state_.data(), u, bodies_.data());
  kinematics_.position_rates(state_.data(), u, bodies_.data(), state_rate_.data());
  read_kinematics();
  spread_acceleration(rate + tree_.positions);
  gather();
  for (int k = 0; k < last - first; ++k) {
    double* column = out + n * idx(first + k);
    for (int i = 0; i < tree_.positions; ++i) column[i] = state_rate_[idx(i)].slope[idx(k)];
    write_column(k, column);
  }
}

/// Directions of the bodies, rotations as vectors in inertial axes, over those of the state.
void RecursiveJacobian::read_kinematics() {
  for (int b = 0; b < model_->body_count(); ++b) {
    const BodyKinematics<Scalar>& k = bodies_[idx(b)];
    const Mat3d& r = at_->terms.bodies()[idx(b)].rotation;
    for (int d = 0; d < kDirections; ++d) {
      Mat3d turned;
      for (int i = 0; i < 9; ++i) turned(i) = k.rotation(i).slope[idx(d)];
      const Mat3d spin = turned * r.transpose();
      auto column = motion_[idx(b)].col(d);
      for (int i = 0; i < 3; ++i) {
        column[i] = k.position[i].slope[idx(d)];
        column[3 + i] = 0.5 * (spin((i + 2) % 3, (i + 1) % 3) - spin((i + 1) % 3, (i + 2) % 3));
        column[6 + i] = k.velocity[i].slope[idx(d)];
        column[9 + i] = k.angular_velocity[i].slope[idx(d)];
      }
    }
  }
}

/// Accelerations of the bodies for the given rates of the speeds.
void RecursiveJacobian::spread_acceleration(const double* u_rate) {
  for (const Cluster& c : tree_.clusters) {
    for (const Member& m : c.members) {
      Twist<Scalar>& a = acceleration_[idx(m.body)];
      a = Twist<Scalar>::zero();
      if (c.kind != Cluster::floating) {
        a = acceleration_[idx(c.parent)];
        const Vec3<Scalar> turning = a.angular();
        a += kinematics_.over_parent(m.body).bias;
        a.linear() += cross<Scalar>(turning, kinematics_.over_parent(m.body).reach);
      }
      for (int k = 0; k < c.speeds; ++k) a += Scalar(u_rate[c.u + k]) * kinematics_.columns(m)[k];
    }
  }
}

/// torque_: slopes of S^T p, gathered inwards.
void RecursiveJacobian::gather() {
  for (auto& change : change_) change.setZero();
  for (const Share& share : shares_) {
    change_[idx(share.to)].noalias() += share.slopes * motion_[idx(share.from)];
  }
  const auto turned = [&](int b) {
    BodyResidual::Slopes out;
    const Vec6<Scalar>& a = acceleration_[idx(b)].vector();
    for (int i = 0; i < 6; ++i) out.row(i) = Eigen::Map<const Row>(a[i].slope.data());
    return out;
  };
  for (Vec6d& of_body : coupled_) of_body.setZero();
  for (const MassCoupling& c : at_->terms.couplings()) {
    c.add_product(c.mass, at_->acceleration, coupled_.data());
    change_[idx(c.first)].noalias() -= c.mass * turned(c.second);
    change_[idx(c.second)].noalias() -= c.mass.transpose() * turned(c.first);
  }
  for (int b = 0; b < model_->body_count(); ++b) {
    change_[idx(b)].noalias() -= at_->mass[b] * turned(b);
    const Vec6d p = at_->load[b] - at_->mass[b] * at_->acceleration[b] - coupled_[idx(b)];
    Vec6<Scalar> force = p.cast<Scalar>();
    for (int i = 0; i < 6; ++i) Eigen::Map<Row>(force[i].slope.data()) = change_[idx(b)].row(i);
    force_[idx(b)] = Wrench<Scalar>(force);
  }
  force_.back() = Wrench<Scalar>::zero();
  for (std::size_t i = tree_.clusters.size(); i-- > 0;) {
    const Cluster& c = tree_.clusters[i];
    torque_[i].setZero();
    for (const Member& m : c.members) {
      const Wrench<Scalar>& f = force_[idx(m.body)];
      for (int k = 0; k < c.speeds; ++k) {
        const Scalar g = dot(kinematics_.columns(m)[k], f);
        torque_[i].row(k) += Eigen::Map<const Row>(g.slope.data());
      }
      if (c.kind == Cluster::floating) continue;
      force_[idx(c.parent)].add_shifted_from(kinematics_.over_parent(m.body).reach, f);
    }
  }
}

void RecursiveJacobian::write_column(int k, double* column) {
  const Model& m = *model_;
  spread_torques(k);
  turn_rows(k);
  double power = 0.0, absolute_power = 0.0;
  for (int b = 0; b < m.body_count(); ++b) {
    power += power_[idx(b)].dot(motion_[idx(b)].col(k));
    absolute_power += absolute_power_[idx(b)].dot(motion_[idx(b)].col(k));
  }
  add_inertial_slopes(k);
  solve(column, power, absolute_power);
  double* fluid = column + tree_.positions + tree_.speeds;
  for (std::size_t v = 0; v < m.vessels.size(); ++v) {
    const Vessel& vessel = m.vessels[v];
    Eigen::Map<VecXd>(fluid + vessel.memory_offset - m.layout.memory, vessel.memory_states()).noalias() =
        fluid_[v] * motion_[idx(vessel.body)].col(k);
  }
  for (const HydroGroup& group : m.groups) {
    Eigen::Map<VecXd> rates(fluid + group.memory_offset - m.layout.memory, group.memory.states());
    for (const int v : group.vessels) {
      rates.noalias() += group_[idx(v)] * motion_[idx(m.vessels[idx(v)].body)].col(k);
    }
  }
  Eigen::Map<VecXd> of_loads(fluid + m.layout.loads - m.layout.memory,
                             static_cast<Eigen::Index>(m.load_states.size()));
  for (int b = 0; b < m.body_count(); ++b) of_loads.noalias() += state_over_[idx(b)] * motion_[idx(b)].col(k);
}

/// load_: torques of clusters as wrenches on their bodies, and opposite ones on what carries these.
void RecursiveJacobian::spread_torques(int k) {
  const TreeKinematics<double>& tree = at_->tree.kinematics();
  for (auto& load : load_) load.setZero();
  for (std::size_t i = 0; i < tree_.clusters.size(); ++i) {
    const Cluster& c = tree_.clusters[i];
    if (c.speeds == 0) continue;
    Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6> s(6, c.speeds);
    for (int j = 0; j < c.speeds; ++j) s.col(j) = tree.columns(c.members[0])[j].vector();
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6> gram = s.transpose() * s;
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> torque = torque_[i].col(k).head(c.speeds);
    const Wrench<double> wrench(s * gram.llt().solve(torque));
    load_[idx(c.body)] += wrench.vector();
    if (c.kind != Cluster::floating) {
      load_[idx(c.parent)] -= wrench.shifted_from(tree.over_parent(c.body).reach).vector();
    }
  }
  load_.back().setZero();
}

/// right_: what the rows lack, by how they and the accelerations turn.
void RecursiveJacobian::turn_rows(int k) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    double turned = 0.0;
    const ElementModel& element = model_->elements[idx(rows_[i].first)];
    const RowBlock<double>& block = at_->blocks[rows_[i].first];
    for (int side = 0; side < 2; ++side) {
      const Vec6<Scalar>& a = acceleration_[idx(side == 0 ? element.first : element.second)].vector();
      for (int j = 0; j < 6; ++j) turned += block.d[side](rows_[i].second, j) * a[j].slope[idx(k)];
    }
    right_[static_cast<Eigen::Index>(i)] = -turned;
  }
  for (const RowShare& share : row_shares_) {
    right_[share.row] += share.slopes.dot(motion_[idx(share.from)].col(k));
  }
}

/// own_: by the bodies' directions, and by how their accelerations turn while rates of speeds are held.
void RecursiveJacobian::add_inertial_slopes(int k) {
  if (own_.size() == 0) return;
  own_.setZero();
  for (int b = 0; b < model_->body_count(); ++b) {
    own_.noalias() += inertial_over_[idx(b)] * motion_[idx(b)].col(k);
    const Vec6<Scalar>& a = acceleration_[idx(b)].vector();
    for (int i = 0; i < 6; ++i) response_[idx(b)][i] = a[i].slope[idx(k)];
  }
  for (Eigen::Index i = 0; i < own_.size(); ++i) own_[i] += at_->tensions.along(i, response_.data());
}

void RecursiveJacobian::write_state_columns(double* out) {
  const Model& m = *model_;
  const int fluid = tree_.positions + tree_.speeds, n = fluid + states_ + 2;
  const int first = fluid + m.layout.loads - m.layout.memory;
  for (int i = 0; i < static_cast<int>(m.load_states.size()); ++i) {
    const int k = i % kDirections;
    if (k == 0) residual_.differentiate_states(i);
    for (auto& load : load_) load.setZero();
    for (int touched : residual_.touched()) load_[idx(touched)] = residual_.load(touched).col(k);
    load_.back().setZero();
    right_.setZero();
    write_slopes(residual_.inertial_tensions(), k, own_.data());
    double* const column = out + idx(n) * idx(first + i);
    solve(column, residual_.sum().power.slope[idx(k)], residual_.sum().absolute_power.slope[idx(k)]);
    write_slopes(residual_.state_rates(), k, column + first);
  }
}

/// response_ and rates of the speeds under load_ and right_, which it overwrites.
void RecursiveJacobian::respond(double* u_rate) {
  at_->tree.solve(load_.data(), false, response_.data(), u_rate);
  if (rows_.empty()) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    right_[static_cast<Eigen::Index>(i)] -= along_row(static_cast<int>(i), response_.data());
  }
  lambda_ = at_->loops.solve(right_);
  at_->loops.add_load(at_->blocks, lambda_, load_.data());
  at_->tree.solve(load_.data(), false, response_.data(), u_rate);
}

/// Rates of the speeds and the work under load_, right_ and own_, which it may overwrite.
void RecursiveJacobian::solve(double* column, double power, double absolute_power) {
  double* const u_rate = column + tree_.positions;
  if (at_->tensions.any()) {
    given_load_ = load_;
    given_right_ = right_;
    respond(u_rate);
    const VecXd& change = at_->tensions.change(own_, response_.data());
    at_->tensions.add_loads(change, given_load_.data());
    power += at_->tensions.power(change);
    absolute_power += at_->tensions.absolute_power(change);
    load_ = given_load_;
    right_ = given_right_;
  }
  respond(u_rate);
  if (!rows_.empty()) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const ElementModel& element = model_->elements[idx(rows_[i].first)];
      if (!element.driver) continue;
      const double rate = at_->blocks[rows_[i].first].nu[0], change = lambda_[static_cast<Eigen::Index>(i)];
      power += rate * change;
      absolute_power += sign(rate * multipliers_[idx(element.row)]) * rate * change;
    }
  }
  add_drive_power(power, absolute_power);
  column[tree_.positions + tree_.speeds + states_] = power;
  column[tree_.positions + tree_.speeds + states_ + 1] = absolute_power;
}

/// By how the drives' forces change at the last respond().
void RecursiveJacobian::add_drive_power(double& power, double& absolute_power) {
  drive_change_.clear();
  at_->driven.read(at_->tree, drive_change_);
  for (std::size_t k = 0; k < drive_change_.size(); ++k) {
    const double change = at_->driven.power(k, drive_change_);
    power += change;
    absolute_power += sign(at_->driven.power(k, at_->forces)) * change;
  }
}

double RecursiveJacobian::along_row(int row, const Vec6d* acceleration) const {
  const auto [e, r] = rows_[idx(row)];
  const ElementModel& element = model_->elements[idx(e)];
  return at_->blocks[e].d[0].row(r).dot(acceleration[element.first]) +
         at_->blocks[e].d[1].row(r).dot(acceleration[element.second]);
}

/// The memory is linear: six unit loads in the yaw frame tell how its states act.
void RecursiveJacobian::write_memory_columns(const double* y, double* out) {
  const Model& m = *model_;
  const int first = tree_.positions + tree_.speeds, n = first + states_ + 2;
  Eigen::Map<MatXd> jacobian(out, n, n);
  for (std::size_t v = 0; v < m.vessels.size(); ++v) {
    const Vessel& vessel = m.vessels[v];
    const int states = vessel.memory_states();
    const int at = first + vessel.memory_offset - m.layout.memory;
    if (states == 0) continue;
    const YawFrame<double>& frame = at_->terms.frames()[v];
    const double direction = memory_power_sign(vessel, frame, y + at, to_fluid_.col(0).data());
    respond_to_motions(v, direction);
    const BodyResidual::WaveSlopes& waves = residual_.wave_slopes(v);
    write_wave_slopes(vessel, waves, memory_[v].c);
    jacobian.middleCols(at, states).noalias() = -to_fluid_ * memory_[v].c;
    for (int i = vessel.fluid_states(); i < states; ++i) {
      jacobian(n - 1, at + i) += (direction - waves.direction) * frame.twist.dot(memory_[v].c.col(i));
    }
    jacobian.block(at, at, states, states) += memory_[v].a;
  }
  for (std::size_t g = 0; g < m.groups.size(); ++g) write_group_columns(g, y, out);
}

void RecursiveJacobian::write_group_columns(std::size_t g, const double* y, double* out) {
  const Model& m = *model_;
  const HydroGroup& group = m.groups[g];
  const int first = tree_.positions + tree_.speeds, n = first + states_ + 2;
  const int states = group.memory.states(), at = first + group.memory_offset - m.layout.memory;
  if (states == 0) return;
  Eigen::Map<MatXd> jacobian(out, n, n);
  const std::vector<YawFrame<double>>& frames = at_->terms.frames();
  HydroGroup::Motions<double> mu;
  group.remember(frames.data(), y + at, to_fluid_.col(0).data(), mu);
  for (std::size_t k = 0; k < group.vessels.size(); ++k) {
    const auto v = idx(group.vessels[k]);
    respond_to_motions(v, sign(-frames[v].twist.dot(Eigen::Map<const Vec6d>(&mu[6 * k]))));
    jacobian.middleCols(at, states).noalias() -=
        to_fluid_ * groups_[g].c.middleRows<6>(static_cast<Eigen::Index>(6 * k));
  }
  jacobian.block(at, at, states, states) += groups_[g].a;
}

/// to_fluid_: responses to unit loads of a vessel's motions, whose power has this sign.
void RecursiveJacobian::respond_to_motions(std::size_t v, double direction) {
  const YawFrame<double>& frame = at_->terms.frames()[v];
  to_fluid_.setZero();
  own_.setZero();
  for (int i = 0; i < 6; ++i) {
    right_.setZero();
    for (auto& load : load_) load.setZero();
    load_[idx(model_->vessels[v].body)] = frame.to_inertial(Vec6d(Vec6d::Unit(i)));
    solve(to_fluid_.col(i).data(), frame.twist[i], direction * frame.twist[i]);
  }
}

}  // namespace seacrane
