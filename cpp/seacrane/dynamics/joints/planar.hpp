#pragma once

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

/// Motion in the plane normal to the joint z axis of the first body.
struct Planar {
  static constexpr const char* kind = "planar";
  static constexpr int rows = 3;
  static constexpr const char* coordinates = "";
  static constexpr bool parallel_axes = true;  // z axes point the same way
  static constexpr bool aligned_axes = false;  // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::along<T>(g, g.a.col(2), out, 0);
    rows::parallel_z(g, out, 1);
  }
};

}  // namespace seacrane
