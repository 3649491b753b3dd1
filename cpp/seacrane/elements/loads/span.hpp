#pragma once

#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct SpanDescription {
  std::string name, first, second;
  Vec3d first_point = Vec3d::Zero(), second_point = Vec3d::Zero();

  static constexpr auto fields() {
    using D = SpanDescription;
    return std::tuple(on_body("first", &D::first), on_body("second", &D::second),
                      optional("first_point", &D::first_point, "m", "coordinates of the first body"),
                      optional("second_point", &D::second_point, "m", "coordinates of the second body"));
  }

  void check(const Check& c, const SceneNames& names, bool second_may_be_ground = true) const {
    names.body(c, first, true);
    names.body(c, second, second_may_be_ground);
    if (first == second) c.fail("joins '" + first + "' to itself; name two different bodies");
  }
};

/// The start of an example.
template <class Description>
Description example_span(const Vec3d& second_point = Vec3d::Zero()) {
  Description d;
  static_cast<SpanDescription&>(d) = {"load", "first", "second", {2.0, 0.5, -1.0}, second_point};
  return d;
}

/// Two points of two bodies at an instant, inertial axes.
template <class T>
struct SpanPlace {
  Vec3<T> lever_first, lever_second;
  Vec3<T> apart;  // from the first point to the second
  T square;       // of their distance

  /// Coincident points have none.
  auto has_direction() const { return square > T(0); }
};
template <class T>
struct SpanMotion : SpanPlace<T> {
  Vec3<T> along;
  T length, rate;
};

/// Two points of two bodies, between which a load acts.
struct Span {
  int first = 0, second = 0;
  Vec3d first_point, second_point;  // from the state points, body axes

  template <class Context>
  static Span compile(const SpanDescription& d, Context& context) {
    const Attachment a = context.attach(d.first, d.first_point), b = context.attach(d.second, d.second_point);
    return {a.body, b.body, a.point, b.point};
  }

  std::array<int, 2> bodies() const { return {first, second}; }

  template <class T>
  SpanPlace<T> place(const LoadInput<T>& in) const {
    const auto &ka = in.bodies[first], &kb = in.bodies[second];
    SpanPlace<T> out;
    out.lever_first = ka.rotation * first_point.cast<T>();
    out.lever_second = kb.rotation * second_point.cast<T>();
    out.apart = kb.position + out.lever_second - ka.position - out.lever_first;
    out.square = out.apart.dot(out.apart);
    return out;
  }
  double length(const LoadInput<double>& in) const { return std::sqrt(place(in).square); }

  template <class T>
  SpanMotion<T> motion(const LoadInput<T>& in) const {
    using std::sqrt;
    const auto &ka = in.bodies[first], &kb = in.bodies[second];
    SpanMotion<T> out{place(in), {}, T(0), T(0)};
    const auto apart = out.has_direction();
    const T length = sqrt(select(apart, out.square, T(1)));
    out.along = out.apart / length;
    out.length = select(apart, length, T(0));
    const Vec3<T> rate = kb.velocity + cross<T>(kb.angular_velocity, out.lever_second) - ka.velocity -
                         cross<T>(ka.angular_velocity, out.lever_first);
    out.rate = out.along.dot(rate);
    return out;
  }

  /// Pulls the points together; negative: pushes them apart.
  template <class T>
  void pull(const SpanMotion<T>& at, const T& tension, LoadSum<T>& out) const {
    const Vec3<T> force = at.along * select(at.has_direction(), tension, T(0)), back = -force;
    out.wrench[first].add(force, at.lever_first);
    out.wrench[second].add(back, at.lever_second);
  }
  void pull(const SpanMotion<double>& at, double tension, Vec6d* wrenches) const {
    const Vec3d force = tension * at.along;
    wrenches[first] += (Vec6d() << force, at.lever_first.cross(force)).finished();
    wrenches[second] -= (Vec6d() << force, at.lever_second.cross(force)).finished();
  }
};

}  // namespace seacrane
