#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/power.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct GasSpringDescription {
  std::string name, first, second;
  Vec3d first_point = Vec3d::Zero(), second_point = Vec3d::Zero();
  double area = 0.0, pressure = 0.0, volume = 0.0, length = 0.0, exponent = 1.4;
  bool pushes = false;
  double damping = 0.0, quadratic_damping = 0.0;
  double minimum = 0.0, maximum = kFarthest, stop_stiffness = 0.0;

  static constexpr const char* type = "GasSpring";
  static constexpr const char* text =
      "A cylinder with a gas accumulator between two body-fixed points, with oil damping and end stops; see "
      "Scene.add_gas_spring.";
  static constexpr auto fields() {
    using D = GasSpringDescription;
    return std::tuple(
        on_body("first", &D::first), on_body("second", &D::second),
        optional("first_point", &D::first_point, "m", "coordinates of the first body"),
        optional("second_point", &D::second_point, "m", "coordinates of the second body"),
        required("area", &D::area, "m2", "of the piston").positive().usually(1e-4, 10.0),
        required("pressure", &D::pressure, "Pa", "of the gas at `length`").positive().usually(1e4, 2e8),
        required("volume", &D::volume, "m3", "of the gas at `length`").positive(),
        required("length", &D::length, "m", "at which pressure and volume are given")
            .positive()
            .usually(0.01, 500.0),
        optional("exponent", &D::exponent, "", "of the gas: p V^exponent stays")
            .within(1.0, 2.0)
            .usually(0.9, 3.0),
        optional("pushes", &D::pushes, "", "shortening compresses the gas, in place of lengthening"),
        optional("damping", &D::damping, "N s/m", "of the oil, times the rate of length").not_negative(),
        optional("quadratic_damping", &D::quadratic_damping, "N s2/m2", "times the rate times its magnitude")
            .not_negative(),
        optional("minimum", &D::minimum, "m", "length at which an end stop is met; 0: none")
            .not_negative()
            .usually(1e-3, 500.0),
        optional("maximum", &D::maximum, "m", "likewise; at 1e7 there is none").usually(0.01, 500.0),
        optional("stop_stiffness", &D::stop_stiffness, "N/m", "of the end stops").not_negative());
  }
};

/// Tension between two points, with l their distance and p V^exponent = constant:
///
///   T = side p area + damping l' + quadratic_damping l' |l'| + stops,   V = volume - side area (l - length),
///
/// side = 1, or -1 for one that pushes. Beyond an end stop by a depth d it adds stop_stiffness d back.
struct GasSpring {
  static constexpr const char* kind = "gas spring";
  using Description = GasSpringDescription;

  std::string name;
  int first = 0, second = 0;
  Vec3d first_point, second_point;  // from the state points, body axes
  double area = 0.0, pressure = 0.0, volume = 0.0, length = 0.0, exponent = 0.0, side_of_gas = 1.0;
  double damping = 0.0, quadratic_damping = 0.0, minimum = 0.0, maximum = 0.0, stop_stiffness = 0.0;
  double least = 0.0;  // m3, below which the volume is not taken

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.first, true);
    names.body(c, d.second, true);
    if (d.first == d.second) c.fail("joins '" + d.first + "' to itself; name two different bodies");
    check_stops(d, c);
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.first = "first";
    d.second = "second";
    d.first_point = {2.0, 0.5, -1.0};
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
    const Attachment a = context.attach(d.first, d.first_point), b = context.attach(d.second, d.second_point);
    GasSpring out;
    out.name = d.name;
    out.first = a.body;
    out.second = b.body;
    out.first_point = a.point;
    out.second_point = b.point;
    out.area = d.area;
    out.pressure = d.pressure;
    out.volume = d.volume;
    out.length = d.length;
    out.exponent = d.exponent;
    out.side_of_gas = d.pushes ? -1.0 : 1.0;
    out.damping = d.damping;
    out.quadratic_damping = d.quadratic_damping;
    out.minimum = d.minimum;
    out.maximum = d.maximum;
    out.stop_stiffness = d.stop_stiffness;
    out.least = kLeastVolume * (has_end(d) ? volume_at_end(d) : d.volume);
    return out;
  }

  /// Its kinks are in the state.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return {first, second}; }

  /// What it does at an instant.
  template <class T>
  struct Motion {
    T length, rate, pressure, elastic, viscous;
    Vec3<T> along, lever_first, lever_second;
    T tension() const { return elastic + viscous; }
  };

  template <class T>
  Motion<T> motion(const LoadInput<T>& in) const {
    using std::sqrt;
    const auto &ka = in.bodies[first], &kb = in.bodies[second];
    Motion<T> m;
    m.lever_first = ka.rotation * first_point.cast<T>();
    m.lever_second = kb.rotation * second_point.cast<T>();
    const Vec3<T> d = kb.position + m.lever_second - ka.position - m.lever_first;
    const T square = d.dot(d);
    const bool apart = square > T(0);  // else it has no direction
    m.length = apart ? T(sqrt(square)) : T(0);
    m.along = apart ? Vec3<T>(d / m.length) : Vec3<T>(Vec3<T>::Zero());
    const Vec3<T> d_rate = kb.velocity + cross<T>(kb.angular_velocity, m.lever_second) - ka.velocity -
                           cross<T>(ka.angular_velocity, m.lever_first);
    m.rate = m.along.dot(d_rate);
    m.pressure = T(pressure) * power(T(T(volume) / gas_volume(m.length)), exponent);
    m.elastic = T(side_of_gas * area) * m.pressure + T(stop_stiffness) * beyond(m.length);
    const T speed = select(m.rate < T(0), T(-m.rate), m.rate);
    m.viscous = (T(damping) + T(quadratic_damping) * speed) * m.rate;
    return m;
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Motion<T> m = motion(in);
    const Vec3<T> pull = m.along * m.tension(), back = -pull;
    out.wrench[first].add(pull, m.lever_first);
    out.wrench[second].add(back, m.lever_second);
    out.add_power(-m.viscous * m.rate);
  }

  bool has_sides() const { return stop_stiffness > 0.0; }
  /// 1 beyond the maximum, -1 beyond the minimum, else 0.
  int side(const LoadInput<double>& in) const {
    const double l = motion(in).length;
    return l > maximum ? 1 : (l < minimum ? -1 : 0);
  }
  double across(const LoadInput<double>& in, int from, int to) const {
    return motion(in).length - ((from != 0 ? from : to) > 0 ? maximum : minimum);
  }
  /// What is reached where it changes its side; empty: nothing.
  std::string reached(int from, int to) const {
    if (to == 0 || to == from) return "";
    return name + (to > 0 ? ".maximum" : ".minimum");
  }

  double potential(const LoadInput<double>& in) const {
    const double l = motion(in).length, ratio = volume / gas_volume(l), depth = beyond(l);
    const double gas =
        exponent == 1.0 ? std::log(ratio) : std::expm1((exponent - 1.0) * std::log(ratio)) / (exponent - 1.0);
    return pressure * volume * gas + 0.5 * stop_stiffness * depth * depth;
  }

 private:
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
    const T now = T(volume) - T(side_of_gas * area) * (l - T(length));
    return select(now < T(least), T(least), now);
  }
  /// How far the length is beyond a stop: positive beyond the maximum.
  template <class T>
  T beyond(const T& l) const {
    return select(l > T(maximum), T(l - T(maximum)), select(l < T(minimum), T(l - T(minimum)), T(0)));
  }
};

}  // namespace seacrane
