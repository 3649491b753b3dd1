#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

/// From the state point of a body to its centre of mass, inertial frame.
Vec3d lever_of(const Terms& terms, int body) {
  return terms.bodies()[idx(body)].rotation * terms.model().bodies[idx(body)].center_of_mass;
}

/// Writes `value(body)` of N numbers for every body.
template <int N, class Value>
void write_each(const Output& output, double* out, Value&& value) {
  for (int b = 0; b < output.system.model().body_count(); ++b) view<N>(out + N * b) = value(b);
}

void write_position(const Output& o, double* out) {
  write_each<3>(o, out,
                [&](int b) -> Vec3d { return o.terms.bodies()[idx(b)].position + lever_of(o.terms, b); });
}

void write_velocity(const Output& o, double* out) {
  write_each<3>(o, out, [&](int b) -> Vec3d {
    const BodyKinematics<double>& k = o.terms.bodies()[idx(b)];
    const Vec3d lever = lever_of(o.terms, b), turning = k.angular_velocity.cross(lever);
    return k.velocity + turning;
  });
}

void write_angular_velocity(const Output& o, double* out) {
  write_each<3>(o, out, [&](int b) -> Vec3d { return o.terms.bodies()[idx(b)].angular_velocity; });
}

/// q and -q are the same orientation: the sign is that of the output before.
void write_quaternion(const Output& o, double* out) {
  write_each<4>(o, out, [&](int b) -> Vec4d {
    const Vec4d q = quaternion_from_rotation(o.terms.bodies()[idx(b)].rotation);
    return q.dot(view<4>(out + 4 * b)) < 0.0 ? Vec4d(-q) : q;
  });
}

void write_euler_xyz(const Output& o, double* out) {
  write_each<3>(o, out,
                [&](int b) -> Vec3d { return euler_xyz_from_rotation(o.terms.bodies()[idx(b)].rotation); });
}

void write_acceleration(const Output& o, double* out) {
  write_each<3>(o, out, [&](int b) -> Vec3d {
    const Vec6d& a = o.accelerations[idx(b)];
    const Vec3d &w = o.terms.bodies()[idx(b)].angular_velocity, lever = lever_of(o.terms, b),
                turning = w.cross(lever);
    return a.head<3>() + Vec3d(a.tail<3>()).cross(lever) + w.cross(turning);
  });
}

void write_angular_acceleration(const Output& o, double* out) {
  write_each<3>(o, out, [&](int b) -> Vec3d { return o.accelerations[idx(b)].tail<3>(); });
}

}  // namespace

std::vector<Channel> body_channels() {
  return {
      {.name = "position",
       .axes = {&axes::body, &axes::xyz},
       .unit = "m",
       .text = "centre of mass, inertial frame",
       .peaks = Peaks::of_states,
       .write = write_position},
      {.name = "velocity",
       .axes = {&axes::body, &axes::xyz},
       .unit = "m/s",
       .text = "velocity of the centre of mass, inertial frame",
       .peaks = Peaks::of_states,
       .write = write_velocity},
      {.name = "angular_velocity",
       .axes = {&axes::body, &axes::xyz},
       .unit = "rad/s",
       .text = "angular velocity, inertial frame",
       .peaks = Peaks::of_states,
       .write = write_angular_velocity},
      {.name = "quaternion",
       .axes = {&axes::body, &axes::wxyz},
       .unit = "1",
       .text = "orientation, scalar first, body to inertial",
       .peaks = Peaks::of_poses,
       .write = write_quaternion},
      {.name = "euler_xyz",
       .axes = {&axes::body, &axes::xyz},
       .unit = "rad",
       .text = "XYZ Euler angles, R = Rx Ry Rz, body to inertial",
       .peaks = Peaks::of_states,
       .write = write_euler_xyz},
      {.name = "acceleration",
       .axes = {&axes::body, &axes::xyz},
       .unit = "m/s2",
       .text = "acceleration of the centre of mass, inertial frame",
       .needs = {.accelerations = true},
       .peaks = Peaks::of_accelerations,
       .by_default = false,
       .write = write_acceleration},
      {.name = "angular_acceleration",
       .axes = {&axes::body, &axes::xyz},
       .unit = "rad/s2",
       .text = "angular acceleration, inertial frame",
       .needs = {.accelerations = true},
       .peaks = Peaks::of_accelerations,
       .by_default = false,
       .write = write_angular_acceleration},
  };
}

}  // namespace seacrane
