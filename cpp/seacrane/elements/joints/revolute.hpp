#pragma once

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"

namespace seacrane {

/// Rotation about z_a: d = 0, z_b . x_a = z_b . y_a = 0. Coordinate: angle about z_a from x_a to x_b, zero
/// where the frames agree.
struct Revolute : JointDefaults {
  static constexpr const char* kind = "revolute";
  static constexpr int rows = 5;
  static constexpr const char* coordinates = "angle";
  static constexpr const char* usual = "angle";
  static constexpr bool parallel_axes = true;

  static JointDescription example(Random& random) { return example_joint<Revolute>(random); }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::coincident(g, out, 0);
    rows::parallel_z(g, out, 3);
  }

  struct Branch : branch::ScalarRates<1> {
    static constexpr int positions = 1, speeds = 1;
    static constexpr bool turns_alone = true;  // about one direction through the parent's point
    static constexpr const char *position_kinds = "a", *speed_kinds = "a";  // a: rad, l: m

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* /*u*/,
                     BranchMotionOf<T>& out) {
      const Mat3<T> a = branch::parent_axes(j, parent);
      out.rotation = times_transpose<T>(branch::turn_about_z<T>(a, q[0]), j.child_axes);
      out.reach = branch::parent_lever(j, parent);
      out.slide[0] = Vec3<T>::Zero();
      out.turn[0] = a.col(2);
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const Mat3d a = branch::parent_axes(j, parent);
      q[0] = branch::turned(a, branch::child_axes(j, child));
      u[0] = a.col(2).dot(branch::Gap(j, parent, child).turning);
    }
  };
};

}  // namespace seacrane
