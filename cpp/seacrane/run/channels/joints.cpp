#include <algorithm>

#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/elements/loads/actuator.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

void write_coordinate(const Output& o, double* out) {
  for (const CoordinateRow<double>& row : o.coordinates) *out++ = row.value;
}

void write_coordinate_rate(const Output& o, double* out) {
  const auto& bodies = o.terms.bodies();
  for (std::size_t i = 0; i < o.coordinates.size(); ++i) {
    const JointData& joint = o.terms.model().coordinates[i].joint;
    out[i] = coordinate_rate(o.coordinates[i], bodies[idx(joint.first)], bodies[idx(joint.second)]);
  }
}

void write_actuator_force(const Output& o, double* out) {
  const LoadInput<double> input = o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
  for (const Actuator& a : o.system.model().actuators()) *out++ = a.force<double>(input);
}

void write_driver_force(const Output& o, double* out) { std::ranges::copy(o.drivers, out); }

/// Where the reaction of a joint is taken: the second body's point, or the first's where the joint slides.
Vec3d joint_point(const ElementModel& e, const std::vector<BodyKinematics<double>>& bodies) {
  const BodyKinematics<double>& k = bodies[idx(e.slides ? e.first : e.second)];
  return k.position + k.rotation * (e.slides ? e.first_point : e.second_point);
}

struct Reaction {
  Vec3d force, moment;
};

/// On the second body, or on the ground where that is the second.
Reaction reaction_of(const Output& o, std::size_t joint) {
  const Terms& terms = o.terms;
  const ElementModel& element = terms.model().elements[joint];
  const bool second_is_ground = element.second == terms.model().body_count();
  const int side = second_is_ground ? 0 : 1, body = second_is_ground ? element.first : element.second;
  Vec6d load = Vec6d::Zero();
  const RowBlock<double>& block = terms.blocks()[joint];
  for (int r = 0; r < element.rows; ++r) {
    load += block.d[side].row(r).transpose() * o.system.multipliers()[idx(element.row + r)];
  }
  if (second_is_ground) load = -load;
  const Vec3d force = load.head<3>();
  const Vec3d arm = joint_point(element, terms.bodies()) - terms.bodies()[idx(body)].position;
  return {force, Vec3d(load.tail<3>()) - arm.cross(force)};
}

void write_reaction_force(const Output& o, double* out) {
  for (std::size_t j = 0; j < o.system.model().description.joints.size(); ++j) {
    view<3>(out + 3 * j) = reaction_of(o, j).force;
  }
}

void write_reaction_moment(const Output& o, double* out) {
  for (std::size_t j = 0; j < o.system.model().description.joints.size(); ++j) {
    view<3>(out + 3 * j) = reaction_of(o, j).moment;
  }
}

void write_tension(const Output& o, double* out) { std::ranges::copy(o.links, out); }

}  // namespace

std::vector<Channel> joint_channels() {
  return {
      {.name = "coordinate",
       .axes = {&axes::joint_coordinate},
       .unit = "m or rad",
       .text = "joint coordinate, second body to first",
       .needs = {.coordinates = true},
       .peaks = Peaks::of_states,
       .write = write_coordinate},
      {.name = "coordinate_rate",
       .axes = {&axes::joint_coordinate},
       .unit = "m/s or rad/s",
       .text = "rate of the joint coordinate",
       .needs = {.coordinates = true},
       .peaks = Peaks::of_states,
       .write = write_coordinate_rate},
      {.name = "actuator_force",
       .axes = {&axes::actuator},
       .unit = "N or N m",
       .text = "load of the actuator along its coordinate",
       .peaks = Peaks::of_states,
       .write = write_actuator_force},
      {.name = "driver_force",
       .axes = {&axes::driver},
       .unit = "N or N m",
       .text = "load of the driver along its coordinate",
       .needs = {.held = true},
       .peaks = Peaks::of_held,
       .write = write_driver_force},
      {.name = "reaction_force",
       .axes = {&axes::joint, &axes::xyz},
       .unit = "N",
       .text = "constraint force on the second body, inertial frame, at the joint point",
       .needs = {.solution = true, .reactions = true},
       .write = write_reaction_force},
      {.name = "reaction_moment",
       .axes = {&axes::joint, &axes::xyz},
       .unit = "N m",
       .text = "constraint moment on the second body, inertial frame, at the joint point",
       .needs = {.solution = true, .reactions = true},
       .write = write_reaction_moment},
      {.name = "tension",
       .axes = {&axes::link},
       .unit = "N",
       .text = "tension of the constant-distance link",
       .needs = {.held = true},
       .peaks = Peaks::of_held,
       .write = write_tension},
  };
}

}  // namespace seacrane
