#pragma once

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

/// Sliding along and rotation about the joint z axis.
struct Cylindrical {
  static constexpr const char* kind = "cylindrical";
  static constexpr int rows = 4;
  static constexpr const char* coordinates = "angle displacement";
  static constexpr bool parallel_axes = true;  // z axes point the same way
  static constexpr bool aligned_axes = false;  // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::along<T>(g, g.a.col(0), out, 0);
    rows::along<T>(g, g.a.col(1), out, 1);
    rows::parallel_z(g, out, 2);
  }
};

}  // namespace seacrane
