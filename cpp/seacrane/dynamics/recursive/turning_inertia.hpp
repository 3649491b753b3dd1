#pragma once

#include "seacrane/math/symmetric.hpp"

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

}  // namespace seacrane
