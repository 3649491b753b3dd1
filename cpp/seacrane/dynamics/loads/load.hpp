#pragma once

#include <vector>

#include "seacrane/dynamics/kinematics.hpp"

namespace seacrane {

/// What a load may look at. `bodies` holds all bodies and, last, the ground.
template <class T>
struct LoadInput {
  double time;
  double curve_limit;  // curve pieces from here on are not used yet, see Curve::at
  const BodyKinematics<T>* bodies;
  const double* slots;  // zero-order-held inputs
};

/// Where a load of a described body acts on the compiled body that carries it.
struct Attachment {
  int body = 0;
  Vec3d point;                     // from the state point, in axes of the compiled body
  Mat3d axes = Mat3d::Identity();  // of the described body, likewise
};

/// What loads add up: one wrench per body (the ground's is discarded), and the power of all loads that
/// have no potential, for the energy balance.
template <class T>
struct LoadSum {
  Wrench<T>* wrench;
  T power = T(0), absolute_power = T(0);

  void add_power(const T& p) {
    power += p;
    absolute_power += p < T(0) ? -p : p;
  }
};

}  // namespace seacrane
