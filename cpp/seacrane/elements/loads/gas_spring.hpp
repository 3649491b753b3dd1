#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/elements/loads/proportion.hpp"
#include "seacrane/elements/loads/span.hpp"
#include "seacrane/math/dual.hpp"

namespace seacrane {

struct GasSpringDescription : SpanDescription {
  double area = 0.0, pressure = 0.0, volume = 0.0, length = 0.0, exponent = 1.4;
  bool pushes = false;
  double damping = 0.0, quadratic_damping = 0.0;
  double minimum = 0.0, maximum = kFarthest, stop_stiffness = 0.0;

  static constexpr const char* type = "GasSpring";
  static constexpr const char* text =
      "A cylinder with a gas accumulator between two body-fixed points, with oil damping and end stops; see "
      "Scene.add_spring.";
  static constexpr auto fields() {
    using D = GasSpringDescription;
    return std::tuple_cat(
        SpanDescription::fields(),
        std::tuple(
            required("area", &D::area, "m2", "of the piston").positive().usually(1e-4, 10.0),
            required("pressure", &D::pressure, "Pa", "of the gas at `length`").positive().usually(1e4, 2e8),
            required("volume", &D::volume, "m3", "of the gas at `length`").positive(),
            required("length", &D::length, "m", "at which pressure and volume are given")
                .positive()
                .usually(0.01, 500.0),
            optional("exponent", &D::exponent, "", "of the gas, p V^exponent stays: 1 slow, 1.4 nitrogen")
                .within(1.0, 2.0)
                .usually(0.9, 3.0),
            optional("pushes", &D::pushes, "", "shortening compresses the gas, in place of lengthening"),
            optional("damping", &D::damping, "N s/m", "of the oil, times the rate of length").not_negative(),
            optional("quadratic_damping", &D::quadratic_damping, "N s2/m2",
                     "times the rate times its magnitude")
                .not_negative(),
            optional("minimum", &D::minimum, "m", "length at which an end stop is met; 0: none")
                .not_negative()
                .usually(1e-3, 500.0),
            optional("maximum", &D::maximum, "m", "likewise; at 1e7 there is none").usually(0.01, 500.0),
            optional("stop_stiffness", &D::stop_stiffness, "N/m", "of the end stops").not_negative()));
  }
};

/// Tension between two points, with l their distance and p V^exponent = constant:
///
///   T = side p area + damping l' + quadratic_damping l' |l'| + stops,   V = volume - side area (l - length),
///
/// side = 1, or -1 for one that pushes. Beyond an end stop by a depth d it adds stop_stiffness d back.
struct GasSpring {
  static constexpr const char* kind = "gas spring";
  static constexpr bool holds = true;
  static constexpr Proportion proportions[] = {{"length", "distance", "{} times the distance", 0.05, 20.0}};
  using Description = GasSpringDescription;

  Description d;
  Span span;
  double side_of_gas = 1.0;
  double least = 0.0;  // m3, below which the volume is not taken

  static void check(const Description& d, const Check& c, SceneNames& names) {
    d.check(c, names);
    check_stops(d, c);
  }

  static Description example() {
    auto d = example_span<Description>();
    d.area = 0.8;
    d.pressure = 12.0;
    d.volume = 6.0;
    d.length = 2.0;
    d.damping = 0.4;
    d.quadratic_damping = 0.2;
    d.minimum = 0.5;
    d.maximum = 4.0;
    d.stop_stiffness = 15.0;
    return d;
  }

  template <class Context>
  static GasSpring compile(const Description& d, Context& context) {
    return {d, Span::compile(d, context), d.pushes ? -1.0 : 1.0,
            kLeastVolume * (has_end(d) ? volume_at_end(d) : d.volume)};
  }

  /// Its kinks are in the state.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return span.bodies(); }

  /// What it does at an instant.
  template <class T>
  struct Motion : SpanMotion<T> {
    T pressure, elastic, viscous;
    T tension() const { return elastic + viscous; }
  };

  template <class T>
  Motion<T> motion(const LoadInput<T>& in) const {
    Motion<T> m{span.motion(in), T(0), T(0), T(0)};
    m.pressure = T(d.pressure) * power(T(T(d.volume) / gas_volume(m.length)), d.exponent);
    m.elastic = T(side_of_gas * d.area) * m.pressure + T(d.stop_stiffness) * beyond(m.length);
    const T speed = select(m.rate < T(0), T(-m.rate), m.rate);
    m.viscous = (T(d.damping) + T(d.quadratic_damping) * speed) * m.rate;
    return m;
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Motion<T> m = motion(in);
    span.pull(m, m.tension(), out);
    out.add_power(-m.viscous * m.rate);
  }

  bool has_sides() const { return d.stop_stiffness > 0.0; }
  /// Its end stops.
  Sight look(const LoadInput<double>& in) const {
    const Side now = margins(in).side();
    if (now.any()) return {.side = now};
    const SpanMotion<double> m = span.motion(in);
    return {.side = now,
            .watched = ~now,
            .clear = std::max(0.0, std::min(d.maximum - m.length, m.length - d.minimum)),
            .pace = std::abs(m.rate),
            .at = {m.length, 0.0, 0.0}};
  }
  std::vector<std::string> reached(const Side& from, const Side& to) const {
    return bounds_met(d.name, kMargins, from, to);
  }

  double potential(const LoadInput<double>& in) const {
    const double l = motion(in).length, ratio = d.volume / gas_volume(l), depth = beyond(l);
    const double gas = d.exponent == 1.0
                           ? std::log(ratio)
                           : std::expm1((d.exponent - 1.0) * std::log(ratio)) / (d.exponent - 1.0);
    return d.pressure * d.volume * gas + 0.5 * d.stop_stiffness * depth * depth;
  }

  Margins margins(const LoadInput<double>& in) const {
    const double length = span.length(in);
    auto out = kMargins;
    out[0].value = d.maximum - length;
    out[1].value = length - d.minimum;
    return Margins(out);
  }

 private:
  static constexpr std::array<Margin, 2> kMargins = {{{"maximum"}, {"minimum"}}};
  static constexpr double kLeastVolume = 0.1;  // of that at the end stop, where there is one

  static bool has_end(const Description& d) { return d.pushes ? true : d.maximum < kFarthest; }
  static double volume_at_end(const Description& d) {
    return d.pushes ? d.volume - d.area * (d.length - d.minimum) : d.volume - d.area * (d.maximum - d.length);
  }

  static void check_stops(const Description& d, const Check& c) {
    const bool stops = d.minimum > 0.0 || d.maximum < kFarthest;
    if (stops && d.stop_stiffness == 0.0) {
      c.fail("has a minimum or a maximum and no stop_stiffness; give one, such as 1e8 N/m");
    }
    if (!stops && d.stop_stiffness > 0.0) c.fail("has a stop_stiffness and no stop; give minimum or maximum");
    if (!(d.minimum < d.length && d.length < d.maximum)) {
      c.fail("length is " + to_text(d.length) + " m, and its stops are at " + to_text(d.minimum) + " and " +
             to_text(d.maximum) + " m; give a length between them");
    }
    if (has_end(d) && !(volume_at_end(d) > 0.0)) {
      c.fail("the gas would have " + to_text(volume_at_end(d)) +
             " m3 at the end of its stroke; give a larger volume, or a shorter stroke");
    }
  }

  template <class T>
  T gas_volume(const T& l) const {
    const T now = T(d.volume) - T(side_of_gas * d.area) * (l - T(d.length));
    return select(now < T(least), T(least), now);
  }
  /// How far the length is beyond a stop: positive beyond the maximum.
  template <class T>
  T beyond(const T& l) const {
    return select(l > T(d.maximum), T(l - T(d.maximum)), select(l < T(d.minimum), T(l - T(d.minimum)), T(0)));
  }
};

}  // namespace seacrane
