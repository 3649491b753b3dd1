#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

struct SpanDragDescription {
  std::string name, first, second;
  Vec3d first_point = Vec3d::Zero(), second_point = Vec3d::Zero();
  double density = 0.0, diameter = 0.0, length = 0.0, coefficient = 0.0;
  Vec3d flow = Vec3d::Zero();

  static constexpr const char* type = "SpanDrag";
  static constexpr const char* text =
      "Drag across a straight span of wire between two points, in air or water that flows steadily.";
  static constexpr auto fields() {
    using D = SpanDragDescription;
    return std::tuple(
        on_body("first", &D::first), on_body("second", &D::second),
        optional("first_point", &D::first_point, "m", "coordinates of the first body"),
        optional("second_point", &D::second_point, "m", "coordinates of the second body"),
        required("density", &D::density, "kg/m3", "of the fluid").not_negative().usually(0.5, 1500.0),
        required("diameter", &D::diameter, "m", "").not_negative().usually(5e-4, 3.0),
        required("length", &D::length, "m", "of wire in the span").not_negative().usually(0.0, 1e4),
        required("coefficient", &D::coefficient, "", "drag coefficient across the wire")
            .not_negative()
            .usually(0.05, 20.0),
        optional("flow", &D::flow, "m/s", "velocity of the fluid, inertial axes").usually(0.0, 100.0));
  }
};

/// Drag across a straight span of wire: with n along the span, at either end half of
/// F = -rho / 2 C_D diameter length |v| v, v the velocity of that end in the fluid less its part along n.
struct SpanDrag {
  static constexpr const char* kind = "span drag";
  using Description = SpanDragDescription;

  int first = 0, second = 0;
  Vec3d first_point, second_point;  // from the state points, body axes
  double half = 0.0;                // N s2/m2, of one end
  Vec3d flow;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.first, true);
    names.body(c, d.second, true);
    if (d.first == d.second) c.fail("joins '" + d.first + "' to itself; name two different bodies");
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.first = "first";
    d.second = "second";
    d.first_point = {2.0, 0.5, -1.0};
    d.second_point = {0.2, -0.3, 0.4};
    d.density = d.diameter = d.length = d.coefficient = 1.3;
    d.flow = {1.0, -2.0, 0.5};
    return d;
  }

  template <class Context>
  static SpanDrag compile(const Description& d, Context& context) {
    const Attachment a = context.attach(d.first, d.first_point);
    const Attachment b = context.attach(d.second, d.second_point);
    return {a.body, b.body, a.point, b.point, 0.25 * d.density * d.coefficient * d.diameter * d.length,
            d.flow};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return {first, second}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const auto &ka = in.bodies[first], &kb = in.bodies[second];
    const Vec3<T> lever_a = ka.rotation * first_point.cast<T>(),
                  lever_b = kb.rotation * second_point.cast<T>();
    const Vec3<T> d = kb.position + lever_b - ka.position - lever_a;
    const T square = d.dot(d);
    if (!(square > T(0))) return;  // coincident points: no direction
    drag_end(ka, lever_a, d, square, out, out.wrench[first]);
    drag_end(kb, lever_b, d, square, out, out.wrench[second]);
  }

 private:
  template <class T>
  void drag_end(const BodyKinematics<T>& k, const Vec3<T>& lever, const Vec3<T>& d, const T& square,
                LoadSum<T>& out, BodyLoad<T>& wrench) const {
    using std::sqrt;
    const Vec3<T> velocity = k.velocity + cross<T>(k.angular_velocity, lever);
    const Vec3<T> relative = velocity - flow.cast<T>();
    const Vec3<T> across = relative - d * (d.dot(relative) / square);
    const T speed2 = across.dot(across);
    if (!(speed2 > T(0))) return;  // no direction, and no load
    const Vec3<T> drag = across * (T(-half) * sqrt(speed2));
    wrench.add(drag, lever);
    out.add_power(drag.dot(velocity));
  }
};

}  // namespace seacrane
