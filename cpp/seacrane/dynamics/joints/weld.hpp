#pragma once

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

/// No relative motion.
struct Weld {
  static constexpr const char* kind = "weld";
  static constexpr int rows = 6;
  static constexpr const char* coordinates = "";
  static constexpr bool parallel_axes = true;  // z axes point the same way
  static constexpr bool aligned_axes = true;   // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::coincident(g, out, 0);
    rows::aligned(g, out, 3);
  }
};

}  // namespace seacrane
