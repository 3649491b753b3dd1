#pragma once

#include <cmath>

#include "seacrane/dynamics/inertia.hpp"
#include "seacrane/hydro/vessel.hpp"

namespace seacrane {

/// The paper's vessel, eqs (17)-(31): coefficients act on eta = (r, phi) with XYZ Euler angles and fixed
/// axes, which makes the mass block (M + M_A) diag(I, T) unsymmetric. Eq. (20) is used corrected.
struct PaperVessel {
  Mat6d mass;  // M0
  Vec6d load;  // -B0 v - C eta - mu + b0 - springs and dampers

  PaperVessel(const BodyModel& body, const Vessel& v, const BodyKinematics<double>& k, const double* x,
              double* x_rate) {
    const Vec3d phi = euler_xyz_from_rotation(k.rotation);
    const Mat3d to_omega = euler_xyz_to_omega<double>(phi), t = to_omega.inverse();
    const Vec3d rate = t * k.angular_velocity;
    const Mat6d total = rigid_mass_matrix(body, Mat3d::Identity()) + v.added_mass;
    mass = total;
    mass.rightCols<3>() = total.rightCols<3>() * t;
    const Vec3d turning = t * (euler_xyz_to_omega_rate<double>(phi, rate) * rate);
    Vec6d eta_rate, mu = Vec6d::Zero();
    eta_rate << k.velocity, rate;
    std::get<Memory>(v.memory).evaluate<double>(eta_rate.data(), x, x_rate, mu.data());
    load = total.rightCols<3>() * turning - v.linear_damping * eta_rate - mu;
    for (int i = 0; i < 6; ++i) load[i] -= v.quadratic_damping[i] * std::abs(eta_rate[i]) * eta_rate[i];
    restore(v, k.position - v.mean_position, phi, eta_rate);
  }

 private:
  void restore(const Vessel& v, const Vec3d& shift, const Vec3d& phi, const Vec6d& rate) {
    const Vec3d c = v.restoring * Vec3d(shift[2], phi[0], phi[1]);
    load[2] -= c[0];
    load[3] -= c[1];
    load[4] -= c[2];
    const Vec3d moored(shift[0], shift[1], phi[2] - v.mean_yaw);
    for (int i = 0; i < 3; ++i) {
      const int motion = i == 2 ? 5 : i;
      load[motion] -= v.mooring_stiffness[i] * moored[i] + v.mooring_damping[i] * rate[motion];
    }
  }
};

}  // namespace seacrane
