#pragma once

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"

namespace seacrane {

/// Coincident points: d = 0. No coordinate.
struct Spherical : JointDefaults {
  static constexpr const char* kind = "spherical";
  static constexpr int rows = 3;

  static JointDescription example(Random& random) { return example_joint<Spherical>(random); }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::coincident(g, out, 0);
  }

  /// The child's quaternion; speeds are its angular velocity over the parent's, inertial axes.
  struct Branch {
    static constexpr int positions = 4, speeds = 3;
    static constexpr const char *position_kinds = "aaaa", *speed_kinds = "aaa";  // a: rad, l: m

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* u,
                     BranchMotionOf<T>& out) {
      out.rotation = rotation_from_quaternion<T>(branch::quaternion(q));
      out.reach = branch::parent_lever(j, parent);
      branch::free_turning(parent, u, 0, out);
    }
    template <class T>
    static void rates(const BodyKinematics<T>& parent, const T* q, const T* u, T* q_rate) {
      branch::turn<T>(q, parent.angular_velocity + branch::vector(u), q_rate);
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      view<4>(q) = quaternion_from_rotation(child.rotation);
      view<3>(u) = branch::Gap(j, parent, child).turning;
    }
  };
};

}  // namespace seacrane
