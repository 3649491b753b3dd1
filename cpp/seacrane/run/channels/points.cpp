#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

/// Writes `value(kinematics of its body, lever from its state point, body)` for every named point.
template <class Value>
void write_points(const Output& output, double* out, Value&& value) {
  for (const Attachment& at : output.system.model().points) {
    const BodyKinematics<double>& k = output.terms.bodies()[idx(at.body)];
    const Vec3d lever = k.rotation * at.point;
    view<3>(out) = value(k, lever, at.body);
    out += 3;
  }
}

void write_point_position(const Output& o, double* out) {
  write_points(o, out, [](const auto& k, const Vec3d& lever, int) -> Vec3d { return k.position + lever; });
}

void write_point_velocity(const Output& o, double* out) {
  write_points(o, out, [](const auto& k, const Vec3d& lever, int) -> Vec3d {
    return k.velocity + k.angular_velocity.cross(lever);
  });
}

void write_point_acceleration(const Output& o, double* out) {
  write_points(o, out, [&](const auto& k, const Vec3d& lever, int body) -> Vec3d {
    const Vec6d& a = o.accelerations[idx(body)];
    const Vec3d turning = k.angular_velocity.cross(lever);
    return a.head<3>() + Vec3d(a.tail<3>()).cross(lever) + k.angular_velocity.cross(turning);
  });
}

}  // namespace

std::vector<Channel> point_channels() {
  return {
      {.name = "point_position",
       .axes = {&axes::point, &axes::xyz},
       .unit = "m",
       .text = "named point, inertial frame",
       .peaks = Peaks::of_states,
       .write = write_point_position},
      {.name = "point_velocity",
       .axes = {&axes::point, &axes::xyz},
       .unit = "m/s",
       .text = "velocity of the named point, inertial frame",
       .peaks = Peaks::of_states,
       .write = write_point_velocity},
      {.name = "point_acceleration",
       .axes = {&axes::point, &axes::xyz},
       .unit = "m/s2",
       .text = "acceleration of the named point, inertial frame",
       .needs = {.accelerations = true},
       .peaks = Peaks::of_accelerations,
       .by_default = false,
       .write = write_point_acceleration},
  };
}

}  // namespace seacrane
