#pragma once

#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

/// Weight of one body at its centre of mass; z is up.
struct Gravity {
  int body = 0;
  double weight = 0.0;   // N
  Vec3d center_of_mass;  // from the state point, body axes

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    apply(in, T(weight), out);
  }
  /// With another weight in its place, such as one for each lane.
  template <class T>
  void apply(const LoadInput<T>& in, const T& of, LoadSum<T>& out) const {
    const Vec3<T> force(T(0), T(0), -of);
    if (center_of_mass.isZero(0.0)) {
      out.wrench[body].force += force;
      return;
    }
    const Vec3<T> lever = in.bodies[body].rotation * center_of_mass.cast<T>();
    out.wrench[body].add(force, lever);
  }

  double potential(const LoadInput<double>& in) const {
    const auto& k = in.bodies[body];
    return weight * (k.position + k.rotation * center_of_mass).z();
  }
};

}  // namespace seacrane
