#pragma once

#include "seacrane/dynamics/loads/load.hpp"

namespace seacrane {

/// A force at a body-fixed point, constant in inertial or in body axes; three slots add to it.
struct PointForce {
  int body = 0;
  Vec3d point;  // from the state point, body axes
  Vec3d force;
  bool body_axes = false;
  int slot = 0;

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const auto& k = in.bodies[body];
    const Vec3d total = force + view<3>(in.slots + slot);
    Vec3<T> f = total.cast<T>();
    if (body_axes) f = k.rotation * f;
    const Vec3<T> lever = k.rotation * point.cast<T>();
    out.wrench[body].add(f, lever);
    out.add_power(f.dot(k.velocity + cross<T>(k.angular_velocity, lever)));
  }
};

}  // namespace seacrane
