#include "seacrane/dynamics/merged.hpp"

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

/// The same body seen at another point, `lever` away in inertial axes.
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

BodyKinematics<double> carried(const Model& full, const Model& merged, int body,
                               const BodyKinematics<double>& carrier) {
  BodyKinematics<double> k = at_lever(carrier, carrier.rotation * reach(full, merged, body));
  k.rotation = carrier.rotation * merged.merge.places[idx(body)].axes;
  return k;
}

void copy_rest(const Model& from, const double* x, const Model& to, double* y) {
  std::copy(x + from.layout.memory, x + from.layout.size, y + to.layout.memory);
}

}  // namespace

void merge_state(const Model& full, const Model& merged, const double* bodies, double* y) {
  for (int b = 0; b < merged.body_count(); ++b) {
    const int carrier = merged.merge.carriers[idx(b)];
    const BodyKinematics<double> k = read(full, carrier, bodies);
    write(merged, b, at_lever(k, -(k.rotation * reach(full, merged, carrier))), y);
  }
  copy_rest(full, bodies, merged, y);
}

void spread_state(const Model& full, const Model& merged, const double* y, double* bodies) {
  for (int b = 0; b < full.body_count(); ++b) {
    const int on = merged.merge.places[idx(b)].body;
    const bool fixed = on == merged.body_count();
    const auto carrier = fixed ? BodyKinematics<double>::ground() : read(merged, on, y);
    write(full, b, carried(full, merged, b, carrier), bodies);
  }
  copy_rest(merged, y, full, bodies);
}

MergedSystem::MergedSystem(const std::string& formulation, const Model& full)
    : full_(full),
      merged_(*full.merged),
      terms_(full.merged),
      reduced_(make_formulation(formulation, terms_)),
      stepped_(reduced_ ? reduced_.get() : &terms_),
      bodies_(idx(merged_.layout.size), 0.0),
      acceleration_(idx(full.body_count()) + 1, Vec6d::Zero()) {}

void MergedSystem::read_bodies(double t, const double* bodies, double* y) {
  merge_state(full_, merged_, bodies, bodies_.data());
  stepped_->read_bodies(t, bodies_.data(), y);
}

void MergedSystem::write_bodies(double t, const double* y, double* bodies) {
  stepped_->write_bodies(t, y, bodies_.data());
  spread_state(full_, merged_, bodies_.data(), bodies);
}

const std::vector<Vec6d>& MergedSystem::accelerations() {
  const std::vector<Vec6d>& merged = stepped_->accelerations();
  for (int b = 0; b < full_.body_count(); ++b) {
    const int on = merged_.merge.places[idx(b)].body;
    const BodyKinematics<double>& k = terms_.bodies()[idx(on)];
    const Vec3d lever = k.rotation * reach(full_, merged_, b), w = k.angular_velocity;
    acceleration_[idx(b)] = on < merged_.body_count() ? merged[idx(on)] : Vec6d(Vec6d::Zero());
    const Vec3d turning = acceleration_[idx(b)].tail<3>();
    acceleration_[idx(b)].head<3>() += turning.cross(lever) + w.cross(w.cross(lever));
  }
  return acceleration_;
}

}  // namespace seacrane
