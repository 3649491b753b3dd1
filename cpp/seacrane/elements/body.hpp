#pragma once

#include <string>

#include "seacrane/elements/field.hpp"
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
  Vec3d size = Vec3d::Zero();  // of the box that it is, about the centre of mass; zero: not told

  static constexpr const char* type = "Body";
  static constexpr const char* text =
      "A rigid body: inertia about the centre of mass in body axes, pose of the body origin in the inertial "
      "frame, quaternion (w, x, y, z) body to inertial.";
  static constexpr auto fields() {
    using D = BodyDescription;
    return std::tuple(
        required("mass", &D::mass, "kg", "").positive(),
        required("inertia", &D::inertia, "kg m2", "about the centre of mass, body axes"),
        optional("center_of_mass", &D::center_of_mass, "m", "body axes").usually(0.0, 500.0),
        optional("position", &D::position, "m", "of the body origin, inertial frame").usually(0.0, 2e4),
        optional("quaternion", &D::quaternion, "", "w, x, y, z: body to inertial"),
        optional("velocity", &D::velocity, "m/s", "of the body origin, inertial frame").usually(0.0, 100.0),
        optional("angular_velocity", &D::angular_velocity, "rad/s", "inertial frame").usually(0.0, 100.0),
        optional("gravity", &D::gravity, "", "whether weight acts on it"),
        optional("size", &D::size, "m", "edges of the box that it is, about its centre of mass, body axes")
            .usually(1e-3, 500.0));
  }
};

}  // namespace seacrane
