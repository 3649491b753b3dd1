#pragma once

#include <array>
#include <cmath>

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/math/rotation.hpp"

namespace seacrane {

/// The coordinates that a joint can offer, all measured in the joint frame of the first body.
enum class CoordinateKind { angle, displacement, x, y, z, roll, pitch, yaw };

/// Fixed data of one joint coordinate.
struct CoordinateData {
  JointData joint;
  CoordinateKind kind = CoordinateKind::angle;

  std::array<int, 2> bodies() const { return {joint.first, joint.second}; }
};

/// value, its row of D (value' = da v_a + db v_b) and the velocity part of value'': value'' = D vdot - gamma.
template <class T>
struct CoordinateRow {
  T value;
  Vec6<T> da, db;
  T gamma;
};

inline bool is_angular(CoordinateKind kind) {
  return kind == CoordinateKind::angle || kind >= CoordinateKind::roll;
}

namespace detail {

template <class T>
CoordinateRow<T> slide(const JointGeometry<T>& g, int axis) {
  RowBlock<T> block;
  rows::along<T>(g, g.a.col(axis), block, 0);
  return {block.phi[0], block.d[0].row(0).transpose(), block.d[1].row(0).transpose(), block.gamma[0]};
}

template <class T>
CoordinateRow<T> rotation_row(const T& value, const Vec3<T>& axis, const T& gamma) {
  CoordinateRow<T> out;
  out.value = value;
  out.da << Vec3<T>::Zero(), -axis;
  out.db << Vec3<T>::Zero(), axis;
  out.gamma = gamma;
  return out;
}

template <class T>
CoordinateRow<T> turn(const JointGeometry<T>& g) {
  using std::atan2;
  const Vec3<T> z = g.a.col(2);
  const T angle = atan2(g.a.col(1).dot(g.b.col(0)), g.a.col(0).dot(g.b.col(0)));
  const Vec3<T> relative = g.omega_b - g.omega_a;
  return rotation_row<T>(angle, z, -cross<T>(g.omega_a, z).dot(relative));
}

/// Roll, pitch or yaw of the second body's joint axes relative to the first's, R = Rz Ry Rx.
template <class T>
CoordinateRow<T> tilt(const JointGeometry<T>& g, CoordinateKind kind) {
  using std::cos, std::sin;
  const Mat3<T> relative = g.a.transpose() * g.b;
  const Vec3<T> angles = roll_pitch_yaw<T>(relative);
  const T ct = cos(angles[1]), st = sin(angles[1]), cp = cos(angles[2]), sp = sin(angles[2]);
  const Vec3<T> w = g.a.transpose() * (g.omega_b - g.omega_a);
  const T u = cp * w[0] + sp * w[1];  // = roll rate * cos(pitch)
  const T pitch_rate = -sp * w[0] + cp * w[1];
  const T yaw_rate = w[2] + st / ct * u;
  Vec3<T> k, k_rate;
  if (kind == CoordinateKind::roll) {
    k = {cp / ct, sp / ct, T(0)};
    const T scale = st / (ct * ct) * pitch_rate;
    k_rate = {-sp / ct * yaw_rate + cp * scale, cp / ct * yaw_rate + sp * scale, T(0)};
  } else if (kind == CoordinateKind::pitch) {
    k = {-sp, cp, T(0)};
    k_rate = {-cp * yaw_rate, -sp * yaw_rate, T(0)};
  } else {
    const T tangent = st / ct, tangent_rate = pitch_rate / (ct * ct);
    k = {tangent * cp, tangent * sp, T(1)};
    k_rate = {tangent_rate * cp - tangent * sp * yaw_rate, tangent_rate * sp + tangent * cp * yaw_rate, T(0)};
  }
  const Vec3<T> axis = g.a * k;
  // d/dt(A^T) (omega_b - omega_a) = -A^T (omega_a x (omega_b - omega_a))
  const T bias = k_rate.dot(w) - axis.dot(cross<T>(g.omega_a, g.omega_b));
  const T value =
      kind == CoordinateKind::roll ? angles[0] : (kind == CoordinateKind::pitch ? angles[1] : angles[2]);
  return rotation_row<T>(value, axis, -bias);
}

}  // namespace detail

template <class T>
CoordinateRow<T> evaluate_coordinate(const CoordinateData& c, const BodyKinematics<T>& ka,
                                     const BodyKinematics<T>& kb) {
  const JointGeometry<T> g(c.joint, ka, kb);
  switch (c.kind) {
    case CoordinateKind::angle:
      return detail::turn(g);
    case CoordinateKind::displacement:
      return detail::slide(g, 2);
    case CoordinateKind::x:
      return detail::slide(g, 0);
    case CoordinateKind::y:
      return detail::slide(g, 1);
    case CoordinateKind::z:
      return detail::slide(g, 2);
    default:
      return detail::tilt(g, c.kind);
  }
}

template <class T>
T coordinate_rate(const CoordinateRow<T>& row, const BodyKinematics<T>& ka, const BodyKinematics<T>& kb) {
  return row.da.template head<3>().dot(ka.velocity) + row.da.template tail<3>().dot(ka.angular_velocity) +
         row.db.template head<3>().dot(kb.velocity) + row.db.template tail<3>().dot(kb.angular_velocity);
}

}  // namespace seacrane
