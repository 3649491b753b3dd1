#include "seacrane/dynamics/gear_gupta_leimkuhler.hpp"

#include <algorithm>

#include "seacrane/dynamics/constraints.hpp"

namespace seacrane {
GearGuptaLeimkuhler::GearGuptaLeimkuhler(MaximalSystem& system) : system_(&system) {
  const Model& m = system.model();
  differential_.assign(idx(m.layout.size + 2 * m.rows()), 0.0);
  std::fill_n(differential_.begin(), m.layout.size, 1.0);
  rate_.assign(idx(m.layout.size), 0.0);
  load_.assign(idx(m.body_count()) + 1, Vec6d::Zero());
  correction_ = load_;
}

void GearGuptaLeimkuhler::residual(double t, const double* y, const double* ydot, double* r) {
  Terms& terms = system_->terms();
  const Model& m = terms.model();
  const StateLayout& s = m.layout;
  const double* lambda = y + s.size;
  const double* mu = lambda + m.rows();
  terms.evaluate(t, y, rate_.data());
  multiplier_load(terms, lambda, load_);
  multiplier_load(terms, mu, correction_);
  for (int b = 0; b < m.body_count(); ++b) {
    const BodyModel& body = m.bodies[idx(b)];
    const BodyKinematics<double>& k = terms.bodies()[idx(b)];
    const double inertia = body.inertia.trace() / 3.0;
    const Vec3d shift = correction_[idx(b)].head<3>() / body.mass,
                turn = correction_[idx(b)].tail<3>() / inertia;
    const double* pose = y + s.pose(b);
    double* r_pose = r + s.pose(b);
    const double* pose_rate = ydot + s.pose(b);
    view<3>(r_pose) = view<3>(pose_rate) - k.velocity - shift;
    const Vec3d omega = k.angular_velocity + turn;
    if (s.pose_size == 7) {
      view<4>(r_pose + 3) = view<4>(pose_rate + 3) - quaternion_rate<double>(view<4>(pose + 3), omega);
    } else {
      view<3>(r_pose + 3) = view<3>(pose_rate + 3) - euler_xyz_rate<double>(view<3>(pose + 3), omega);
    }
    Vec6d balance = terms.mass_matrix(b) * view<6>(ydot + s.twist(b)) - terms.loads()[idx(b)] - load_[idx(b)];
    balance.head<3>() /= body.mass;
    balance.tail<3>() /= inertia;
    view<6>(r + s.twist(b)) = balance;
  }
  for (const MassCoupling& c : terms.couplings()) {
    const auto add = [&](int to, const Vec6d& balance) {
      const BodyModel& body = m.bodies[idx(to)];
      view<3>(r + s.twist(to)) += balance.head<3>() / body.mass;
      view<3>(r + s.twist(to) + 3) += balance.tail<3>() / (body.inertia.trace() / 3.0);
    };
    add(c.first, c.mass * view<6>(ydot + s.twist(c.second)));
    add(c.second, c.mass.transpose() * view<6>(ydot + s.twist(c.first)));
  }
  for (int i = s.memory; i < s.work; ++i) r[i] = ydot[i] - rate_[idx(i)];
  for (std::size_t e = m.elements.size() - m.drivers.size(); e < m.elements.size(); ++e) {
    terms.add_driver_power(lambda[m.elements[e].row] * terms.blocks()[e].nu[0]);
  }
  r[s.work] = ydot[s.work] - terms.power().sum;
  r[s.work + 1] = ydot[s.work + 1] - terms.power().absolute;
  double* r_rate = r + s.size;
  double* r_position = r_rate + m.rows();
  rate_residual(terms, y, r_rate);
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    for (int i = 0; i < m.elements[e].rows; ++i) {
      r_position[m.elements[e].row + i] = terms.blocks()[e].phi[i];
    }
  }
}

bool GearGuptaLeimkuhler::jacobian(double t, double c, const double* y, const double* ydot, double* out) {
  if (system_->model().paper_kinematics) return false;
  if (!jacobian_) jacobian_.emplace(system_->model());
  system_->terms().evaluate(t, y, rate_.data());
  jacobian_->evaluate(system_->terms(), t, c, y, ydot, out);
  return true;
}

void GearGuptaLeimkuhler::expand(double t, const double* ode_state, double* y, double* ydot) {
  const Model& m = system_->model();
  std::fill_n(y, size(), 0.0);
  std::fill_n(ydot, size(), 0.0);
  std::copy_n(ode_state, m.layout.size, y);
  system_->derivative(t, ode_state, ydot);
  std::copy_n(system_->multipliers().data(), m.rows(), y + m.layout.size);
}

void GearGuptaLeimkuhler::contract(double /*t*/, const double* y, double* ode_state) const {
  std::copy_n(y, system_->model().layout.size, ode_state);
}

}  // namespace seacrane
