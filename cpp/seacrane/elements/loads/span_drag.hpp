#pragma once

#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "seacrane/elements/loads/span.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

struct SpanDragDescription : SpanDescription {
  double density = 0.0, diameter = 0.0, length = 0.0, coefficient = 0.0;
  Vec3d flow = Vec3d::Zero();
  bool in_sea = false;

  static constexpr const char* type = "SpanDrag";
  static constexpr const char* text =
      "Drag across a straight span of wire between two points: in a fluid that flows steadily, or in the "
      "sea.";
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
            optional("flow", &D::flow, "m/s", "velocity of the fluid, inertial axes").usually(0.0, 100.0),
            optional("in_sea", &D::in_sea, "",
                     "in place of flow: waves and current of the sea, and none above it")));
  }
};

/// Drag across a straight span of wire: with n along the span, at either end half of
/// F = -rho / 2 C_D diameter length |v| v, v the velocity of that end in the fluid less its part along n. In
/// the sea the fluid is the water at that end, as an element as long as half of the span feels it, and the
/// half of the span counts with the share of it that is below the surface.
struct SpanDrag {
  static constexpr const char* kind = "span drag";
  using Description = SpanDragDescription;

  Description d;
  Span span;
  double half = 0.0;  // N s2/m2, of one end
  int stencil = -1;   // in the sea: both ends

  static void check(const Description& d, const Check& c, SceneNames& names) {
    d.check(c, names);
    if (d.in_sea && !d.flow.isZero(0.0)) c.fail("is in the sea and has a flow; give one of them");
  }

  static Description example() {
    auto d = example_span<Description>({0.2, -0.3, 0.4});
    d.density = d.diameter = d.length = d.coefficient = 1.3;
    d.flow = {1.0, -2.0, 0.5};
    return d;
  }

  template <class Context>
  static SpanDrag compile(const Description& d, Context& context) {
    const int stencil = d.in_sea ? context.stencil({"span drag '" + d.name + "'", 2}) : -1;
    return {d, Span::compile(d, context), 0.25 * d.density * d.coefficient * d.diameter * d.length, stencil};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return span.bodies(); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const SpanPlace<T> at = span.place(in);
    if (!at.has_direction()) return;
    const std::array<Fluid<T>, 2> fluid = fluids(in, at);
    drag_end(in.bodies[span.first], at.lever_first, at, fluid[0], out, out.wrench[span.first]);
    drag_end(in.bodies[span.second], at.lever_second, at, fluid[1], out, out.wrench[span.second]);
  }

 private:
  /// At one end: its velocity, and which share of the half of the span is in it.
  template <class T>
  struct Fluid {
    Vec3<T> velocity;
    T share;
  };

  template <class T>
  std::array<Fluid<T>, 2> fluids(const LoadInput<T>& in, const SpanPlace<T>& at) const {
    if (stencil < 0) return {Fluid<T>{d.flow.cast<T>(), T(1)}, Fluid<T>{d.flow.cast<T>(), T(1)}};
    const Vec3<T> ends[2] = {in.bodies[span.first].position + at.lever_first,
                             in.bodies[span.second].position + at.lever_second};
    const Vec3<T> middle = (ends[0] + ends[1]) * T(0.5);
    const Vec3<T> reach = at.apart * T(0.5);
    if constexpr (std::is_same_v<T, double>) {
      Mat3d extents = Mat3d::Zero();
      extents.col(0) = reach;
      const FlowPoint points[2] = {{ends[0], extents}, {ends[1], extents}};
      const auto flow = in.sea->cloud(stencil, in.time, points);
      return {wetted(flow[0], ends[0], middle), wetted(flow[1], ends[1], middle)};
    } else {
      Mat3<T> extents = Mat3<T>::Zero();
      extents.col(0) = reach;
      return {wetted(in.sea->template at<T>(in.time, ends[0], extents), ends[0], middle),
              wetted(in.sea->template at<T>(in.time, ends[1], extents), ends[1], middle)};
    }
  }

  /// The share below the surface of the stretch from an end to the middle, smooth up to its second derivative
  /// where it dips in and out: over the height of the stretch, and no less than the diameter.
  template <class T>
  Fluid<T> wetted(const LocalFlow<T>& flow, const Vec3<T>& end, const Vec3<T>& middle) const {
    using std::sqrt;
    const T height = middle.z() - end.z();
    const T over = sqrt(height * height + T(d.diameter * d.diameter + 1e-12));
    const T depth = flow.elevation - T(0.5) * (end.z() + middle.z());
    const T s = clamped(T(T(0.5) + depth / over), T(0), T(1));
    return {flow.velocity, s * s * s * (T(10) + s * (T(6) * s - T(15)))};
  }

  template <class T>
  void drag_end(const BodyKinematics<T>& k, const Vec3<T>& lever, const SpanPlace<T>& at,
                const Fluid<T>& fluid, LoadSum<T>& out, BodyLoad<T>& wrench) const {
    using std::sqrt;
    const Vec3<T> velocity = k.velocity + cross<T>(k.angular_velocity, lever);
    const Vec3<T> relative = velocity - fluid.velocity;
    const Vec3<T> across = relative - at.apart * (at.apart.dot(relative) / at.square);
    const T speed2 = across.dot(across);
    if (!(speed2 > T(0))) return;  // no direction, and no load
    const Vec3<T> drag = across * (T(-half) * fluid.share * sqrt(speed2));
    wrench.add(drag, lever);
    out.add_power(drag.dot(velocity));
  }
};

}  // namespace seacrane
