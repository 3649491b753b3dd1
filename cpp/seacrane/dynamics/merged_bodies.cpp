#include "seacrane/dynamics/merged_bodies.hpp"

#include <algorithm>

#include "seacrane/math/rotation.hpp"

namespace seacrane {
namespace {

BodyKinematics<double> read(const Model& m, int body, const double* y) {
  const double* pose = y + m.layout.pose(body);
  const double* twist = y + m.layout.twist(body);
  return {view<3>(pose),
          m.layout.pose_size == 7 ? rotation_from_quaternion<double>(view<4>(pose + 3))
                                  : rotation_from_euler_xyz<double>(view<3>(pose + 3)),
          view<3>(twist), view<3>(twist + 3)};
}

void write(const Model& m, int body, const BodyKinematics<double>& k, double* y) {
  double* pose = y + m.layout.pose(body);
  view<3>(pose) = k.position;
  if (m.layout.pose_size == 7) {
    view<4>(pose + 3) = quaternion_from_rotation(k.rotation);
  } else {
    view<3>(pose + 3) = euler_xyz_from_rotation(k.rotation);
  }
  view<6>(y + m.layout.twist(body)) << k.velocity, k.angular_velocity;
}

/// The motion of a body seen at another point, `lever` away in inertial axes.
BodyKinematics<double> at_lever(BodyKinematics<double> k, const Vec3d& lever) {
  k.position += lever;
  k.velocity += k.angular_velocity.cross(lever);
  return k;
}

/// State point of a described body from that of its carrier, in the carrier's axes.
Vec3d reach(const Model& full, const Model& merged, int body) {
  const Placement& p = merged.merge.places[idx(body)];
  const Vec3d point = p.point(full.bodies[idx(body)].state_point);
  return p.body < merged.body_count() ? Vec3d(point - merged.bodies[idx(p.body)].state_point) : point;
}

BodyKinematics<double> carried(const Placement& place, const Vec3d& reach,
                               const BodyKinematics<double>& carrier) {
  BodyKinematics<double> k = at_lever(carrier, carrier.rotation * reach);
  k.rotation = carrier.rotation * place.axes;
  return k;
}

void copy_rest(const Model& from, const double* x, const Model& to, double* y) {
  std::copy(x + from.layout.memory, x + from.layout.size, y + to.layout.memory);
}

}  // namespace

MergedBodies::MergedBodies(const Model& full, const Model& merged) : full_(full), merged_(merged) {
  for (int b = 0; b < full.body_count(); ++b) reach_.push_back(reach(full, merged, b));
}

void MergedBodies::merge(const double* bodies, double* y) const {
  for (int b = 0; b < merged_.body_count(); ++b) {
    const int carrier = merged_.merge.carriers[idx(b)];
    const BodyKinematics<double> k = read(full_, carrier, bodies);
    write(merged_, b, at_lever(k, -(k.rotation * reach_[idx(carrier)])), y);
  }
  copy_rest(full_, bodies, merged_, y);
}

void MergedBodies::spread(const double* y, double* bodies) const {
  for (int b = 0; b < full_.body_count(); ++b) {
    const int on = merged_.merge.places[idx(b)].body;
    const bool fixed = on == merged_.body_count();
    const auto carrier = fixed ? BodyKinematics<double>::ground() : read(merged_, on, y);
    write(full_, b, carried(merged_.merge.places[idx(b)], reach_[idx(b)], carrier), bodies);
  }
  copy_rest(merged_, y, full_, bodies);
}

void MergedBodies::spread_kinematics(const BodyKinematics<double>* merged,
                                     BodyKinematics<double>* described) const {
  for (int b = 0; b < full_.body_count(); ++b) {
    const Placement& place = merged_.merge.places[idx(b)];
    described[b] = carried(place, reach_[idx(b)], merged[place.body]);
  }
}

void MergedBodies::spread_accelerations(const Terms& terms, const std::vector<Vec6d>& merged,
                                        std::vector<Vec6d>& described) const {
  for (int b = 0; b < full_.body_count(); ++b) {
    const int on = merged_.merge.places[idx(b)].body;
    const BodyKinematics<double>& k = terms.bodies()[idx(on)];
    const Vec3d lever = k.rotation * reach_[idx(b)], w = k.angular_velocity;
    Vec6d& a = described[idx(b)];
    a = on < merged_.body_count() ? merged[idx(on)] : Vec6d(Vec6d::Zero());
    const Vec3d turning = a.tail<3>();
    a.head<3>() += turning.cross(lever) + w.cross(w.cross(lever));
  }
}

}  // namespace seacrane
