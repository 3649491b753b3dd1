#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct SpringDescription {
  std::string name, first, second;
  Vec3d first_point = Vec3d::Zero(), second_point = Vec3d::Zero();
  double stiffness = 0.0, damping = 0.0, natural_length = 0.0;
  std::vector<double> lengths, forces;  // tabulated tension over length, instead of stiffness

  static constexpr const char* type = "Spring";
  static constexpr const char* text =
      "Tension between two body-fixed points: stiffness times elongation, or a table of tension over length, "
      "plus damping times the rate of length.";
  static constexpr auto fields() {
    using D = SpringDescription;
    return std::tuple(
        on_body("first", &D::first), on_body("second", &D::second),
        optional("first_point", &D::first_point, "m", "coordinates of the first body"),
        optional("second_point", &D::second_point, "m", "coordinates of the second body"),
        optional("stiffness", &D::stiffness, "N/m", "").not_negative(),
        optional("damping", &D::damping, "N s/m", "").not_negative(),
        optional("natural_length", &D::natural_length, "m", "").not_negative().usually(0.0, 5000.0),
        optional("lengths", &D::lengths, "m", "of a table of tension, in place of stiffness")
            .usually(0.0, 5000.0),
        optional("forces", &D::forces, "N", "tension at the lengths"));
  }
};

/// Tension between two points: stiffness (length - natural_length), or a table of tension over length
/// (linear between its points, held outside), plus damping times the rate of length.
struct SpringDamper {
  static constexpr const char* kind = "spring";
  static constexpr bool packs = true;
  using Description = SpringDescription;

  int first = 0, second = 0;
  Vec3d first_point, second_point;  // from the state points, body axes
  double stiffness = 0.0, damping = 0.0, natural_length = 0.0;
  std::vector<double> lengths, forces;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.first, true);
    names.body(c, d.second, true);
    if (d.first == d.second) c.fail("joins '" + d.first + "' to itself; name two different bodies");
    if (d.lengths.size() != d.forces.size() || d.lengths.size() == 1) {
      c.fail("the table has " + std::to_string(d.lengths.size()) + " lengths and " +
             std::to_string(d.forces.size()) + " forces; give at least two of each");
    }
    c.increases("lengths", d.lengths);
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.first = "first";
    d.second = "second";
    d.first_point = {2.0, 0.5, -1.0};
    d.stiffness = 30.0;
    d.damping = 0.5;
    d.natural_length = 0.8;
    return d;
  }

  template <class Context>
  static SpringDamper compile(const Description& d, Context& context) {
    const Attachment a = context.attach(d.first, d.first_point);
    const Attachment b = context.attach(d.second, d.second_point);
    return {a.body, b.body, a.point, b.point, d.stiffness, d.damping, d.natural_length, d.lengths, d.forces};
  }

  /// A table over length has its kinks in the state.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return {first, second}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    using std::sqrt;
    const auto &ka = in.bodies[first], &kb = in.bodies[second];
    const Vec3<T> lever_a = ka.rotation * first_point.cast<T>(),
                  lever_b = kb.rotation * second_point.cast<T>();
    const Vec3<T> d = kb.position + lever_b - ka.position - lever_a;
    const T square = d.dot(d);
    const auto apart = square > T(0);  // coincident points have no direction
    const T length = sqrt(select(apart, square, T(1)));
    const Vec3<T> n = d / length;
    const Vec3<T> d_rate = kb.velocity + cross<T>(kb.angular_velocity, lever_b) - ka.velocity -
                           cross<T>(ka.angular_velocity, lever_a);
    const T rate = n.dot(d_rate), viscous = T(damping) * rate;
    const Vec3<T> pull = n * select(apart, T(elastic(length) + viscous), T(0));
    out.wrench[first].add(pull, lever_a);
    const Vec3<T> back = -pull;
    out.wrench[second].add(back, lever_b);
    if (damping != 0.0) out.add_power(-viscous * rate);
  }

  template <class T>
  T elastic(const T& length) const {
    if (lengths.empty()) return T(stiffness) * (length - T(natural_length));
    T out = T(forces.front());
    for (std::size_t i = 0; i + 1 < lengths.size(); ++i) {
      const double slope = (forces[i + 1] - forces[i]) / (lengths[i + 1] - lengths[i]);
      const T here = T(forces[i]) + T(slope) * (length - T(lengths[i]));
      out = select(length >= T(lengths[i]), here, out);
    }
    return select(length < T(lengths.back()), out, T(forces.back()));
  }

  bool has_sides() const { return !lengths.empty(); }
  /// The segment of the table; 0 before its first length.
  int side(const LoadInput<double>& in) const {
    return static_cast<int>(std::upper_bound(lengths.begin(), lengths.end(), length(in)) - lengths.begin());
  }
  double across(const LoadInput<double>& in, int from, int to) const {
    return length(in) - lengths[idx(to > from ? from : from - 1)];
  }

  double potential(const LoadInput<double>& in) const {
    const double length = this->length(in);
    if (lengths.empty()) return 0.5 * stiffness * (length - natural_length) * (length - natural_length);
    double energy = std::min(0.0, length - lengths.front()) * forces.front();
    for (std::size_t i = 0; i + 1 < lengths.size() && lengths[i] < length; ++i) {
      const double end = std::min(length, lengths[i + 1]);
      energy += 0.5 * (forces[i] + elastic(end)) * (end - lengths[i]);
    }
    return energy + std::max(0.0, length - lengths.back()) * forces.back();
  }

 private:
  double length(const LoadInput<double>& in) const {
    const auto &ka = in.bodies[first], &kb = in.bodies[second];
    return (kb.position + kb.rotation * second_point - ka.position - ka.rotation * first_point).norm();
  }
};

}  // namespace seacrane
