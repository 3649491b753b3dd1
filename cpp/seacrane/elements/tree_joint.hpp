#pragma once

#include <algorithm>
#include <cmath>

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/math/products.hpp"
#include "seacrane/math/rotation.hpp"

/// Joints as branches of a tree: the child's motion over its parent in the joint's own coordinates. Joint
/// types that have a `Branch` can be branches; all others, and what closes loops, stay constraint rows.
namespace seacrane {

/// Fixed data of a branch: points from the state points, axes in the bodies. Either body of a joint may be
/// the parent: a joint whose two bodies are not alike asks for the direction.
struct TreeJoint {
  int parent = -1, child = -1;
  Vec3d parent_point = Vec3d::Zero(), child_point = Vec3d::Zero();
  Mat3d parent_axes = Mat3d::Identity(), child_axes = Mat3d::Identity();
  ParameterValues parameters{};
  bool reversed = false;  // the parent is the joint's second body
};

inline constexpr int kMostSpeeds = 6;

/// What a joint type says of its branch, inertial axes: with the joint point that of the child and all rates
/// relative to the parent, point rate = sum slide_k u_k and angular velocity = sum turn_k u_k.
template <class T>
struct BranchMotionOf {
  Mat3<T> rotation;  // child to inertial
  Vec3<T> reach;     // parent's state point to the child's joint point
  Vec3<T> slide[kMostSpeeds], turn[kMostSpeeds];
  Vec3<T> slide_bias = Vec3<T>::Zero();  // their derivatives in the parent's frame with udot = 0
  Vec3<T> turn_bias = Vec3<T>::Zero();
};
using BranchMotion = BranchMotionOf<double>;

namespace branch {

/// Joint axes of the parent, and of the child, in inertial axes.
template <class T>
Mat3<T> parent_axes(const TreeJoint& j, const BodyKinematics<T>& parent) {
  return times<T>(parent.rotation, j.parent_axes);
}
inline Mat3d child_axes(const TreeJoint& j, const BodyKinematics<double>& child) {
  return child.rotation * j.child_axes;
}

template <class T>
Vec3<T> parent_lever(const TreeJoint& j, const BodyKinematics<T>& parent) {
  return times<T>(parent.rotation, j.parent_point);
}

/// From the parent's joint point to the child's, and the relative rate of the two in the parent's frame.
struct Gap {
  Vec3d offset, rate, turning;
  Gap(const TreeJoint& j, const BodyKinematics<double>& parent, const BodyKinematics<double>& child) {
    const Vec3d lever = child.rotation * j.child_point;
    const Vec3d at_child = child.position + lever;
    const Vec3d from_parent = at_child - parent.position;
    offset = from_parent - parent_lever(j, parent);
    rate = child.velocity + child.angular_velocity.cross(lever) - parent.velocity -
           parent.angular_velocity.cross(from_parent);
    turning = child.angular_velocity - parent.angular_velocity;
  }
};

/// Angle about z from the axes a to the axes b.
inline double turned(const Mat3d& a, const Mat3d& b) {
  return std::atan2(a.col(1).dot(b.col(0)), a.col(0).dot(b.col(0)));
}

/// Axes a turned about their z axis.
template <class T>
Mat3<T> turn_about_z(const Mat3<T>& a, const T& angle) {
  const auto [c, s] = cos_sin(angle);
  Mat3<T> out;
  for (int i = 0; i < 3; ++i) {
    out(i, 0) = c * a(i, 0) + s * a(i, 1);
    out(i, 1) = c * a(i, 1) - s * a(i, 0);
    out(i, 2) = a(i, 2);
  }
  return out;
}

template <class T>
Vec4<T> quaternion(const T* q) {
  return {q[0], q[1], q[2], q[3]};
}

template <class T>
Vec3<T> vector(const T* u) {
  return {u[0], u[1], u[2]};
}

/// Rate of the quaternion at q that turns with omega, inertial axes.
template <class T>
void turn(const T* q, const Vec3<T>& omega, T* q_rate) {
  const Vec4<T> rate = quaternion_rate<T>(quaternion(q), omega);
  for (int i = 0; i < 4; ++i) q_rate[i] = rate[i];
}

/// Speeds are the rates of the coordinates.
template <int count>
struct ScalarRates {
  template <class T>
  static void rates(const BodyKinematics<T>& /*parent*/, const T* /*q*/, const T* u, T* q_rate) {
    std::copy_n(u, count, q_rate);
  }
};

/// Three speeds along the inertial axes: child's angular velocity over its parent's. Its derivative in the
/// parent's frame does not vanish with udot.
template <class T>
void free_turning(const BodyKinematics<T>& parent, const T* u, int first, BranchMotionOf<T>& out) {
  for (int i = 0; i < 3; ++i) {
    out.slide[first + i] = Vec3<T>::Zero();
    out.turn[first + i] = Vec3d::Unit(i).cast<T>();
  }
  out.turn_bias = -cross<T>(parent.angular_velocity, vector(u + first));
}

}  // namespace branch
}  // namespace seacrane
