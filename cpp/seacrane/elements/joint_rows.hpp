#pragma once

#include <cmath>

#include "seacrane/elements/joint.hpp"
#include "seacrane/elements/kinematics.hpp"

/// Rows of the constraint Jacobian D, eqs (4), (7), (8): D_a v_a + D_b v_b = nu, and the velocity part
/// gamma of D vdot = gamma. Joint types are made of the few rows below.
namespace seacrane {

inline constexpr int kMaxRows = 6;

/// Up to six rows; matrices are 6 x 6 with unused rows zero, columns (force, moment about state point).
template <class T>
struct RowBlock {
  Mat6<T> d[2] = {Mat6<T>::Zero(), Mat6<T>::Zero()};  // of the first and the second body
  Vec6<T> phi = Vec6<T>::Zero();                      // position residual, m or rad
  Vec6<T> gamma = Vec6<T>::Zero();                    // right-hand side on acceleration level
  Vec6<T> nu = Vec6<T>::Zero();                       // prescribed rate (drivers)
};

/// Fixed data of a joint between compiled bodies a (first) and b (second), points from the state points.
struct JointData {
  int first = -1, second = -1;
  Vec3d first_point, second_point;
  Mat3d first_axes, second_axes;
  ParameterValues parameters{};
  int element = 0;  // index among all constraint elements
};

/// What every row needs, computed once per joint.
template <class T>
struct JointGeometry {
  Vec3<T> lever_a, lever_b;   // state point to joint point
  Vec3<T> d, d_rate, d_bias;  // joint point b minus a, its rate, its acceleration without vdot
  Mat3<T> a, b;               // joint axes in the inertial frame
  Vec3<T> omega_a, omega_b;

  JointGeometry(const JointData& joint, const BodyKinematics<T>& ka, const BodyKinematics<T>& kb)
      : lever_a(ka.rotation * joint.first_point.cast<T>()),
        lever_b(kb.rotation * joint.second_point.cast<T>()),
        d(kb.position + lever_b - ka.position - lever_a),
        a(ka.rotation * joint.first_axes.cast<T>()),
        b(kb.rotation * joint.second_axes.cast<T>()),
        omega_a(ka.angular_velocity),
        omega_b(kb.angular_velocity) {
    const Vec3<T> va = cross<T>(omega_a, lever_a), vb = cross<T>(omega_b, lever_b);
    d_rate = kb.velocity + vb - ka.velocity - va;
    d_bias = cross<T>(omega_b, vb) - cross<T>(omega_a, va);
  }
};

namespace rows {

/// Coincident points: three rows at `row`, in inertial axes.
template <class T>
void coincident(const JointGeometry<T>& g, RowBlock<T>& out, int row) {
  for (int i = 0; i < 3; ++i) {
    out.d[0](row + i, i) = T(-1);
    out.d[1](row + i, i) = T(1);
  }
  out.d[0].template block<3, 3>(row, 3) = skew(g.lever_a);
  const Vec3<T> minus_b = -g.lever_b;
  out.d[1].template block<3, 3>(row, 3) = skew(minus_b);
  out.phi.template segment<3>(row) = g.d;
  out.gamma.template segment<3>(row) = -g.d_bias;
}

/// e . d = 0 with the direction e fixed in the first body.
template <class T>
void along(const JointGeometry<T>& g, const Vec3<T>& e, RowBlock<T>& out, int row) {
  const Vec3<T> arm_a = g.lever_a + g.d;
  const Vec3<T> e_rate = cross<T>(g.omega_a, e);
  out.d[0].row(row) << -e.transpose(), cross<T>(e, arm_a).transpose();
  out.d[1].row(row) << e.transpose(), cross<T>(g.lever_b, e).transpose();
  out.phi[row] = e.dot(g.d);
  out.gamma[row] = -(e.dot(g.d_bias) + T(2) * e_rate.dot(g.d_rate) + cross<T>(g.omega_a, e_rate).dot(g.d));
}

/// u . w = 0 with u fixed in the first and w in the second body.
template <class T>
void perpendicular(const JointGeometry<T>& g, const Vec3<T>& u, const Vec3<T>& w, RowBlock<T>& out, int row) {
  const Vec3<T> n = cross<T>(u, w);
  const Vec3<T> u_rate = cross<T>(g.omega_a, u), w_rate = cross<T>(g.omega_b, w);
  const Vec3<T> n_rate = cross<T>(u_rate, w) + cross<T>(u, w_rate);
  out.d[0].row(row).template tail<3>() = n.transpose();
  out.d[1].row(row).template tail<3>() = -n.transpose();
  out.phi[row] = u.dot(w);
  out.gamma[row] = -n_rate.dot(g.omega_a - g.omega_b);
}

/// Parallel z axes: two rows.
template <class T>
void parallel_z(const JointGeometry<T>& g, RowBlock<T>& out, int row) {
  perpendicular<T>(g, g.a.col(0), g.b.col(2), out, row);
  perpendicular<T>(g, g.a.col(1), g.b.col(2), out, row + 1);
}

/// Equal orientation: three rows, regular near zero relative rotation.
template <class T>
void aligned(const JointGeometry<T>& g, RowBlock<T>& out, int row) {
  perpendicular<T>(g, g.a.col(0), g.b.col(1), out, row);
  perpendicular<T>(g, g.a.col(1), g.b.col(2), out, row + 1);
  perpendicular<T>(g, g.a.col(2), g.b.col(0), out, row + 2);
}

/// |d| - length = 0; without a direction when the points coincide, which the caller excludes.
template <class T>
void distance(const JointGeometry<T>& g, const T& length, RowBlock<T>& out, int row) {
  using std::sqrt;
  const T r = sqrt(g.d.dot(g.d));
  const Vec3<T> n = g.d / r;
  const T radial = n.dot(g.d_rate);
  out.d[0].row(row) << -n.transpose(), -cross<T>(g.lever_a, n).transpose();
  out.d[1].row(row) << n.transpose(), cross<T>(g.lever_b, n).transpose();
  out.phi[row] = r - length;
  out.gamma[row] = -(n.dot(g.d_bias) + (g.d_rate.dot(g.d_rate) - radial * radial) / r);
}

}  // namespace rows
}  // namespace seacrane
