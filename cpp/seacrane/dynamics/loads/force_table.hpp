#pragma once

#include <algorithm>
#include <vector>

#include "seacrane/dynamics/loads/load.hpp"

namespace seacrane {

/// A wrench tabulated over time (linear between the times, held outside) at a body-fixed point.
struct ForceTable {
  int body = 0;
  Vec3d point;
  std::vector<double> times;
  std::vector<Vec6d> wrenches;  // inertial axes

  Vec6d at(double t) const {
    if (t <= times.front()) return wrenches.front();
    if (t >= times.back()) return wrenches.back();
    const auto next = std::upper_bound(times.begin(), times.end(), t);
    const auto i = static_cast<std::size_t>(next - times.begin()) - 1;
    const double s = (t - times[i]) / (times[i + 1] - times[i]);
    return (1.0 - s) * wrenches[i] + s * wrenches[i + 1];
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const auto& k = in.bodies[body];
    const Vec6<T> w = at(in.time).template cast<T>();
    const Vec3<T> lever = k.rotation * point.cast<T>(), force = w.template head<3>(),
                  moment = w.template tail<3>();
    out.wrench[body].add(force, lever);
    out.wrench[body].moment += moment;
    out.add_power(force.dot(k.velocity + cross<T>(k.angular_velocity, lever)) +
                  moment.dot(k.angular_velocity));
  }
};

}  // namespace seacrane
