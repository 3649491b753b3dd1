#pragma once

#include <array>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

struct BoucWenDescription {
  std::string name, first, second;
  double stiffness = 0.0, elastic_share = 0.0, natural_length = 0.0, yield = 0.0;

  static constexpr const char* type = "BoucWen";
  static constexpr const char* text =
      "A spring with hysteresis between the origins of two bodies: beyond its "
      "yield, only the elastic share "
      "of its stiffness is left.";
  static constexpr auto fields() {
    using D = BoucWenDescription;
    return std::tuple(on_body("first", &D::first), on_body("second", &D::second),
                      required("stiffness", &D::stiffness, "N/m", "at small motion"),
                      required("elastic_share", &D::elastic_share, "", "of the stiffness"),
                      required("natural_length", &D::natural_length, "m", ""),
                      required("yield", &D::yield, "m", "elongation at which it yields"));
  }
};

/// With the elongation x of rate v and a state z: T = stiffness (share x + (1 -
/// share) z) and z' = v - (|v| z + v |z|) / (2 yield). The spring stores both
/// parts; the rest of v dissipates.
struct BoucWen {
  static constexpr const char* kind = "bouc-wen";
  using Description = BoucWenDescription;

  std::array<int, 2> on = {};
  std::array<Vec3d, 2> points;  // from the state points, body axes
  double elastic = 0.0, hysteretic = 0.0, natural_length = 0.0, yield = 0.0;
  StateRange states;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.first, true);
    names.body(c, d.second, true);
    c.not_negative("stiffness", d.stiffness);
    c.not_negative("natural_length", d.natural_length);
    if (!(d.elastic_share >= 0.0 && d.elastic_share <= 1.0)) {
      c.fail("elastic_share is " + to_text(d.elastic_share) + "; it must be from 0 to 1");
    }
    if (!(d.yield > 0.0)) c.fail("yield is " + to_text(d.yield) + " m; it must be positive");
  }

  static Description example() { return {"load", "first", "third", 30.0, 0.3, 2.0, 0.5}; }

  template <class Context>
  static BoucWen compile(const Description& d, Context& context) {
    const Attachment a = context.attach(d.first, Vec3d::Zero()), b = context.attach(d.second, Vec3d::Zero());
    const LoadState z{d.name + ".hysteresis", "m", 0.0, d.yield};
    const double elastic = d.elastic_share * d.stiffness;
    return {{a.body, b.body}, {a.point, b.point},   elastic, d.stiffness - elastic, d.natural_length,
            d.yield,          {context.state(z), 1}};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return on; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    using std::sqrt;
    const auto &first = in.bodies[on[0]], &second = in.bodies[on[1]];
    const Vec3<T> from = first.rotation * points[0].cast<T>(), to = second.rotation * points[1].cast<T>();
    const Vec3<T> d = second.position + to - first.position - from;
    const T length = sqrt(d.dot(d));
    const Vec3<T> n = d / length;
    const T v = n.dot(Vec3<T>(second.velocity + cross<T>(second.angular_velocity, to) - first.velocity -
                              cross<T>(first.angular_velocity, from)));
    const T z = in.states[states.first];
    const T lost = (magnitude(v) * z + v * magnitude(z)) / T(2.0 * yield);
    out.state_rates[states.first] = v - lost;
    const T tension = T(elastic) * (length - T(natural_length)) + T(hysteretic) * z;
    const Vec3<T> pull = n * tension, back = -pull;
    out.wrench[on[0]].add(pull, from);
    out.wrench[on[1]].add(back, to);
    out.add_power(-T(hysteretic) * z * lost);
  }

  double potential(const LoadInput<double>& in) const {
    const auto &first = in.bodies[on[0]], &second = in.bodies[on[1]];
    const Vec3d from = first.position + first.rotation * points[0];
    const double x = (second.position + second.rotation * points[1] - from).norm() - natural_length;
    const double z = in.states[states.first];
    return 0.5 * (elastic * x * x + hysteretic * z * z);
  }

 private:
  template <class T>
  static T magnitude(const T& value) {
    return select(value < T(0), T(-value), value);
  }
};

}  // namespace seacrane
