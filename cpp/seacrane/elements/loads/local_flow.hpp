#pragma once

#include "seacrane/math/types.hpp"

namespace seacrane {

/// The undisturbed water at a place, inertial axes: what a part in it sees. Fields are functions of place and
/// time; a sea fills them.
template <class T>
struct LocalFlow {
  T elevation = T(0), elevation_rate = T(0);  // of the surface above or below the place, m and m/s
  Vec3<T> velocity = Vec3<T>::Zero();         // m/s
  Vec3<T> acceleration = Vec3<T>::Zero();     // material, Du/Dt, m/s2
};

/// Still water up to z = 0.
template <class T>
LocalFlow<T> still_water() {
  return {};
}

}  // namespace seacrane
