#pragma once

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"

namespace seacrane {

/// Sliding along and rotation about z_a: d . x_a = d . y_a = 0, z_b . x_a = z_b . y_a = 0. Coordinates: angle
/// about z_a from x_a to x_b, and displacement = d . z_a, the usual one.
struct Cylindrical : JointDefaults {
  static constexpr const char* kind = "cylindrical";
  static constexpr int rows = 4;
  static constexpr const char* coordinates = "angle displacement";
  static constexpr const char* usual = "displacement";
  static constexpr bool slides = true;
  static constexpr bool parallel_axes = true;

  static JointDescription example(Random& random) { return example_joint<Cylindrical>(random); }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::along<T>(g, g.a.col(0), out, 0);
    rows::along<T>(g, g.a.col(1), out, 1);
    rows::parallel_z(g, out, 2);
  }

  struct Branch : branch::ScalarRates<2> {
    static constexpr int positions = 2, speeds = 2;
    static constexpr const char *position_kinds = "al", *speed_kinds = "al";  // a: rad, l: m

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* /*u*/,
                     BranchMotionOf<T>& out) {
      const Mat3<T> a = branch::parent_axes(j, parent);
      out.rotation = branch::turn_about_z<T>(a, q[0]) * j.child_axes.transpose().cast<T>();
      out.reach = branch::parent_lever(j, parent) + q[1] * a.col(2);
      out.slide[0] = out.turn[1] = Vec3<T>::Zero();
      out.turn[0] = out.slide[1] = a.col(2);
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const Mat3d a = branch::parent_axes(j, parent);
      const branch::Gap gap(j, parent, child);
      q[0] = branch::turned(a, branch::child_axes(j, child));
      q[1] = a.col(2).dot(gap.offset);
      u[0] = a.col(2).dot(gap.turning);
      u[1] = a.col(2).dot(gap.rate);
    }
  };
};

}  // namespace seacrane
