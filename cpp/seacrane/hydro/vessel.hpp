#pragma once

#include <cmath>
#include <optional>
#include <variant>

#include "seacrane/elements/loads/load.hpp"
#include "seacrane/hydro/convolution.hpp"
#include "seacrane/hydro/memory.hpp"
#include "seacrane/math/rotation.hpp"
#include "seacrane/math/select.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

/// Surge, sway (m, inertial axes) and yaw (rad) of a hull above a cut-off frequency w: the high-pass filter
/// s^2 (s + 2 w) / (s^3 + 2 w s^2 + 2 w^2 s + w^3) of each, driven by its rate. What it leaves follows a
/// steady drift without lag. Three states each, in the unit of the motion, which is the first of them.
struct FastMotion {
  static constexpr int states = 9;
  double cutoff = 0.0;  // rad/s

  template <class T>
  void rates(const Vec3<T>& velocity, const T* x, T* x_rate) const {
    for (int i = 0; i < 3; ++i, x += 3, x_rate += 3) {
      x_rate[0] = velocity[i] + cutoff * (x[1] - 2.0 * x[0]);
      x_rate[1] = 2.0 * velocity[i] + cutoff * (x[2] - 2.0 * x[0]);
      x_rate[2] = -cutoff * x[0];
    }
  }

  /// A velocity at the start is that of a steady drift: the fast motion is zero and stays it.
  void start(const Vec3d& velocity, double* x) const {
    for (int i = 0; i < 3; ++i, x += 3) {
      x[0] = 0.0;
      x[1] = -velocity[i] / cutoff;
      x[2] = -2.0 * velocity[i] / cutoff;
    }
  }

  static Vec3d of(const double* x) { return {x[0], x[3], x[6]}; }
};

template <class T>
struct YawFrame;
/// 6 x 6 of loads in one yaw frame over motions in another, both to inertial axes.
template <class T>
Mat6<T> between(const YawFrame<T>& loads, const Mat6d& a, const YawFrame<T>& motions);

/// The frame that follows yaw: psi of yaw-pitch-roll angles; the twist and its components in it.
template <class T>
struct YawFrame {
  T roll, pitch, yaw, cos_pitch, tan_pitch, yaw_rate;
  Mat3<T> rotation;  // yaw frame to inertial
  Vec6<T> twist;     // in the yaw frame

  explicit YawFrame(const BodyKinematics<T>& k) {
    using std::atan2, std::sqrt;
    const Mat3<T>& r = k.rotation;
    cos_pitch = sqrt(r(0, 0) * r(0, 0) + r(1, 0) * r(1, 0));
    const T over = T(1) / cos_pitch;
    tan_pitch = -(over * r(2, 0));
    rotation = rotation_about_z<T>(over * r(0, 0), over * r(1, 0));
    roll = atan2(r(2, 1), r(2, 2));
    pitch = atan2(-r(2, 0), cos_pitch);
    yaw = atan2(r(1, 0), r(0, 0));
    const Vec3<T> linear = in_frame(k.velocity), angular = in_frame(k.angular_velocity);
    twist << linear, angular;
    yaw_rate = twist[5] + tan_pitch * twist[3];
  }

  /// d/dt(R^T) v = -psi' e_z x (R^T v), in the yaw frame.
  Vec6<T> turning() const {
    Vec6<T> out;
    out << yaw_rate * twist[1], -yaw_rate * twist[0], T(0), yaw_rate * twist[4], -yaw_rate * twist[3], T(0);
    return out;
  }

  /// Rate of the twist's components in the yaw frame, from the accelerations in inertial axes.
  Vec6<T> twist_rate(const Vec6<T>& acceleration) const {
    const Vec3<T> linear = in_frame(acceleration.template head<3>()),
                  angular = in_frame(acceleration.template tail<3>());
    Vec6<T> out = turning();
    for (int i = 0; i < 3; ++i) {
      out[i] += linear[i];
      out[3 + i] += angular[i];
    }
    return out;
  }

  T pitch_rate() const { return twist[4]; }

  /// A symmetric 6 x 6 in the yaw frame to inertial axes.
  SpatialInertia<T> inertia(const Mat6d& a) const;

  Vec6<T> to_inertial(const Vec6<T>& w) const {
    const Vec3<T> force = out_of_frame({w[0], w[1], w[2]}), moment = out_of_frame({w[3], w[4], w[5]});
    return {force[0], force[1], force[2], moment[0], moment[1], moment[2]};
  }
  Vec3<T> out_of_frame(const Vec3<T>& v) const {
    const T cosine = rotation(0, 0), sine = rotation(1, 0);
    return {cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1], v[2]};
  }
  /// Components in the yaw frame of a vector in inertial axes.
  Vec3<T> in_frame(const Vec3<T>& v) const {
    const T cosine = rotation(0, 0), sine = rotation(1, 0);
    return {cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0], v[2]};
  }

  /// Moment whose power is -(roll_load roll' + pitch_load pitch' + yaw_load yaw'): exact gradient of a
  /// potential in the three angles, so that restoring conserves energy.
  Vec3<T> moment_of(const T& roll_load, const T& pitch_load, const T& yaw_load) const {
    return {-(roll_load / cos_pitch + yaw_load * tan_pitch), -pitch_load, -yaw_load};
  }
};

/// Of that the 3 x 3 from (i, j) on.
template <class T>
Mat3<T> part_between(const YawFrame<T>& loads, const Mat6d& a, int i, int j, const YawFrame<T>& motions) {
  const T cosine = motions.rotation(0, 0), sine = motions.rotation(1, 0);
  Vec3<T> x, y, z;  // columns of a R^T
  for (int k = 0; k < 3; ++k) {
    x[k] = cosine * T(a(i + k, j)) - sine * T(a(i + k, j + 1));
    y[k] = sine * T(a(i + k, j)) + cosine * T(a(i + k, j + 1));
    z[k] = T(a(i + k, j + 2));
  }
  Mat3<T> out;
  out.col(0) = loads.out_of_frame(x);
  out.col(1) = loads.out_of_frame(y);
  out.col(2) = loads.out_of_frame(z);
  return out;
}

template <class T>
Mat6<T> between(const YawFrame<T>& loads, const Mat6d& a, const YawFrame<T>& motions) {
  Mat6<T> out;
  for (int j = 0; j < 6; j += 3) {
    for (int i = 0; i < 6; i += 3) {
      out.template block<3, 3>(i, j) = part_between(loads, a, i, j, motions);
    }
  }
  return out;
}

template <class T>
SpatialInertia<T> YawFrame<T>::inertia(const Mat6d& a) const {
  return {Symmetric3<T>::lower(part_between(*this, a, 0, 0, *this)),
          part_between(*this, a, 3, 0, *this).transpose(),
          Symmetric3<T>::lower(part_between(*this, a, 3, 3, *this))};
}

/// Linear hydrodynamics of one vessel about its reference point (its state point).
struct Vessel {
  int body = 0;
  Mat6d added_mass;
  Mat6d linear_damping;
  Vec6d quadratic_damping;
  Mat3d restoring;                           // heave, roll, pitch
  Vec3d mooring_stiffness, mooring_damping;  // surge, sway, yaw
  Vec3d mean_position;
  double mean_yaw = 0.0;
  Mat3d mean_axes = Mat3d::Identity();  // of the mean heading
  std::variant<Memory, Convolution> memory;
  std::optional<FastMotion> fast;  // where wave loads are those of the slow pose
  int memory_offset = 0;           // in the state vector

  int fluid_states() const {
    const auto* models = std::get_if<Memory>(&memory);
    return models ? models->states() : 0;
  }
  /// States of the fluid memory, then those of the fast motion.
  int memory_states() const { return fluid_states() + (fast ? FastMotion::states : 0); }

  /// -R A d/dt(R^T v) = -(R A R^T) vdot - bias: bias of the added mass, inertial axes.
  template <class T>
  Wrench<T> added_mass_bias(const YawFrame<T>& f) const {
    const T surge = f.yaw_rate * f.twist[1], sway = -(f.yaw_rate * f.twist[0]);  // YawFrame::turning()
    const T roll = f.yaw_rate * f.twist[4], pitch = -(f.yaw_rate * f.twist[3]);
    const auto turned = [&](int i) {
      return added_mass(i, 0) * surge + added_mass(i, 1) * sway + added_mass(i, 3) * roll +
             added_mass(i, 4) * pitch;
    };
    return {f.out_of_frame({turned(0), turned(1), turned(2)}),
            f.out_of_frame({turned(3), turned(4), turned(5)})};
  }

  /// Displacement (surge, sway, heave) from the mean position, in axes of the mean heading.
  template <class T>
  Vec3<T> displacement(const BodyKinematics<T>& k) const {
    return mean_axes.transpose().cast<T>() * (k.position - mean_position.cast<T>());
  }

  template <class T>
  Vec3<T> angles_from_mean(const YawFrame<T>& f) const {
    return {f.roll, f.pitch, wrap_angle<T>(f.yaw - T(mean_yaw))};
  }

  template <class T>
  void apply(const LoadInput<T>& in, const YawFrame<T>& f, const T* x, T* x_rate, LoadSum<T>& out) const {
    const auto& k = in.bodies[body];
    Vec6<T> load = damping(f, out);
    restore(f, k, out);
    const int fluid = fluid_states();
    if (fast) fast->rates<T>({k.velocity[0], k.velocity[1], f.yaw_rate}, x + fluid, x_rate + fluid);
    if (fluid > 0) {
      Vec6<T> mu = Vec6<T>::Zero();
      std::get<Memory>(memory).template evaluate<T>(f.twist.data(), x, x_rate, mu.data());
      out.add_power(-f.twist.dot(mu));
      load -= mu;
    }
    add(f, load, out);
  }

  /// Adds the load -mu of the memory; a convolution has its own history and is evaluated by whoever keeps it.
  template <class T>
  void radiate(const YawFrame<T>& f, const Vec6<T>& mu, LoadSum<T>& out) const {
    const Vec6<T> load = -mu;
    add(f, load, out);
    out.add_power(-f.twist.dot(mu));
  }

  double potential(const BodyKinematics<double>& k) const {
    const YawFrame<double> f(k);
    const Vec3d angles = angles_from_mean(f), shift = displacement(k);
    const Vec3d eta(shift[2], angles[0], angles[1]);
    return 0.5 * (eta.dot(restoring * eta) + mooring_stiffness[0] * shift[0] * shift[0] +
                  mooring_stiffness[1] * shift[1] * shift[1] + mooring_stiffness[2] * angles[2] * angles[2]);
  }

 private:
  /// The load of the damping, in the yaw frame; adds its power.
  template <class T>
  Vec6<T> damping(const YawFrame<T>& f, LoadSum<T>& out) const {
    using std::abs;
    const Vec6<T> linear = linear_damping.cast<T>() * f.twist;
    Vec6<T> quadratic;
    for (int i = 0; i < 6; ++i) {
      const T u = f.twist[i];
      quadratic[i] = T(quadratic_damping[i]) * select(u < T(0), T(-u), u) * u;
    }
    const Vec6<T> load = -(linear + quadratic);
    out.add_power(f.twist.dot(load));
    return load;
  }

  template <class T>
  void restore(const YawFrame<T>& f, const BodyKinematics<T>& k, LoadSum<T>& out) const {
    const Vec3<T> angles = angles_from_mean(f), shift = displacement(k);
    const Vec3<T> eta(shift[2], angles[0], angles[1]);
    const Vec3<T> load = restoring.cast<T>() * eta;
    const T yaw_damper = T(mooring_damping[2]) * f.yaw_rate;
    const T yaw_load = T(mooring_stiffness[2]) * angles[2] + yaw_damper;
    // Springs and dampers of surge and sway act along the axes of the mean heading.
    const Mat3<T> mean = mean_axes.cast<T>();
    const Vec3<T> rate = mean.transpose() * k.velocity;
    const Vec3<T> spring(-T(mooring_stiffness[0]) * shift[0], -T(mooring_stiffness[1]) * shift[1], -load[0]);
    const Vec3<T> damper(-T(mooring_damping[0]) * rate[0], -T(mooring_damping[1]) * rate[1], T(0));
    const Vec3<T> force = mean * (spring + damper);
    out.wrench[body].force += force;
    out.wrench[body].moment += f.out_of_frame(f.moment_of(load[1], load[2], yaw_load));
    out.add_power(damper.dot(rate) - yaw_damper * f.yaw_rate);
  }

  template <class T>
  void add(const YawFrame<T>& f, const Vec6<T>& load, LoadSum<T>& out) const {
    const Vec6<T> w = f.to_inertial(load);
    out.wrench[body].force += w.template head<3>();
    out.wrench[body].moment += w.template tail<3>();
  }
};

}  // namespace seacrane
