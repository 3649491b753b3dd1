#pragma once

#include "seacrane/elements/loads/span.hpp"

namespace seacrane {

struct MaxwellDamperDescription : SpanDescription {
  double stiffness = 0.0, damping = 0.0, length = 0.0;

  static constexpr const char* type = "MaxwellDamper";
  static constexpr const char* text =
      "A spring and a dashpot in series between two points: stiff against fast "
      "motion, soft against slow one.";
  static constexpr auto fields() {
    using D = MaxwellDamperDescription;
    return std::tuple_cat(
        SpanDescription::fields(),
        std::tuple(required("stiffness", &D::stiffness, "N/m", "of the spring").not_negative(),
                   required("damping", &D::damping, "N s/m", "of the dashpot").positive(),
                   required("length", &D::length, "m", "between the points at the start, without load")
                       .not_negative()));
  }
};

/// With the distance l of the points and the length x of the dashpot, a state:
/// T = stiffness (l - x), damping x' = T. The spring stores, the dashpot
/// dissipates damping x'^2.
struct MaxwellDamper {
  static constexpr const char* kind = "maxwell damper";
  using Description = MaxwellDamperDescription;

  Description d;
  Span span;
  StateRange states;

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names); }

  static Description example() {
    auto d = example_span<Description>({0.4, 0.0, 1.0});
    d.stiffness = 30.0;
    d.damping = 5.0;
    d.length = 2.0;
    return d;
  }

  template <class Context>
  static MaxwellDamper compile(const Description& d, Context& context) {
    const LoadState dashpot{d.name + ".length", "m", d.length, context.length_scale()};
    return {d, Span::compile(d, context), {context.state(dashpot), 1}};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return span.bodies(); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const SpanMotion<T> m = span.motion(in);
    const T tension = d.stiffness * (m.length - in.states[states.first]), rate = tension / T(d.damping);
    out.state_rates[states.first] = rate;
    span.pull(m, tension, out);
    out.add_power(-tension * rate);
  }

  double potential(const LoadInput<double>& in) const {
    const double stretch = span.length(in) - in.states[states.first];
    return 0.5 * d.stiffness * stretch * stretch;
  }
};

}  // namespace seacrane
