#pragma once

#include "seacrane/dynamics/inertia.hpp"
#include "seacrane/math/spatial.hpp"

namespace seacrane {

/// Inertia about the centre of mass as it turns with its body. One with an axis of symmetry is
/// across 1 + excess e e^T, and needs that axis e alone.
class TurningInertia {
 public:
  explicit TurningInertia(const Mat3d& inertia);

  /// In inertial axes.
  template <class T>
  Symmetric3<T> at(const Mat3<T>& rotation) const {
    if (!has_axis_) {
      return Symmetric3<T>::turned(times<T>(rotation, inertia_), rotation);
    }
    const Vec3<T> axis = times<T>(rotation, axis_);
    Symmetric3<T> out = Symmetric3<T>::outer(T(excess_) * axis, axis);
    out += Symmetric3<T>::diagonal(T(across_));
    return out;
  }

 private:
  Mat3d inertia_;  // body axes
  bool has_axis_ = false;
  Vec3d axis_ = Vec3d::UnitZ();
  double across_ = 0.0, excess_ = 0.0;
};

/// A body's mass that turns with it; packs may have an inertia for each lane.
template <class T>
struct TurningMass : RigidMass<T> {
  TurningInertia turning;  // of all lanes, where they are alike
  bool alike = true;

  explicit TurningMass(const BodyModel& body)
      : RigidMass<T>{T(body.mass), body.center_of_mass, body.inertia.cast<T>()}, turning(body.inertia) {}

  /// About the centre of mass, inertial axes.
  CompactInertia<T> at(const Mat3<T>& rotation) const {
    if (alike) return {this->mass, turning.template at<T>(rotation)};
    Mat3<T> turned;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        turned(i, j) = rotation(i, 0) * this->inertia(0, j) + rotation(i, 1) * this->inertia(1, j) +
                       rotation(i, 2) * this->inertia(2, j);
      }
    }
    return {this->mass, Symmetric3<T>::turned(turned, rotation)};
  }
};

}  // namespace seacrane
