#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "seacrane/dynamics/recursive/tree_joint.hpp"

namespace seacrane {

/// A telescopic strut between the two bodies of a hinge: lower and upper part on one slide, a universal
/// joint at one end and a spherical joint at the other. The hinge angle gives its motion in closed form (a
/// triangle of the two ends and the hinge), so the loop needs no constraint. End points `lower`, `upper`;
/// the strut's frame is that of its slide.
struct Strut {
  int lower = -1, upper = -1;    // bodies; the lower one is held by the hinge's parent
  Vec3d base_point, arm_point;   // ends, on the hinge's parent and child, from their state points
  Vec3d lower_end, upper_end;    // ends, on the strut's parts, from their state points
  Mat3d lower_axes, upper_axes;  // of the slide, in the parts
  Vec3d offset;                  // upper end less lower end at zero stroke, strut frame
  bool universal_at_base = true;
  Vec3d fixed_axis;                         // of the universal joint, in the hinge's parent or child
  Vec3d strut_axis;                         // of the universal joint, in the strut frame
  double extension_sign = 1.0, side = 1.0;  // branches of the triangle
  std::string name;
};

/// Pose and, per unit of hinge rate, first and second derivatives over the hinge's parent.
struct StrutMotion {
  Mat3d rotation;                 // strut frame to inertial
  Vec3d end, end_rate, end_bend;  // upper end from the parent's state point; derivatives in the hinge angle
  Vec3d turn, turn_bend;          // angular velocity per unit rate, and its derivative in the hinge angle
};

/// `hinge_lever`: parent's state point to the hinge; `axis`: of the hinge; `arm`: hinge to upper end; all
/// inertial axes.
inline StrutMotion move_strut(const Strut& s, const Mat3d& base, const Mat3d& arm_rotation,
                              const Vec3d& hinge_lever, const Vec3d& axis, const Vec3d& arm) {
  StrutMotion out;
  const Vec3d lower = base * s.base_point;
  out.end = hinge_lever + arm;
  out.end_rate = axis.cross(arm);
  out.end_bend = axis.cross(out.end_rate);
  const Vec3d d = out.end - lower;
  const double squared = d.squaredNorm(), across = s.offset.head<2>().squaredNorm();
  if (!(squared > across)) {
    throw std::domain_error("cylinder '" + s.name + "': its ends are " + std::to_string(std::sqrt(squared)) +
                            " m apart, nearer than the parts allow");
  }
  const double length = std::sqrt(squared), along = s.extension_sign * std::sqrt(squared - across);

  // Directions r (end to end) and m (across, towards the universal axis) in the strut frame, d and w likewise
  // in inertial axes: the strut frame turns the first pair into the second.
  const Vec3d r = Vec3d(s.offset[0], s.offset[1], along) / length;
  const double tilt = s.strut_axis.dot(r);
  const Vec3d m = (s.strut_axis - tilt * r).normalized();
  const double rho = std::sqrt(1.0 - tilt * tilt);
  const Vec3d u = d / length;
  const Vec3d a = s.universal_at_base ? Vec3d(base * s.fixed_axis) : Vec3d(arm_rotation * s.fixed_axis);
  const Vec3d across_u = a - a.dot(u) * u;
  const double lean = across_u.norm();
  const double cosine = -tilt * a.dot(u) / (rho * lean);
  if (!(std::abs(cosine) < 1.0 - 1e-9)) {
    throw std::domain_error("cylinder '" + s.name +
                            "': it has turned into the axis of its universal joint, where its own turn is "
                            "not determined");
  }
  const Vec3d n1 = across_u / lean;
  const Vec3d w = cosine * n1 + s.side * std::sqrt(1.0 - cosine * cosine) * u.cross(n1);
  Mat3d from, to;
  from << r, m, r.cross(m);
  to << u, w, u.cross(w);
  out.rotation = to * from.transpose();

  // turn x d + z stroke' = end', turn . (b x a) + b . a' = 0, and once more differentiated.
  const Vec3d z = out.rotation.col(2), b = out.rotation * s.strut_axis;
  const Vec3d a_rate = s.universal_at_base ? Vec3d::Zero() : Vec3d(axis.cross(a));
  const Vec3d c = b.cross(a);
  const double gauge = u.dot(c), projected = z.dot(d);
  const auto turn_of = [&](const Vec3d& side_rate, double remainder) {
    const Vec3d across_part = d.cross(side_rate) / squared;
    return Vec3d(across_part - (remainder + across_part.dot(c)) / gauge * u);
  };
  const double stroke = out.end_rate.dot(d) / projected;
  out.turn = turn_of(out.end_rate - stroke * z, b.dot(a_rate));
  const Vec3d z_rate = out.turn.cross(z), b_rate = out.turn.cross(b);
  const Vec3d force = out.end_bend - out.turn.cross(out.end_rate) - stroke * z_rate;
  const double bend = force.dot(d) / projected;
  const Vec3d c_rate = b_rate.cross(a) + b.cross(a_rate);
  const Vec3d a_bend = s.universal_at_base ? Vec3d::Zero() : Vec3d(axis.cross(a_rate));
  out.turn_bend = turn_of(force - bend * z, out.turn.dot(c_rate) + b_rate.dot(a_rate) + b.dot(a_bend));
  return out;
}

/// The branches of the triangle that a pose is on.
inline void choose_branches(Strut& s, const BodyKinematics<double>& base, const BodyKinematics<double>& arm,
                            const BodyKinematics<double>& lower) {
  const Mat3d frame = lower.rotation * s.lower_axes;
  const Vec3d d = arm.position + arm.rotation * s.arm_point - base.position - base.rotation * s.base_point;
  s.extension_sign = d.dot(frame.col(2)) < 0.0 ? -1.0 : 1.0;
  const Vec3d u = d.normalized();
  const Vec3d a = (s.universal_at_base ? base.rotation : arm.rotation) * s.fixed_axis;
  const Vec3d n1 = (a - a.dot(u) * u).normalized();
  s.side = u.cross(n1).dot(frame * s.strut_axis) < 0.0 ? -1.0 : 1.0;
}

}  // namespace seacrane
