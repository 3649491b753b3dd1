#pragma once

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"

namespace seacrane {

/// Motion in the plane normal to z_a: d . z_a = 0, z_b . x_a = z_b . y_a = 0. No coordinate.
struct Planar : JointDefaults {
  static constexpr const char* kind = "planar";
  static constexpr int rows = 3;
  static constexpr bool slides = true;
  static constexpr bool parallel_axes = true;

  static JointDescription example(Random& random) { return example_joint<Planar>(random); }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::along<T>(g, g.a.col(2), out, 0);
    rows::parallel_z(g, out, 1);
  }

  struct Branch : branch::ScalarRates<3> {
    static constexpr int positions = 3, speeds = 3;
    static constexpr const char *position_kinds = "lla", *speed_kinds = "lla";  // a: rad, l: m

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* /*u*/,
                     BranchMotionOf<T>& out) {
      const Mat3<T> a = branch::parent_axes(j, parent);
      out.rotation = branch::turn_about_z<T>(a, q[2]) * j.child_axes.transpose().cast<T>();
      out.reach = branch::parent_lever(j, parent) + q[0] * a.col(0) + q[1] * a.col(1);
      for (int i = 0; i < 2; ++i) {
        out.slide[i] = a.col(i);
        out.turn[i] = Vec3<T>::Zero();
      }
      out.slide[2] = Vec3<T>::Zero();
      out.turn[2] = a.col(2);
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const Mat3d a = branch::parent_axes(j, parent);
      const branch::Gap gap(j, parent, child);
      for (int i = 0; i < 2; ++i) {
        q[i] = a.col(i).dot(gap.offset);
        u[i] = a.col(i).dot(gap.rate);
      }
      q[2] = branch::turned(a, branch::child_axes(j, child));
      u[2] = a.col(2).dot(gap.turning);
    }
  };
};

}  // namespace seacrane
