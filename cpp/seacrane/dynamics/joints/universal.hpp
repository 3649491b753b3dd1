#pragma once

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

/// Coincident points; the z axis of the first stays perpendicular to the z axis of the second.
struct Universal {
  static constexpr const char* kind = "universal";
  static constexpr int rows = 4;
  static constexpr const char* coordinates = "";
  static constexpr bool parallel_axes = false;  // z axes point the same way
  static constexpr bool aligned_axes = false;   // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::coincident(g, out, 0);
    rows::perpendicular<T>(g, g.a.col(2), g.b.col(2), out, 3);
  }
};

}  // namespace seacrane
