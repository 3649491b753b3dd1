#include "seacrane/dynamics/residual_jacobian.hpp"

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/terms.hpp"

namespace seacrane {
ResidualJacobian::ResidualJacobian(const Model& model)
    : model_(&model),
      residual_(model),
      memory_(memory_matrices(model)),
      groups_(group_matrices(model)),
      acceleration_(idx(model.body_count()) + 1, Vec6d::Zero()),
      correction_(acceleration_),
      column_(model.layout.size + 2 * model.rows()) {}

void ResidualJacobian::evaluate(const Terms& terms, double t, double c, const double* y, const double* ydot,
                                double* out) {
  const Model& m = *model_;
  terms_ = &terms;
  const double* lambda = y + m.layout.size;
  for (int b = 0; b < m.body_count(); ++b) acceleration_[idx(b)] = view<6>(ydot + m.layout.twist(b));
  residual_.start(terms, t, {acceleration_.data(), lambda, lambda + m.rows(), y + m.layout.memory});
  multiplier_load(terms, lambda + m.rows(), correction_);
  Eigen::Map<MatXd> jacobian(out, column_.size(), column_.size());
  jacobian.setZero();
  for (int b = 0; b < m.body_count(); ++b) {
    residual_.differentiate(b);
    write_body_columns(b, y, jacobian);
  }
  write_memory_columns(y, jacobian);
  write_state_columns(jacobian);
  write_multiplier_columns(y, jacobian);
  write_rate_terms(c, jacobian);
}

/// M0^-1 of a load.
Vec6d ResidualJacobian::over_mass(int b, const Vec6d& load) const {
  const BodyModel& body = model_->bodies[idx(b)];
  Vec6d out = load / body.mass;
  out.tail<3>() = load.tail<3>() / (body.inertia.trace() / 3.0);
  return out;
}

/// -N(q) velocity into the pose rows of a body.
void ResidualJacobian::add_pose_rates(int b, const double* angles, const Vec6d& velocity,
                                      double* column) const {
  double* pose = column + model_->layout.pose(b);
  const Vec3d omega = velocity.tail<3>();
  view<3>(pose) -= velocity.head<3>();
  if (model_->description.orientation == Orientation::quaternion) {
    view<4>(pose + 3) -= quaternion_rate<double>(view<4>(angles), omega);
  } else {
    view<3>(pose + 3) -= euler_xyz_rate<double>(view<3>(angles), omega);
  }
}

void ResidualJacobian::write_body_columns(int b, const double* y, Eigen::Map<MatXd>& out) {
  const Model& m = *model_;
  const StateLayout& s = m.layout;
  const int pose = s.pose(b), angle = pose + 3, vessel = m.bodies[idx(b)].vessel, angles = s.pose_size - 3;
  const auto turn = turning(m.description.orientation, y + angle);
  for (int k = 0; k < BodyResidual::kDirections; ++k) {
    const auto d = idx(k);
    column_.setZero();
    for (int to : residual_.touched()) {
      if (to == m.body_count()) continue;
      column_.segment<6>(s.twist(to)) = -over_mass(to, residual_.load(to).col(k));
      add_pose_rates(to, y + s.pose(to) + 3, over_mass(to, residual_.second_load(to).col(k)), column_.data());
    }
    if (k >= 6) add_pose_rates(b, y + angle, Vec6d::Unit(k - 6), column_.data());
    if (vessel >= 0) {
      const Vessel& v = m.vessels[idx(vessel)];
      for (int i = 0; i < v.memory_states(); ++i) {
        column_[v.memory_offset + i] = -residual_.memory_rates()[idx(i)].slope[d];
      }
      const HydroGroup* const group = m.group_of(vessel);
      for (int i = 0; group && i < group->memory.states(); ++i) {
        column_[group->memory_offset + i] = -residual_.group_rates()[idx(i)].slope[d];
      }
    }
    write_load_rates(k, column_.data());
    for (int r = 0; r < m.rows(); ++r) {
      column_[s.size + r] = residual_.velocity_rows()[idx(r)].slope[d];
      column_[s.size + m.rows() + r] = residual_.position_rows()[idx(r)].slope[d];
    }
    if (k < 3) {
      out.col(pose + k) = column_;
    } else if (k < 6) {
      for (int j = 0; j < angles; ++j) out.col(angle + j) += turn(k - 3, j) * column_;
    } else {
      out.col(s.twist(b) + k - 6) = column_;
    }
  }
  const Vec3d omega = terms_->bodies()[idx(b)].angular_velocity + over_mass(b, correction_[idx(b)]).tail<3>();
  const TurningRate rate(m.description.orientation, y + angle, omega);
  out.block(angle, angle, angles, angles) -= rate.in_angles;
}

void ResidualJacobian::write_memory_columns(const double* y, Eigen::Map<MatXd>& out) {
  const Model& m = *model_;
  for (std::size_t v = 0; v < m.vessels.size(); ++v) {
    const Vessel& vessel = m.vessels[v];
    const int states = vessel.memory_states(), at = vessel.memory_offset;
    if (states == 0) continue;
    const YawFrame<double>& frame = terms_->frames()[v];
    const double direction = memory_power_sign(vessel, frame, y + at, column_.data());
    const BodyResidual::WaveSlopes& waves = residual_.wave_slopes(v);
    write_wave_slopes(vessel, waves, memory_[v].c);
    for (int i = 0; i < states; ++i) {
      const Vec6d mu = memory_[v].c.col(i);
      const double power = frame.twist.dot(mu);
      out.block<6, 1>(m.layout.twist(vessel.body), at + i) = over_mass(vessel.body, frame.to_inertial(mu));
      out(m.layout.work, at + i) = power;
      out(m.layout.work + 1, at + i) = (i < vessel.fluid_states() ? direction : waves.direction) * power;
    }
    out.block(at, at, states, states) = -memory_[v].a;
  }
  for (std::size_t g = 0; g < m.groups.size(); ++g) write_group_columns(g, y, out);
}

void ResidualJacobian::write_group_columns(std::size_t g, const double* y, Eigen::Map<MatXd>& out) {
  const Model& m = *model_;
  const HydroGroup& group = m.groups[g];
  const int states = group.memory.states(), at = group.memory_offset;
  if (states == 0) return;
  HydroGroup::Motions<double> mu;
  group.remember(terms_->frames().data(), y + at, column_.data(), mu);
  for (std::size_t k = 0; k < group.vessels.size(); ++k) {
    const auto v = idx(group.vessels[k]);
    const YawFrame<double>& frame = terms_->frames()[v];
    const int body = m.vessels[v].body;
    const double direction = sign(-frame.twist.dot(Eigen::Map<const Vec6d>(&mu[6 * k])));
    for (int i = 0; i < states; ++i) {
      const Vec6d load = groups_[g].c.block<6, 1>(static_cast<Eigen::Index>(6 * k), i);
      const double power = frame.twist.dot(load);
      out.block<6, 1>(m.layout.twist(body), at + i) = over_mass(body, frame.to_inertial(load));
      out(m.layout.work, at + i) += power;
      out(m.layout.work + 1, at + i) += direction * power;
    }
  }
  out.block(at, at, states, states) = -groups_[g].a;
}

/// Writes the rates of the states of loads and of the work, in a direction of the residual.
void ResidualJacobian::write_load_rates(int direction, double* column) const {
  const StateLayout& s = model_->layout;
  const auto d = idx(direction);
  for (std::size_t i = 0; i < model_->load_states.size(); ++i) {
    column[idx(s.loads) + i] = -residual_.state_rates()[i].slope[d];
  }
  column[s.work] = -residual_.sum().power.slope[d];
  column[s.work + 1] = -residual_.sum().absolute_power.slope[d];
}

void ResidualJacobian::write_state_columns(Eigen::Map<MatXd>& out) {
  const Model& m = *model_;
  for (int i = 0; i < static_cast<int>(m.load_states.size()); ++i) {
    const int k = i % BodyResidual::kDirections;
    if (k == 0) residual_.differentiate_states(i);
    double* const column = out.col(m.layout.loads + i).data();
    for (int to : residual_.touched()) {
      if (to == m.body_count()) continue;
      view<6>(column + m.layout.twist(to)) = -over_mass(to, residual_.load(to).col(k));
    }
    write_load_rates(k, column);
  }
}

void ResidualJacobian::write_multiplier_columns(const double* y, Eigen::Map<MatXd>& out) {
  const Model& m = *model_;
  const StateLayout& s = m.layout;
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    const RowBlock<double>& block = terms_->blocks()[e];
    const int bodies[2] = {element.first, element.second};
    for (int r = 0; r < element.rows; ++r) {
      const int lambda = s.size + element.row + r, mu = lambda + m.rows();
      for (int side = 0; side < 2; ++side) {
        const int b = bodies[side];
        if (b == m.body_count()) continue;
        const Vec6d load = over_mass(b, block.d[side].row(r).transpose());
        out.col(lambda).segment<6>(s.twist(b)) -= load;
        add_pose_rates(b, y + s.pose(b) + 3, load, out.col(mu).data());
      }
      if (!element.driver) continue;
      const double power = block.nu[r];
      out(s.work, lambda) = -power;
      out(s.work + 1, lambda) = -sign(power * y[lambda]) * power;
    }
  }
}

/// + c F_y'.
void ResidualJacobian::write_rate_terms(double c, Eigen::Map<MatXd>& out) const {
  const Model& m = *model_;
  const StateLayout& s = m.layout;
  for (int b = 0; b < m.body_count(); ++b) {
    const Mat6d mass = terms_->mass_matrix(b);
    for (int i = 0; i < 6; ++i) {
      out.block<6, 1>(s.twist(b), s.twist(b) + i) += c * over_mass(b, mass.col(i));
    }
  }
  for (const MassCoupling& pair : terms_->couplings()) {
    for (int i = 0; i < 6; ++i) {
      out.block<6, 1>(s.twist(pair.first), s.twist(pair.second) + i) +=
          c * over_mass(pair.first, pair.mass.col(i));
      out.block<6, 1>(s.twist(pair.second), s.twist(pair.first) + i) +=
          c * over_mass(pair.second, pair.mass.row(i).transpose());
    }
  }
  for (int i = 0; i < s.velocity; ++i) out(i, i) += c;
  for (int i = s.memory; i < s.size; ++i) out(i, i) += c;
}

}  // namespace seacrane
