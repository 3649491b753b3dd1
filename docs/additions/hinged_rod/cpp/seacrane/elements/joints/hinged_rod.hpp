#pragma once

#include "seacrane/elements/joint_rows.hpp"

namespace seacrane {

/// Two hinges with parallel axes z_a, z_b and a rod without mass between them:
/// d . z_a = 0, |d| = length, z_b . x_a = z_b . y_a = 0. No coordinate.
struct HingedRod : JointDefaults {
  static constexpr const char* kind = "hinged rod";
  static constexpr int rows = 4;
  static constexpr bool parallel_axes = true;
  static constexpr bool own_point = true;

  struct Parameters {
    double length = 0.0;

    static constexpr auto fields() {
      return std::tuple(
          required("length", &Parameters::length, "m", "between the hinges").must_be(Bound::positive));
    }
  };

  static JointDescription example(Random& random) {
    // A rod is long here: with a short one, differences of accelerations are too rough to judge an exact
    // Jacobian by.
    const double length = 1.0 + random.positive();
    return example_joint<HingedRod>(random, {length * Vec3d::UnitX()}, {{"length", length}});
  }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& joint, RowBlock<T>& out) {
    rows::along<T>(g, g.a.col(2), out, 0);
    rows::parallel_z(g, out, 1);
    rows::distance<T>(g, T(parameters_of<Parameters>(joint.parameters).length), out, 3);
  }
};

}  // namespace seacrane
