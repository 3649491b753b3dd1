#pragma once

#include <string>

#include "seacrane/math/types.hpp"

namespace seacrane {

struct BodyDescription {
  std::string name;
  double mass = 0.0;
  Mat3d inertia = Mat3d::Zero();           // about the centre of mass, body axes
  Vec3d center_of_mass = Vec3d::Zero();    // from the body origin, body axes
  Vec3d position = Vec3d::Zero();          // of the body origin, inertial frame
  Vec4d quaternion = {1, 0, 0, 0};         // body to inertial
  Vec3d velocity = Vec3d::Zero();          // of the body origin, inertial frame
  Vec3d angular_velocity = Vec3d::Zero();  // inertial frame
  bool gravity = true;
};

}  // namespace seacrane
