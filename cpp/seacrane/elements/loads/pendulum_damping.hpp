#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "seacrane/elements/loads/proportion.hpp"
#include "seacrane/elements/loads/span.hpp"

namespace seacrane {

struct PendulumDampingDescription : SpanDescription {
  double ratio = 0.0, mass = 0.0;

  static constexpr const char* type = "PendulumDamping";
  static constexpr const char* text =
      "Damping of a load that swings below a point, as a ratio of critical; see "
      "Scene.add_spring.";
  static constexpr auto fields() {
    using D = PendulumDampingDescription;
    return std::tuple_cat(
        SpanDescription::fields(),
        std::tuple(
            required("ratio", &D::ratio, "", "of critical damping of the swing")
                .within(0.0, 10.0)
                .usually(5e-5, 2.0),
            optional("mass", &D::mass, "kg", "that swings; 0: that of the second body").not_negative()));
  }
};

/// Friction where a wire hangs, on the turning of the line from the first point to the second against the
/// first body. With d from the first point to the second, L its length, and v the rate of d seen from the
/// first body, less its part along d,
///
///   F = -c v on the second body,   c = 2 ratio mass sqrt(g / L),
///
/// and the opposite, at the same place, on the first body: no momentum is made. A point mass that swings
/// below a fixed point has that ratio of critical damping, whatever its mass and length are.
struct PendulumDamping {
  static constexpr const char* kind = "pendulum damping";
  static constexpr bool packs = true;
  static constexpr const char* drawn = "";  // what it acts on is
  static constexpr Proportion proportions[] = {
      {"mass", "mass", "{} times the mass that swings", 1.0 / 300.0, 300.0}};
  using Description = PendulumDampingDescription;

  Description d;
  Span span;
  double factor = 0.0;  // c sqrt(L)

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names, false); }

  static Description example() {
    auto d = example_span<Description>({0.2, -0.3, 0.4});
    d.ratio = 0.3;
    return d;
  }

  template <class Context>
  static PendulumDamping compile(const Description& d, Context& context) {
    const double swung = d.mass > 0.0 ? d.mass : context.mass(d.second);
    return {d, Span::compile(d, context), 2.0 * d.ratio * swung * std::sqrt(context.gravity())};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return span.bodies(); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    using std::sqrt;
    const auto &ka = in.bodies[span.first], &kb = in.bodies[span.second];
    const SpanPlace<T> at = span.place(in);
    const Vec3<T> from_first = kb.position + at.lever_second - ka.position;  // to the second point
    const Vec3<T> rate = kb.velocity + cross<T>(kb.angular_velocity, at.lever_second) - ka.velocity -
                         cross<T>(ka.angular_velocity, from_first);
    const auto apart = at.has_direction();
    const T square = select(apart, at.square, T(1));
    const Vec3<T> across = rate - at.apart * (at.apart.dot(rate) / square);
    const Vec3<T> drag = across * select(apart, T(T(-factor) / sqrt(sqrt(square))), T(0));
    out.wrench[span.second].add(drag, at.lever_second);
    const Vec3<T> back = -drag;
    out.wrench[span.first].add(back, from_first);
    out.add_power(drag.dot(across));
  }
};

}  // namespace seacrane
