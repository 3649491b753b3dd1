#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "seacrane/elements/tree_joint.hpp"
#include "seacrane/math/dual.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

/// A telescopic strut between the two bodies of a hinge: lower and upper part on one slide, a universal
/// joint at one end and a spherical joint at the other. The hinge angle gives its motion in closed form (a
/// triangle of the two ends and the hinge), so the loop needs no constraint. End points `lower`, `upper`;
/// the strut's frame is that of its slide. A slender strut has its ends on one line, which swings in a plane
/// across the hinge's axis, and a universal joint fixed along that axis: it turns about the axis alone, and
/// the x axis of its frame lies along the line, its z axis along the hinge's.
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
  bool slender = false;
  Vec3d lower_lever, upper_lever;  // of a slender one, ends to the state points of its parts; strut frame
  bool alike = false;              // both parts of a slender one turn as one
  int element = -1;                // the slide
  bool slides_up = true;           // its first body is the lower one
  std::string name;
};

/// Pose and, per unit of hinge rate, first and second derivatives over the hinge's parent.
template <class T>
struct StrutMotionOf {
  Mat3<T> rotation;                 // strut frame to inertial
  Vec3<T> end, end_rate, end_bend;  // upper end from the parent's state point; derivatives in the hinge angle
  Vec3<T> turn, turn_bend;          // angular velocity per unit rate, and its derivative in the hinge angle
  T stroke, stroke_rate;            // of the slide; derivative in the hinge angle
};
using StrutMotion = StrutMotionOf<double>;

inline constexpr double kLargestCosine = 1.0 - 1e-9;  // of the angle to the axis of its universal joint

/// Rotation from the strut's frame to inertial axes: r, end to end, and m, across it towards the universal
/// axis, become d and w. `r` is in the strut's frame, `u` along d, `a` the joint's fixed axis.
template <class T>
Mat3<T> turned_strut(const Strut& s, const Vec3<T>& r, const Vec3<T>& u, const Vec3<T>& a) {
  using std::sqrt;
  const Vec3<T> strut_axis = s.strut_axis.cast<T>();
  const T tilt = strut_axis.dot(r);
  const Vec3<T> across_r = strut_axis - tilt * r;
  const Vec3<T> m = across_r / across_r.norm();
  const T rho = sqrt(T(1) - tilt * tilt);
  const Vec3<T> across_u = a - a.dot(u) * u;
  const T lean = across_u.norm();
  const T leaning = -tilt * a.dot(u) / (rho * lean);
  const T cosine =
      valid_where(leaning * leaning < T(kLargestCosine * kLargestCosine), leaning, [&](const auto&) {
        throw std::domain_error(
            "cylinder '" + s.name +
            "': it has turned into the axis of its universal joint, where its own turn is "
            "not determined");
      });
  const Vec3<T> n1 = across_u / lean;
  const Vec3<T> w = cosine * n1 + T(s.side) * sqrt(T(1) - cosine * cosine) * cross<T>(u, n1);
  Mat3<T> from, to;
  from << r, m, cross<T>(r, m);
  to << u, w, cross<T>(u, w);
  return to * from.transpose();
}

/// `hinge_lever`: parent's state point to the hinge; `axis`: of the hinge; `arm`: hinge to upper end; all
/// inertial axes.
template <class T>
StrutMotionOf<T> move_strut(const Strut& s, const Mat3<T>& base, const Mat3<T>& arm_rotation,
                            const Vec3<T>& hinge_lever, const Vec3<T>& axis, const Vec3<T>& arm) {
  using std::sqrt;
  StrutMotionOf<T> out;
  const Vec3<T> lower = base * s.base_point.cast<T>();
  out.end = hinge_lever + arm;
  out.end_rate = cross<T>(axis, arm);
  out.end_bend = cross<T>(axis, out.end_rate);
  const Vec3<T> d = out.end - lower;
  const T distance2 = d.squaredNorm(), across = s.offset.head<2>().squaredNorm();
  const T squared = valid_where(distance2 > across, distance2, [&](const auto& value) {
    throw std::domain_error("cylinder '" + s.name + "': its ends are " +
                            std::to_string(std::sqrt(value_of(value))) +
                            " m apart, nearer than the parts allow");
  });
  const T length = sqrt(squared), along = T(s.extension_sign) * sqrt(squared - across);

  const Vec3<T> r = Vec3<T>(T(s.offset[0]), T(s.offset[1]), along) / length;
  const Vec3<T> u = d / length;
  const Vec3<T> a = s.universal_at_base ? Vec3<T>(base * s.fixed_axis.cast<T>())
                                        : Vec3<T>(arm_rotation * s.fixed_axis.cast<T>());
  out.rotation = turned_strut(s, r, u, a);

  // turn x d + z stroke' = end', turn . (b x a) + b . a' = 0, and once more differentiated.
  const Vec3<T> z = out.rotation.col(2), b = out.rotation * s.strut_axis.cast<T>();
  const Vec3<T> a_rate = s.universal_at_base ? Vec3<T>::Zero() : Vec3<T>(cross<T>(axis, a));
  const Vec3<T> c = cross<T>(b, a);
  const T gauge = u.dot(c), projected = z.dot(d);
  const auto turn_of = [&](const Vec3<T>& side_rate, const T& remainder) {
    const Vec3<T> across_part = cross<T>(d, side_rate) / squared;
    return Vec3<T>(across_part - (remainder + across_part.dot(c)) / gauge * u);
  };
  const T stroke = out.end_rate.dot(d) / projected;
  out.stroke = along - T(s.offset[2]);
  out.stroke_rate = stroke;
  out.turn = turn_of(out.end_rate - stroke * z, b.dot(a_rate));
  const Vec3<T> z_rate = cross<T>(out.turn, z), b_rate = cross<T>(out.turn, b);
  const Vec3<T> force = out.end_bend - cross<T>(out.turn, out.end_rate) - stroke * z_rate;
  const T bend = force.dot(d) / projected;
  const Vec3<T> c_rate = cross<T>(b_rate, a) + cross<T>(b, a_rate);
  const Vec3<T> a_bend = s.universal_at_base ? Vec3<T>::Zero() : Vec3<T>(cross<T>(axis, a_rate));
  out.turn_bend = turn_of(force - bend * z, out.turn.dot(c_rate) + b_rate.dot(a_rate) + b.dot(a_bend));
  return out;
}

/// That of a slender strut, which turns about the hinge's axis: its own axes along and across the line, and
/// derivatives of its angle in that of the hinge.
template <class T>
struct SlenderMotionOf {
  Vec3<T> along, across;
  Vec3<T> end, end_rate, end_bend;
  T turn, turn_bend;
  T stroke, stroke_rate;
};

/// `lower` leads from the parent's state point to the lower end.
template <class T>
SlenderMotionOf<T> move_slender_strut(const Strut& s, const Vec3<T>& lower, const Vec3<T>& hinge_lever,
                                      const Vec3<T>& axis, const Vec3<T>& arm) {
  using std::sqrt;
  SlenderMotionOf<T> out;
  out.end = hinge_lever + arm;
  out.end_rate = cross<T>(axis, arm);
  out.end_bend = cross<T>(axis, out.end_rate);
  const Vec3<T> d = out.end - lower;
  const T length = sqrt(dot<T>(d, d)), over_length = T(1) / length;
  out.along = over_length * d;
  out.across = cross<T>(axis, out.along);
  const T stretch = dot<T>(out.along, out.end_rate);
  out.turn = over_length * dot<T>(out.across, out.end_rate);
  out.turn_bend = over_length * (dot<T>(out.across, out.end_bend) - T(2) * out.turn * stretch);
  out.stroke = T(s.extension_sign) * length - T(s.offset[2]);
  out.stroke_rate = T(s.extension_sign) * stretch;
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
