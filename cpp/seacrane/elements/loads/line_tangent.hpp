#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "seacrane/math/dual.hpp"
#include "seacrane/math/spatial.hpp"
#include "seacrane/math/with_rate.hpp"

namespace seacrane {

/// One end of a straight part of a line, inertial axes: a point, or the centre of a sheave about whose axis
/// (of length one) the line runs by the right hand.
template <class T>
struct TangentEnd {
  double radius = 0.0;  // 0: a point
  Vec3<T> center, axis;
};

/// The straight part between two ends. A sheave's groove holds the line in the plane of its rim, and the
/// straight part is perpendicular to the radii n at its ends, n1 . d = n2 . d = 0 with d from end to end: of
/// all paths in the grooves and outside the rims the shortest. Where the line leaves a plane at an angle, the
/// sum of straight part and arcs is not stationary in the angles of n1 and n2, and multipliers of the two
/// conditions complete its gradient: `pull` by the place of the second end, less that by the first, and
/// `turning` by rotations of the bodies about these ends.
template <class T>
struct Tangent {
  Vec3<T> from, to, along;  // ends, and the unit vector from the first to the second
  Vec3<T> out, in;          // n1 and n2; zero at a point
  Vec3<T> pull;
  Vec3<T> turning_from, turning_to;
  T length;
};

namespace line_tangent {

inline constexpr int kSteps = 8;  // of Newton's method, from a start that is exact in one plane

/// The radius n in the plane of a rim with n . apart = reach, from which the line runs along `apart`.
inline Vec3d radius_at(const Vec3d& axis, const Vec3d& apart, double reach) {
  const Vec3d flat = apart - axis * axis.dot(apart);
  const double square = flat.squaredNorm();
  const double beside = std::sqrt(std::max(square - reach * reach, 0.0));
  return (reach * flat + beside * flat.cross(axis)) / square;
}

template <class T>
Vec3d plain(const Vec3<T>& v) {
  return {value_of(v[0]), value_of(v[1]), value_of(v[2])};
}

template <class T>
TangentEnd<double> plain(const TangentEnd<T>& end) {
  return {end.radius, plain<T>(end.center), plain<T>(end.axis)};
}

/// What n1 . d and n2 . d are, and how they change with the angles of n1 and n2.
template <class T>
struct Conditions {
  Vec3<T> first_along, second_along, apart;  // axis x n of each; d
  T first, second, a11, a12, a21, a22, determinant;

  Conditions(const TangentEnd<T>& a, const TangentEnd<T>& b, const Vec3<T>& n1, const Vec3<T>& n2)
      : first_along(cross<T>(a.axis, n1)),
        second_along(cross<T>(b.axis, n2)),
        apart(b.center + n2 * T(b.radius) - a.center - n1 * T(a.radius)),
        first(n1.dot(apart)),
        second(n2.dot(apart)),
        a11(a.radius > 0.0 ? T(first_along.dot(apart)) : T(1)),
        a12(T(b.radius) * n1.dot(second_along)),
        a21(T(-a.radius) * n2.dot(first_along)),
        a22(b.radius > 0.0 ? T(second_along.dot(apart)) : T(1)),
        determinant(a11 * a22 - a12 * a21) {}
};

template <class T>
Vec3<T> turned(const Vec3<T>& n, const Vec3<T>& along, const T& angle) {
  using std::sqrt;
  return (n + along * angle) / T(sqrt(T(1) + angle * angle));
}

/// A step of Newton's method.
template <class T>
void improve(const TangentEnd<T>& a, const TangentEnd<T>& b, Vec3<T>& n1, Vec3<T>& n2) {
  const Conditions<T> c(a, b, n1, n2);
  const T first = -(c.first * c.a22 - c.a12 * c.second) / c.determinant;
  const T second = -(c.a11 * c.second - c.a21 * c.first) / c.determinant;
  n1 = turned<T>(n1, c.first_along, first);
  n2 = turned<T>(n2, c.second_along, second);
}

/// n1 and n2 as numbers.
inline std::pair<Vec3d, Vec3d> radii(const TangentEnd<double>& a, const TangentEnd<double>& b) {
  const Vec3d apart = b.center - a.center;
  const double alike = a.axis.dot(b.axis);
  Vec3d n1 = Vec3d::Zero(), n2 = Vec3d::Zero();
  if (a.radius > 0.0) n1 = radius_at(a.axis, apart, a.radius - alike * b.radius);
  if (b.radius > 0.0) n2 = radius_at(b.axis, apart, alike * a.radius - b.radius);
  if (a.radius > 0.0 && b.radius > 0.0) {
    for (int i = 0; i < kSteps; ++i) improve<double>(a, b, n1, n2);
  }
  return {n1, n2};
}

/// `n` in the plane that the axis has with its derivatives.
template <class T>
Vec3<T> into_plane(const Vec3d& n, const Vec3<T>& axis) {
  using std::sqrt;
  const Vec3<T> given = n.template cast<T>();
  const Vec3<T> flat = given - axis * axis.dot(given);
  return flat / T(sqrt(flat.dot(flat)));
}

/// By how much the nearer of two ends is outside the rim of the other, m; a point has no rim.
inline double clearance(const TangentEnd<double>& a, const TangentEnd<double>& b) {
  const Vec3d apart = b.center - a.center;
  const double alike = a.axis.dot(b.axis);
  const auto outside = [&](const Vec3d& axis, double reach) {
    return (apart - axis * axis.dot(apart)).norm() - std::abs(reach);
  };
  double out = std::numeric_limits<double>::infinity();
  if (a.radius > 0.0) out = std::min(out, outside(a.axis, a.radius - alike * b.radius));
  if (b.radius > 0.0) out = std::min(out, outside(b.axis, b.radius - alike * a.radius));
  return out;
}

}  // namespace line_tangent

/// The tangent of two ends, one of which is a sheave. From radii as numbers each step of Newton's method
/// brings derivatives of one more order.
template <class T>
Tangent<T> tangent(const TangentEnd<T>& a, const TangentEnd<T>& b) {
  using std::sqrt;
  const auto [first, second] = line_tangent::radii(line_tangent::plain(a), line_tangent::plain(b));
  Vec3<T> n1 = Vec3<T>::Zero(), n2 = n1;
  if (a.radius > 0.0) n1 = line_tangent::into_plane<T>(first, a.axis);
  if (b.radius > 0.0) n2 = line_tangent::into_plane<T>(second, b.axis);
  for (int i = 0; i < derivative_order<T>; ++i) line_tangent::improve<T>(a, b, n1, n2);
  const line_tangent::Conditions<T> c(a, b, n1, n2);
  Tangent<T> out;
  out.from = a.center + n1 * T(a.radius);
  out.to = b.center + n2 * T(b.radius);
  out.length = T(sqrt(c.apart.dot(c.apart)));
  out.along = c.apart / out.length;
  out.out = n1;
  out.in = n2;
  const T left_first = T(-a.radius) * (T(1) - out.along.dot(c.first_along));
  const T left_second = T(b.radius) * (T(1) - out.along.dot(c.second_along));
  const T on_first = (left_first * c.a22 - c.a21 * left_second) / c.determinant;
  const T on_second = (c.a11 * left_second - c.a12 * left_first) / c.determinant;
  out.pull = out.along + n1 * on_first + n2 * on_second;
  out.turning_from = cross<T>(n1, c.apart) * on_first;
  out.turning_to = cross<T>(n2, c.apart) * on_second;
  return out;
}

/// The angle from one radius to another about an axis by the right hand, from -90 to 270 degrees.
template <class T>
T angle_about(const Vec3<T>& axis, const Vec3<T>& from, const Vec3<T>& to) {
  using std::atan2;
  constexpr double turn = 6.283185307179586476925;
  const T angle = atan2(axis.dot(cross<T>(from, to)), from.dot(to));
  return angle < T(-0.25 * turn) ? T(angle + T(turn)) : angle;
}

}  // namespace seacrane
