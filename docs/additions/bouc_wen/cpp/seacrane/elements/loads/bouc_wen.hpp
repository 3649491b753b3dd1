#pragma once

#include "seacrane/elements/loads/span.hpp"

namespace seacrane {

struct BoucWenDescription : SpanDescription {
  double stiffness = 0.0, elastic_share = 0.0, natural_length = 0.0, yield = 0.0;

  static constexpr const char* type = "BoucWen";
  static constexpr const char* text =
      "A spring with hysteresis between two points: beyond its yield, only the "
      "elastic share of its stiffness is left.";
  static constexpr auto fields() {
    using D = BoucWenDescription;
    return std::tuple_cat(
        SpanDescription::fields(),
        std::tuple(required("stiffness", &D::stiffness, "N/m", "at small motion").not_negative(),
                   required("elastic_share", &D::elastic_share, "", "of the stiffness").within(0.0, 1.0),
                   required("natural_length", &D::natural_length, "m", "").not_negative(),
                   required("yield", &D::yield, "m", "elongation at which it yields").positive()));
  }
};

/// With the elongation x of rate v and a state z: T = stiffness (share x + (1 -
/// share) z) and z' = v - (|v| z + v |z|) / (2 yield). The spring stores both
/// parts; the rest of v dissipates.
struct BoucWen {
  static constexpr const char* kind = "bouc-wen";
  using Description = BoucWenDescription;

  Description d;
  Span span;
  double elastic = 0.0, hysteretic = 0.0;  // N/m
  StateRange states;

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names); }

  static Description example() {
    auto d = example_span<Description>();
    d.stiffness = 30.0;
    d.elastic_share = 0.3;
    d.natural_length = 2.0;
    d.yield = 0.5;
    return d;
  }

  template <class Context>
  static BoucWen compile(const Description& d, Context& context) {
    const LoadState z{d.name + ".hysteresis", "m", 0.0, d.yield};
    const double elastic = d.elastic_share * d.stiffness;
    return {d, Span::compile(d, context), elastic, d.stiffness - elastic, {context.state(z), 1}};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return span.bodies(); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const SpanMotion<T> m = span.motion(in);
    const T z = in.states[states.first], v = m.rate;
    const T lost = (magnitude(v) * z + v * magnitude(z)) / T(2.0 * d.yield);
    out.state_rates[states.first] = v - lost;
    span.pull(m, T(T(elastic) * (m.length - T(d.natural_length)) + T(hysteretic) * z), out);
    out.add_power(-T(hysteretic) * z * lost);
  }

  double potential(const LoadInput<double>& in) const {
    const double x = span.length(in) - d.natural_length, z = in.states[states.first];
    return 0.5 * (elastic * x * x + hysteretic * z * z);
  }

 private:
  template <class T>
  static T magnitude(const T& value) {
    return select(value < T(0), T(-value), value);
  }
};

}  // namespace seacrane
