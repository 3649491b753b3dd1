#pragma once

#include <array>

#include "seacrane/math/dual.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

/// The undisturbed sea at one point, inertial axes; zeros are still water. T is double, or a Dual, whose
/// slopes are over what the point depends on.
///
/// Above the water's level velocity, acceleration and pressure are those at the level, not zero: what is in
/// air leaves by its wetted area, so that nothing jumps.
template <class T>
struct LocalFlow {
  T elevation = T(0);                      // m, of the surface above or below the point
  T elevation_rate = T(0);                 // m/s, at fixed x and y; an element that turns feels it turn
  std::array<T, 2> slope{};                // of the surface over x and y
  Vec3<T> velocity = Vec3<T>::Zero();      // m/s, of the water, the current included
  Vec3<T> acceleration = Vec3<T>::Zero();  // m/s2, of the water: u_t + (U . grad) u, first order in the waves
  T pressure = T(0);                       // m2/s2, dynamic, over density; without the hydrostatic -g z

  /// f(there, here) for every number of two flows.
  template <class S, class F>
  static void each(const LocalFlow<S>& from, LocalFlow& to, F&& f) {
    f(from.elevation, to.elevation);
    f(from.elevation_rate, to.elevation_rate);
    for (std::size_t i = 0; i < 2; ++i) f(from.slope[i], to.slope[i]);
    for (int i = 0; i < 3; ++i) f(from.velocity[i], to.velocity[i]);
    for (int i = 0; i < 3; ++i) f(from.acceleration[i], to.acceleration[i]);
    f(from.pressure, to.pressure);
  }
};

/// A flow with slopes over x, y and z, where the point itself has slopes.
template <int N>
LocalFlow<Dual<N>> along(const LocalFlow<Dual<3>>& flow, const Vec3<Dual<N>>& point) {
  LocalFlow<Dual<N>> out;
  LocalFlow<Dual<N>>::each(flow, out, [&](const Dual<3>& from, Dual<N>& to) {
    to = Dual<N>(from.value);
    for (std::size_t n = 0; n < N; ++n) {
      for (int i = 0; i < 3; ++i) to.slope[n] += from.slope[idx(i)] * point[i].slope[n];
    }
  });
  return out;
}

}  // namespace seacrane
