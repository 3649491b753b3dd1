#pragma once

#include <vector>

#include "seacrane/dynamics/loads/load.hpp"
#include "seacrane/math/rotation.hpp"
#include "seacrane/model/description.hpp"

namespace seacrane {

/// A user's C function called in every evaluation, see ForceFunction.
struct FunctionForce {
  int body = 0;
  Vec3d origin;  // body origin from the state point, body axes
  ForceFunction function = nullptr;
  std::vector<double> parameters;

  void apply(const LoadInput<double>& in, LoadSum<double>& out) const {
    const auto& k = in.bodies[body];
    const Vec3d lever = k.rotation * origin;
    const Vec3d velocity = k.velocity + k.angular_velocity.cross(lever);
    double state[13], wrench[6] = {};
    view<3>(state) = k.position + lever;
    view<4>(state + 3) = quaternion_from_rotation(k.rotation);
    view<3>(state + 7) = velocity;
    view<3>(state + 10) = k.angular_velocity;
    function(in.time, state, parameters.data(), wrench);
    const Vec3d force = view<3>(wrench), moment = view<3>(wrench + 3);
    out.wrench[body].add(force, lever);
    out.wrench[body].moment += moment;
    out.add_power(force.dot(velocity) + moment.dot(k.angular_velocity));
  }
};

}  // namespace seacrane
