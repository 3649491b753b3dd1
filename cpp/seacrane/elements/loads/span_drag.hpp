#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "seacrane/elements/loads/proportion.hpp"
#include "seacrane/elements/loads/span.hpp"

namespace seacrane {

struct SpanDragDescription : SpanDescription {
  double density = 0.0, diameter = 0.0, length = 0.0, coefficient = 0.0;
  Vec3d flow = Vec3d::Zero();

  static constexpr const char* type = "SpanDrag";
  static constexpr const char* text =
      "Drag across a straight span of wire between two points, in air or water that flows steadily.";
  static constexpr auto fields() {
    using D = SpanDragDescription;
    return std::tuple_cat(
        SpanDescription::fields(),
        std::tuple(
            required("density", &D::density, "kg/m3", "of the fluid").not_negative().usually(0.5, 1500.0),
            required("diameter", &D::diameter, "m", "").not_negative().usually(5e-4, 3.0),
            required("length", &D::length, "m", "of wire in the span").not_negative().usually(0.0, 1e4),
            required("coefficient", &D::coefficient, "", "drag coefficient across the wire")
                .not_negative()
                .usually(0.05, 20.0),
            optional("flow", &D::flow, "m/s", "velocity of the fluid, inertial axes").usually(0.0, 100.0)));
  }
};

/// Drag across a straight span of wire: with n along the span, at either end half of
/// F = -rho / 2 C_D diameter length |v| v, v the velocity of that end in the fluid less its part along n.
struct SpanDrag {
  static constexpr const char* kind = "span drag";
  static constexpr const char* drawn = "";  // what it acts on is
  static constexpr Proportion proportions[] = {{"length", "distance", "{} times the span", 0.05, 20.0}};
  static constexpr bool from_outside = true;
  using Description = SpanDragDescription;

  Description d;
  Span span;
  double half = 0.0;  // N s2/m2, of one end

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names); }

  static Description example() {
    auto d = example_span<Description>({0.2, -0.3, 0.4});
    d.density = d.diameter = d.length = d.coefficient = 1.3;
    d.flow = {1.0, -2.0, 0.5};
    return d;
  }

  template <class Context>
  static SpanDrag compile(const Description& d, Context& context) {
    return {d, Span::compile(d, context), 0.25 * d.density * d.coefficient * d.diameter * d.length};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return span.bodies(); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const SpanPlace<T> at = span.place(in);
    if (!at.has_direction()) return;
    drag_end(in.bodies[span.first], at.lever_first, at, out, out.wrench[span.first]);
    drag_end(in.bodies[span.second], at.lever_second, at, out, out.wrench[span.second]);
  }

 private:
  template <class T>
  void drag_end(const BodyKinematics<T>& k, const Vec3<T>& lever, const SpanPlace<T>& at, LoadSum<T>& out,
                BodyLoad<T>& wrench) const {
    using std::sqrt;
    const Vec3<T> velocity = k.velocity + cross<T>(k.angular_velocity, lever);
    const Vec3<T> relative = velocity - d.flow.cast<T>();
    const Vec3<T> across = relative - at.apart * (at.apart.dot(relative) / at.square);
    const T speed2 = across.dot(across);
    if (!(speed2 > T(0))) return;  // no direction, and no load
    const Vec3<T> drag = across * (T(-half) * sqrt(speed2));
    wrench.add(drag, lever);
    out.add_power(drag.dot(velocity));
  }
};

}  // namespace seacrane
