#pragma once

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"

namespace seacrane {

/// Two axes at a right angle that meet in a point: d = 0, z_a . z_b = 0. No coordinate.
struct Universal : JointDefaults {
  static constexpr const char* kind = "universal";
  static constexpr int rows = 4;
  static constexpr bool own_axis = true;

  static JointDescription example(Random& random) {
    Frame quarter_turn;
    quarter_turn.axes << Vec3d::UnitX(), Vec3d::UnitZ(), -Vec3d::UnitY();
    return example_joint<Universal>(random, quarter_turn);
  }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::coincident(g, out, 0);
    rows::perpendicular<T>(g, g.a.col(2), g.b.col(2), out, 3);
  }

  /// Turns about z of the parent's axes, then about z of the child's, at a right angle: no position of it is
  /// singular.
  struct Branch : branch::ScalarRates<2> {
    static constexpr int positions = 2, speeds = 2;
    static constexpr const char *position_kinds = "aa", *speed_kinds = "aa";  // a: rad, l: m

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* u,
                     BranchMotionOf<T>& out) {
      const Mat3<T> a = branch::parent_axes(j, parent);
      const Mat3<T> b = branch::turn_about_z<T>(crossed<T>(branch::turn_about_z<T>(a, q[0])), q[1]);
      out.rotation = b * j.child_axes.transpose().cast<T>();
      out.reach = branch::parent_lever(j, parent);
      out.slide[0] = out.slide[1] = Vec3<T>::Zero();
      out.turn[0] = a.col(2);
      out.turn[1] = b.col(2);
      out.turn_bias = u[0] * u[1] * cross<T>(a.col(2), b.col(2));
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const Mat3d a = branch::parent_axes(j, parent), b = branch::child_axes(j, child);
      q[0] = std::atan2(b.col(2).dot(a.col(0)), -b.col(2).dot(a.col(1)));
      q[1] = branch::turned(crossed<double>(branch::turn_about_z<double>(a, q[0])), b);
      const Vec3d turning = branch::Gap(j, parent, child).turning;
      u[0] = a.col(2).dot(turning);
      u[1] = b.col(2).dot(turning);
    }

   private:
    /// The second axis at right angles to the first: axes turned about their x axis by 90 deg.
    template <class T>
    static Mat3<T> crossed(const Mat3<T>& a) {
      Mat3<T> out;
      out << a.col(0), a.col(2), -a.col(1);
      return out;
    }
  };
};

}  // namespace seacrane
