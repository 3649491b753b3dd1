#pragma once

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"

namespace seacrane {

/// No relative motion: d = 0 and the axes of both frames agree, x_a . y_b = y_a . z_b = z_a . x_b = 0.
/// No coordinate.
struct Weld : JointDefaults {
  static constexpr const char* kind = "weld";
  static constexpr int rows = 6;
  static constexpr bool parallel_axes = true;
  static constexpr bool aligned_axes = true;

  static JointDescription example(Random& random) { return example_joint<Weld>(random); }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::coincident(g, out, 0);
    rows::aligned(g, out, 3);
  }

  struct Branch : branch::ScalarRates<0> {
    static constexpr int positions = 0, speeds = 0;
    static constexpr const char *position_kinds = "", *speed_kinds = "";

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* /*q*/, const T* /*u*/,
                     BranchMotionOf<T>& out) {
      out.rotation = branch::parent_axes(j, parent) * j.child_axes.transpose().cast<T>();
      out.reach = branch::parent_lever(j, parent);
    }
    static void read(const TreeJoint& /*j*/, const BodyKinematics<double>& /*parent*/,
                     const BodyKinematics<double>& /*child*/, double* /*q*/, double* /*u*/) {}
  };
};

}  // namespace seacrane
