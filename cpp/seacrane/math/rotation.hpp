#pragma once

#include <algorithm>
#include <cmath>

#include "seacrane/math/select.hpp"
#include "seacrane/math/types.hpp"

/// Orientation: R takes body components to inertial components; angular velocities are in inertial axes.
namespace seacrane {

/// Rotation matrix of a quaternion (w, x, y, z) of any length except zero.
template <class T>
Mat3<T> rotation_from_quaternion(const Vec4<T>& q) {
  const T w = q[0], x = q[1], y = q[2], z = q[3];
  const T s = T(2) / (w * w + x * x + y * y + z * z);
  Mat3<T> r;
  r << T(1) - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), T(1) - s * (x * x + z * z), s * (y * z - w * x),   //
      s * (x * z - w * y), s * (y * z + w * x), T(1) - s * (x * x + y * y);
  return r;
}

/// dq/dt = 1/2 (0, omega) * q with omega in inertial axes.
template <class T>
Vec4<T> quaternion_rate(const Vec4<T>& q, const Vec3<T>& omega) {
  const T w = q[0], x = q[1], y = q[2], z = q[3], h = T(0.5);
  return {h * (-omega[0] * x - omega[1] * y - omega[2] * z), h * (omega[0] * w + omega[1] * z - omega[2] * y),
          h * (omega[1] * w + omega[2] * x - omega[0] * z), h * (omega[2] * w + omega[0] * y - omega[1] * x)};
}

/// Unit quaternion (w >= 0) of a rotation matrix; Shepperd's choice of the largest component.
inline Vec4d quaternion_from_rotation(const Mat3d& r) {
  const double trace = r.trace();
  Vec4d q;
  int i = 0;
  double largest = trace;
  for (int k = 0; k < 3; ++k) {
    if (r(k, k) > largest) {
      largest = r(k, k);
      i = k + 1;
    }
  }
  if (i == 0) {
    q << 1.0 + trace, r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1);
  } else {
    const int a = i - 1, b = i % 3, c = (i + 1) % 3;
    q[0] = r(c, b) - r(b, c);
    q[1 + a] = 1.0 + r(a, a) - r(b, b) - r(c, c);
    q[1 + b] = r(b, a) + r(a, b);
    q[1 + c] = r(c, a) + r(a, c);
  }
  q.normalize();
  return q[0] < 0.0 ? Vec4d(-q) : q;
}

/// R = Rx(phi_x) Ry(phi_y) Rz(phi_z), the paper's angles.
template <class T>
Mat3<T> rotation_from_euler_xyz(const Vec3<T>& phi) {
  using std::cos, std::sin;
  const T cx = cos(phi[0]), sx = sin(phi[0]), cy = cos(phi[1]), sy = sin(phi[1]), cz = cos(phi[2]),
          sz = sin(phi[2]);
  Mat3<T> r;
  r << cy * cz, -cy * sz, sy,                                    //
      cx * sz + sx * sy * cz, cx * cz - sx * sy * sz, -sx * cy,  //
      sx * sz - cx * sy * cz, sx * cz + cx * sy * sz, cx * cy;
  return r;
}

inline Vec3d euler_xyz_from_rotation(const Mat3d& r) {
  return {std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)),
          std::atan2(-r(0, 1), r(0, 0))};
}

/// omega = E phidot, the paper's T^-1 of eq. (20) with its (1,3) entry corrected to sin(phi_y).
template <class T>
Mat3<T> euler_xyz_to_omega(const Vec3<T>& phi) {
  using std::cos, std::sin;
  const T cx = cos(phi[0]), sx = sin(phi[0]), cy = cos(phi[1]), sy = sin(phi[1]);
  Mat3<T> e;
  e << T(1), T(0), sy, T(0), cx, -sx * cy, T(0), sx, cx * cy;
  return e;
}

/// d/dt of euler_xyz_to_omega, eq. (22) with the (1,3) entry cos(phi_y) phidot_y.
template <class T>
Mat3<T> euler_xyz_to_omega_rate(const Vec3<T>& phi, const Vec3<T>& rate) {
  using std::cos, std::sin;
  const T cx = cos(phi[0]), sx = sin(phi[0]), cy = cos(phi[1]), sy = sin(phi[1]);
  Mat3<T> e;
  e << T(0), T(0), cy * rate[1],                                    //
      T(0), -sx * rate[0], -cx * cy * rate[0] + sx * sy * rate[1],  //
      T(0), cx * rate[0], -sx * cy * rate[0] - cx * sy * rate[1];
  return e;
}

/// phidot = T(phi) omega, eq. (18); singular at phi_y = +-90 deg.
template <class T>
Vec3<T> euler_xyz_rate(const Vec3<T>& phi, const Vec3<T>& omega) {
  using std::cos, std::sin;
  const T cx = cos(phi[0]), sx = sin(phi[0]), cy = cos(phi[1]), sy = sin(phi[1]);
  const T z = (-sx * omega[1] + cx * omega[2]) / cy;
  return {omega[0] - sy * z, cx * omega[1] + sx * omega[2], z};
}

/// (roll, pitch, yaw) with R = Rz(yaw) Ry(pitch) Rx(roll).
template <class T>
Vec3<T> roll_pitch_yaw(const Mat3<T>& r) {
  using std::asin, std::atan2;
  const T s = clamped(r(2, 0), T(-1), T(1));
  return {atan2(r(2, 1), r(2, 2)), asin(-s), atan2(r(1, 0), r(0, 0))};
}

template <class T>
Mat3<T> rotation_about_z(const T& cosine, const T& sine) {
  Mat3<T> r;
  r << cosine, -sine, T(0), sine, cosine, T(0), T(0), T(0), T(1);
  return r;
}

/// An angle in [-pi, pi).
template <class T>
T wrap_angle(const T& x) {
  using std::floor;
  constexpr double two_pi = 6.283185307179586476925;
  return x - T(two_pi) * floor(x / T(two_pi) + T(0.5));
}

/// Unit quaternion of the rotation vector (inertial axes) applied before q: exp(rotation) * q.
inline Vec4d rotate_quaternion(const Vec3d& rotation, const Vec4d& q) {
  const double angle = rotation.norm();
  const double half_sinc = angle > 1e-8 ? std::sin(0.5 * angle) / angle : 0.5;
  const double w = std::cos(0.5 * angle);
  const Vec3d v = half_sinc * rotation, u = q.tail<3>();
  Vec4d out;
  out[0] = w * q[0] - v.dot(u);
  out.tail<3>() = w * u + q[0] * v + v.cross(u);
  return out.normalized();
}

/// exp(rotation + d) = exp(slope d) exp(rotation) for small d: the left Jacobian of SO(3).
inline Mat3d exponential_slope(const Vec3d& rotation) {
  const double square = rotation.squaredNorm(), angle = std::sqrt(square);
  const bool small = angle < 1e-2;  // series right to 1e-17
  const double a = small ? 0.5 - square / 24.0 + square * square / 720.0 : (1.0 - std::cos(angle)) / square;
  const double b = small ? 1.0 / 6.0 - square / 120.0 + square * square / 5040.0
                         : (angle - std::sin(angle)) / (angle * square);
  const Mat3d s = skew<double>(rotation);
  return Mat3d::Identity() + a * s + b * s * s;
}

}  // namespace seacrane
