#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct PendulumDampingDescription {
  std::string name, first, second;
  Vec3d first_point = Vec3d::Zero(), second_point = Vec3d::Zero();
  double ratio = 0.0, mass = 0.0;

  static constexpr const char* type = "PendulumDamping";
  static constexpr const char* text =
      "Damping of a load that swings below a point, as a ratio of critical; see "
      "Scene.add_pendulum_damping.";
  static constexpr auto fields() {
    using D = PendulumDampingDescription;
    return std::tuple(
        on_body("first", &D::first), on_body("second", &D::second),
        optional("first_point", &D::first_point, "m", "on the first body: where the wire hangs"),
        optional("second_point", &D::second_point, "m", "on the second body: what swings"),
        required("ratio", &D::ratio, "", "of critical damping of the swing")
            .within(0.0, 10.0)
            .usually(5e-5, 2.0),
        optional("mass", &D::mass, "kg", "that swings; 0: that of the second body").not_negative());
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
  using Description = PendulumDampingDescription;

  int first = 0, second = 0;
  Vec3d first_point, second_point;  // from the state points, body axes
  double factor = 0.0;              // c sqrt(L)

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.first, true);
    names.body(c, d.second);
    if (d.first == d.second) c.fail("joins '" + d.first + "' to itself; name two different bodies");
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.first = "first";
    d.second = "second";
    d.first_point = {2.0, 0.5, -1.0};
    d.second_point = {0.2, -0.3, 0.4};
    d.ratio = 0.3;
    return d;
  }

  template <class Context>
  static PendulumDamping compile(const Description& d, Context& context) {
    const Attachment a = context.attach(d.first, d.first_point);
    const Attachment b = context.attach(d.second, d.second_point);
    const double swung = d.mass > 0.0 ? d.mass : context.mass(d.second);
    return {a.body, b.body, a.point, b.point, 2.0 * d.ratio * swung * std::sqrt(context.gravity())};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return {first, second}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    using std::sqrt;
    const auto &ka = in.bodies[first], &kb = in.bodies[second];
    const Vec3<T> lever_b = kb.rotation * second_point.cast<T>();
    const Vec3<T> from_a = kb.position + lever_b - ka.position;  // to the second point
    const Vec3<T> d = from_a - ka.rotation * first_point.cast<T>();
    const T square = d.dot(d), none = T(0);
    const Vec3<T> d_rate = kb.velocity + cross<T>(kb.angular_velocity, lever_b) - ka.velocity -
                           cross<T>(ka.angular_velocity, from_a);
    const auto apart = square > none;  // coincident points have no direction
    const T divisor = select(apart, square, T(1));
    const Vec3<T> across = d_rate - d * (d.dot(d_rate) / divisor);
    const Vec3<T> drag = across * select(apart, T(T(-factor) / sqrt(sqrt(divisor))), none);
    out.wrench[second].add(drag, lever_b);
    const Vec3<T> back = -drag;
    out.wrench[first].add(back, from_a);
    out.add_power(drag.dot(across));
  }
};

}  // namespace seacrane
