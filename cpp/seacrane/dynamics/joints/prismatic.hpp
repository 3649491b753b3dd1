#pragma once

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

/// Sliding along the joint z axis of the first body.
struct Prismatic {
  static constexpr const char* kind = "prismatic";
  static constexpr int rows = 5;
  static constexpr const char* coordinates = "displacement";
  static constexpr bool parallel_axes = true;  // z axes point the same way
  static constexpr bool aligned_axes = true;   // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::along<T>(g, g.a.col(0), out, 0);
    rows::along<T>(g, g.a.col(1), out, 1);
    rows::aligned(g, out, 2);
  }
};

}  // namespace seacrane
