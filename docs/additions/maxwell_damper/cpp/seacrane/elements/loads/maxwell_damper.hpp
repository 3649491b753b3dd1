#pragma once

#include <array>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

struct MaxwellDamperDescription {
  std::string name, first, second;
  Vec3d first_point = Vec3d::Zero(), second_point = Vec3d::Zero();
  double stiffness = 0.0, damping = 0.0, length = 0.0;

  static constexpr const char* type = "MaxwellDamper";
  static constexpr const char* text =
      "A spring and a dashpot in series between two points: stiff against fast "
      "motion, soft against slow one.";
  static constexpr auto fields() {
    using D = MaxwellDamperDescription;
    return std::tuple(on_body("first", &D::first), on_body("second", &D::second),
                      optional("first_point", &D::first_point, "m", "coordinates of the first body"),
                      optional("second_point", &D::second_point, "m", "coordinates of the second body"),
                      required("stiffness", &D::stiffness, "N/m", "of the spring"),
                      required("damping", &D::damping, "N s/m", "of the dashpot"),
                      required("length", &D::length, "m", "between the points at the start, without load"));
  }
};

/// With the distance l of the points and the length x of the dashpot, a state:
/// T = stiffness (l - x), damping x' = T. The spring stores, the dashpot
/// dissipates damping x'^2.
struct MaxwellDamper {
  static constexpr const char* kind = "maxwell damper";
  using Description = MaxwellDamperDescription;

  std::array<int, 2> on = {};
  std::array<Vec3d, 2> points;  // from the state points, body axes
  double stiffness = 0.0, damping = 0.0;
  StateRange states;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.first, true);
    names.body(c, d.second, true);
    c.near("first_point", d.first_point);
    c.near("second_point", d.second_point);
    c.not_negative("stiffness", d.stiffness);
    c.not_negative("length", d.length);
    c.finite("damping", d.damping);
    if (!(d.damping > 0.0)) c.fail("damping is " + to_text(d.damping) + " N s/m; it must be positive");
  }

  static Description example() {
    return {"load", "first", "second", Vec3d(2.0, 0.5, -1.0), Vec3d(0.4, 0.0, 1.0), 30.0, 5.0, 2.0};
  }

  template <class Context>
  static MaxwellDamper compile(const Description& d, Context& context) {
    const Attachment a = context.attach(d.first, d.first_point), b = context.attach(d.second, d.second_point);
    const LoadState dashpot{d.name + ".length", "m", d.length, context.length_scale()};
    return {{a.body, b.body}, {a.point, b.point}, d.stiffness, d.damping, {context.state(dashpot), 1}};
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
    const T tension = stiffness * (length - in.states[states.first]);
    const T rate = tension / T(damping);
    out.state_rates[states.first] = rate;
    const Vec3<T> pull = d * T(tension / length), back = -pull;
    out.wrench[on[0]].add(pull, from);
    out.wrench[on[1]].add(back, to);
    out.add_power(-tension * rate);
  }

  double potential(const LoadInput<double>& in) const {
    const auto &first = in.bodies[on[0]], &second = in.bodies[on[1]];
    const Vec3d from = first.position + first.rotation * points[0];
    const double length = (second.position + second.rotation * points[1] - from).norm();
    const double stretch = length - in.states[states.first];
    return 0.5 * stiffness * stretch * stretch;
  }
};

}  // namespace seacrane
