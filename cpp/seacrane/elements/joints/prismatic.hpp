#pragma once

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"

namespace seacrane {

/// Sliding along z_a: d . x_a = d . y_a = 0, and the axes of both frames agree. Coordinate: displacement =
/// d . z_a.
struct Prismatic : JointDefaults {
  static constexpr const char* kind = "prismatic";
  static constexpr int rows = 5;
  static constexpr const char* coordinates = "displacement";
  static constexpr const char* usual = "displacement";
  static constexpr bool slides = true;
  static constexpr bool parallel_axes = true;
  static constexpr bool aligned_axes = true;

  static JointDescription example(Random& random) { return example_joint<Prismatic>(random); }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::along<T>(g, g.a.col(0), out, 0);
    rows::along<T>(g, g.a.col(1), out, 1);
    rows::aligned(g, out, 2);
  }

  struct Branch : branch::ScalarRates<1> {
    static constexpr int positions = 1, speeds = 1;
    static constexpr const char *position_kinds = "l", *speed_kinds = "l";  // a: rad, l: m

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* /*u*/,
                     BranchMotionOf<T>& out) {
      const Mat3<T> a = branch::parent_axes(j, parent);
      out.rotation = times_transpose<T>(a, j.child_axes);
      out.reach = branch::parent_lever(j, parent) + q[0] * a.col(2);
      out.slide[0] = a.col(2);
      out.turn[0] = Vec3<T>::Zero();
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const Vec3d axis = branch::parent_axes(j, parent).col(2);
      const branch::Gap gap(j, parent, child);
      q[0] = axis.dot(gap.offset);
      u[0] = axis.dot(gap.rate);
    }
  };
};

}  // namespace seacrane
