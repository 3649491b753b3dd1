#pragma once

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

/// Coincident points.
struct Spherical {
  static constexpr const char* kind = "spherical";
  static constexpr int rows = 3;
  static constexpr const char* coordinates = "";
  static constexpr bool parallel_axes = false;  // z axes point the same way
  static constexpr bool aligned_axes = false;   // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::coincident(g, out, 0);
  }
};

}  // namespace seacrane
