#pragma once

#include "seacrane/elements/joint_rows.hpp"

namespace seacrane {

/// No constraint; carries drivers and coordinates.
struct Free {
  static constexpr const char* kind = "free";
  static constexpr int rows = 0;
  static constexpr const char* coordinates = "x y z roll pitch yaw";
  static constexpr bool parallel_axes = false;  // z axes point the same way
  static constexpr bool aligned_axes = false;   // x axes too

  template <class T>
  static void evaluate(const JointGeometry<T>& /*g*/, const JointData& /*joint*/, RowBlock<T>& /*out*/) {}
};

}  // namespace seacrane
