#pragma once

#include <string>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// A joint frame on a body: a point and axes in body coordinates; the joint axis is z.
struct Frame {
  Vec3d point = Vec3d::Zero();
  Mat3d axes = Mat3d::Identity();
};

struct JointDescription {
  std::string name, kind, first, second;
  Frame first_frame, second_frame;
  double length = 0.0;  // of a distance joint
  bool open = false;    // holds nothing now: a limit that is not reached, see limit.hpp
};

}  // namespace seacrane
