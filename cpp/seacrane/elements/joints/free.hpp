#pragma once

#include "seacrane/elements/joint_rows.hpp"

namespace seacrane {

/// No constraint: carries drivers, coordinates and stops. Coordinates: x, y, z of d in the axes of the first
/// frame; roll, pitch, yaw of the second frame's axes over them, R = Rz Ry Rx.
struct Free : JointDefaults {
  static constexpr const char* kind = "free";
  static constexpr int rows = 0;
  static constexpr const char* coordinates = "x y z roll pitch yaw";

  static JointDescription example(Random& random) { return example_joint<Free>(random); }

  template <class T>
  static void evaluate(const JointGeometry<T>& /*g*/, const JointData& /*joint*/, RowBlock<T>& /*out*/) {}
};

}  // namespace seacrane
