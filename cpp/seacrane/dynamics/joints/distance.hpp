#pragma once

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

/// Constant distance of the two points.
struct Distance {
  static constexpr const char* kind = "distance";
  static constexpr int rows = 1;
  static constexpr const char* coordinates = "";
  static constexpr bool parallel_axes = false;  // z axes point the same way
  static constexpr bool aligned_axes = false;   // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& joint, RowBlock<T>& out) {
    rows::distance<T>(g, T(joint.length), out, 0);
  }
};

}  // namespace seacrane
