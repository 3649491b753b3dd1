#pragma once

#include "seacrane/dynamics/joint_rows.hpp"
#include "seacrane/dynamics/recursive/tree_joint.hpp"

namespace seacrane {

/// Coincident points; the z axis of the first stays perpendicular to the z axis of the second.
struct Universal {
  static constexpr const char* kind = "universal";
  static constexpr int rows = 4;
  static constexpr const char* coordinates = "";
  static constexpr bool parallel_axes = false;  // z axes point the same way
  static constexpr bool aligned_axes = false;   // x axes too

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

    static void move(const TreeJoint& j, const BodyKinematics<double>& parent, const double* q,
                     const double* u, BranchMotion& out) {
      const Mat3d a = branch::parent_axes(j, parent);
      const Mat3d b = branch::turn_about_z(crossed(branch::turn_about_z(a, q[0])), q[1]);
      out.rotation = b * j.child_axes.transpose();
      out.reach = branch::parent_lever(j, parent);
      out.slide[0] = out.slide[1] = Vec3d::Zero();
      out.turn[0] = a.col(2);
      out.turn[1] = b.col(2);
      out.turn_bias = u[0] * u[1] * a.col(2).cross(b.col(2));
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const Mat3d a = branch::parent_axes(j, parent), b = branch::child_axes(j, child);
      q[0] = std::atan2(b.col(2).dot(a.col(0)), -b.col(2).dot(a.col(1)));
      q[1] = branch::turned(crossed(branch::turn_about_z(a, q[0])), b);
      const Vec3d turning = branch::Gap(j, parent, child).turning;
      u[0] = a.col(2).dot(turning);
      u[1] = b.col(2).dot(turning);
    }

   private:
    /// The second axis at right angles to the first: axes turned about their x axis by 90 deg.
    static Mat3d crossed(const Mat3d& a) {
      Mat3d out;
      out << a.col(0), a.col(2), -a.col(1);
      return out;
    }
  };
};

}  // namespace seacrane
