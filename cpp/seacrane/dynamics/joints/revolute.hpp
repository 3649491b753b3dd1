#pragma once

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

/// Rotation about the joint z axis.
struct Revolute {
  static constexpr const char* kind = "revolute";
  static constexpr int rows = 5;
  static constexpr const char* coordinates = "angle";
  static constexpr bool parallel_axes = true;  // z axes point the same way
  static constexpr bool aligned_axes = false;  // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::coincident(g, out, 0);
    rows::parallel_z(g, out, 3);
  }
};

}  // namespace seacrane
