#pragma once

#include "seacrane/math/spatial.hpp"

namespace seacrane {

/// Pose and twist of a body at its state point (centre of mass, or the reference point of a vessel),
/// all in the inertial frame.
template <class T>
struct BodyKinematics {
  Vec3<T> position;
  Mat3<T> rotation;
  Vec3<T> velocity;
  Vec3<T> angular_velocity;

  static BodyKinematics ground() {
    return {Vec3<T>::Zero(), Mat3<T>::Identity(), Vec3<T>::Zero(), Vec3<T>::Zero()};
  }
  Twist<T> twist() const { return {velocity, angular_velocity}; }
};

/// Force and moment about the body's state point, inertial axes, as loads add them up.
template <class T>
struct BodyLoad {
  Vec3<T> force = Vec3<T>::Zero();
  Vec3<T> moment = Vec3<T>::Zero();

  void add(const Vec3<T>& f, const Vec3<T>& lever) {
    force += f;
    moment += cross(lever, f);
  }
};

}  // namespace seacrane
