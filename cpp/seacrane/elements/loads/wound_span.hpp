#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/paid_out.hpp"
#include "seacrane/elements/loads/span.hpp"
#include "seacrane/math/curve.hpp"

namespace seacrane {

struct WoundSpanDescription : SpanDescription {
  double mass_per_length = 0.0;
  Curve length;
  double below_first = 1.0, below_second = 0.0;
  std::string paid_out_by;

  static constexpr const char* type = "WoundSpan";
  static constexpr const char* text =
      "A segment of a line with mass that is paid out and hauled in: the mass that its ends gain, and that "
      "moves past them; see Scene.add_line.";
  static constexpr auto fields() {
    using D = WoundSpanDescription;
    return std::tuple_cat(
        SpanDescription::fields(),
        std::tuple(required("mass_per_length", &D::mass_per_length, "kg/m", "").positive().usually(0.05, 1e4),
                   required("length", &D::length, "m",
                            "unstretched, of the segment; with a winch, that whose mass its ends have")
                       .positive()
                       .usually(0.01, 1e5),
                   required("below_first", &D::below_first, "", "share of the line beyond the first end")
                       .within(0.0, 1.0),
                   required("below_second", &D::below_second, "", "and beyond the second end, which is less")
                       .within(0.0, 1.0),
                   optional("paid_out_by", &D::paid_out_by, "",
                            "line with mass, on a winch, that it is a part of")));
  }
};

/// What winding adds to a segment of a line with mass. The line has the unstretched length L(t) and leaves
/// its drum at one end, by a curve or by a winch. The ends of segments are at fixed shares e of L from there,
/// so that a segment is as long as l = a L, and material moves past them. It has the velocity and the
/// acceleration
///
///   v = x' + k x_e,   x'' + k' x_e + 2 k x_e' + k (k_e x_e + k x_ee),   k = (1 - e) L' / L,   k_e = -L' / L
///
/// at a node at x(e, t), with slopes over e. With d from the first end of a segment to the second, mu the
/// mass per length, m = mu l / 2 and q = mu L' (1 - e) what flows past its middle, the segment puts on its
/// ends
///
///   -m (k' d + k d') / a - q (d' - d L'/L) / 2 -+ mu l k^2 d / a^2,
///
/// - on the first and + on the second, and not where the line leaves the drum, as material comes with the
/// velocity that it has there. Between equal segments that is all of it to second order in a.
///
/// Its ends have the mass of the segment at time 0; this adds what it gains, with its weight. All of it is
/// booked as a power. The momentum of what is on the drum is left out.
struct WoundSpan {
  static constexpr const char* kind = "wound span";
  static constexpr const char* drawn = "";  // what it acts on is
  static constexpr bool from_outside = true;
  using Description = WoundSpanDescription;

  Description d;
  Span span;
  double share = 1.0;      // of the line, a
  double described = 0.0;  // m, the length whose mass the ends have
  PaidOut paid_out;
  double gravity = 0.0;           // m/s2
  std::array<double, 2> below{};  // 1 - e, of its ends
  std::vector<int> on;            // bodies of its ends, and those that the winch feels

  static void check(const Description& d, const Check& c, SceneNames& names) {
    d.check(c, names);
    if (!(d.below_first > d.below_second)) {
      c.fail("has " + to_text(d.below_first) + " of the line beyond its first end and " +
             to_text(d.below_second) + " beyond its second; give a first end that is nearer the drum");
    }
    if (!d.paid_out_by.empty() && d.length.pieces().size() > 1) {
      c.fail("length changes over time, and winch '" + d.paid_out_by + "' does that; give a number");
    }
    if (!d.length.breakpoints(1).empty()) {
      c.fail(
          "the rate of its length jumps at t = " + to_text(d.length.breakpoints(1).front()) +
          " s, which its mass cannot follow; give a curve with a rate that does not, such as Curve.quintic");
    }
  }

  static Description example() {
    auto d = example_span<Description>({0.2, -0.3, 0.4});
    d.mass_per_length = 0.3;
    d.length = Curve::quintic(-1.0, 2.0, 3.0, 5.0);
    d.below_first = 0.8;
    d.below_second = 0.5;
    return d;
  }

  template <class Context>
  static WoundSpan compile(const Description& d, Context& context) {
    WoundSpan out;
    out.d = d;
    out.span = Span::compile(d, context);
    out.share = d.below_first - d.below_second;
    out.described = d.length.at(0.0).value;
    out.paid_out = PaidOut::compile(d.length, d.paid_out_by, out.share, Check(kind, d.name), context);
    out.gravity = context.gravity();
    out.below = {d.below_first, d.below_second};
    out.on = {out.span.first, out.span.second};
    if (!out.paid_out.segment) return out;
    for (const int b : out.paid_out.segment->drives()) {
      if (std::find(out.on.begin(), out.on.end(), b) == out.on.end()) out.on.push_back(b);
    }
    return out;
  }

  /// Those of the acceleration of the length, whose steps the ends follow at once.
  std::vector<LoadKinks> kinks() const { return paid_out.kinks(); }

  /// Of a unit of the acceleration of the length.
  void add_unit(int /*component*/, const LoadInput<double>& in, Vec6d* wrenches) const {
    const SpanPlace<double> at = span.place(in);
    const auto add = [&](int body, const Vec3d& lever, double beyond) {
      const Vec3d force = at.apart * (-0.5 * d.mass_per_length * beyond / share);
      wrenches[body] += (Vec6d() << force, lever.cross(force)).finished();
    };
    add(span.first, at.lever_first, below[0]);
    add(span.second, at.lever_second, below[1]);
  }

  const std::vector<int>& bodies() const { return on; }
  StateRange followed() const { return paid_out.followed(); }

  template <class T>
  void add_inertia(const LoadInput<T>& in, Mat6<T>* mass) const {
    const SpanPlace<T> at = span.place(in);
    const T gained = gain(paid_out.length(in)).value;
    const auto add = [&](Mat6<T>& to, const Vec3<T>& lever) {
      const Mat3<T> across = skew<T>(lever) * gained;
      for (int i = 0; i < 3; ++i) to(i, i) += gained;
      to.template bottomLeftCorner<3, 3>() += across;
      to.template topRightCorner<3, 3>() -= across;
      to.template bottomRightCorner<3, 3>() -= across * skew<T>(lever);
    };
    add(mass[span.first], at.lever_first);
    add(mass[span.second], at.lever_second);
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const SpanPlace<T> at = span.place(in);
    const End<T> ends[2] = {end_at(in.bodies[span.first], at.lever_first),
                            end_at(in.bodies[span.second], at.lever_second)};
    const Vec3<T> rate = ends[1].velocity - ends[0].velocity;
    const PaidOut::Length<T> length = paid_out.length(in), gained = gain(length);
    const Moving<T> now = moving(length, paid_out.acceleration(in));
    for (int i = 0; i < 2; ++i) {
      const End<T>& end = ends[i];
      Vec3<T> force = at.apart * now.place[idx(i)] + rate * now.rate[idx(i)];
      force -= end.swept * gained.value;
      force.z() -= T(gravity) * gained.value;
      out.wrench[i == 0 ? span.first : span.second].add(force, end.lever);
      const T stored =
          gained.value * end.velocity.dot(end.swept) + T(0.5) * gained.rate * end.velocity.dot(end.velocity);
      out.add_power(force.dot(end.velocity) + stored);
    }
  }

 private:
  template <class T>
  struct End {
    Vec3<T> lever, velocity, swept;
  };
  /// Factors of d and d' at each end, N/m and N s/m.
  template <class T>
  struct Moving {
    std::array<T, 2> place, rate;
  };

  template <class T>
  static End<T> end_at(const BodyKinematics<T>& k, const Vec3<T>& lever) {
    const Vec3<T> around = cross<T>(k.angular_velocity, lever);
    return {lever, k.velocity + around, cross<T>(k.angular_velocity, around)};
  }

  /// Of the mass of one end beyond what is described, and its rate.
  template <class T>
  PaidOut::Length<T> gain(const PaidOut::Length<T>& l) const {
    const T half(0.5 * d.mass_per_length);
    return {half * (l.value - T(described)), half * l.rate};
  }

  template <class T>
  Moving<T> moving(const PaidOut::Length<T>& l, const T& acceleration) const {
    const T growth = l.rate / l.value, half = T(0.5 * d.mass_per_length / share) * l.value;
    const T flow = T(d.mass_per_length / share * 0.5 * (below[0] + below[1])) * l.rate;
    Moving<T> out;
    for (int i = 0; i < 2; ++i) {
      const T b(below[idx(i)]), k = b * growth;
      const T k_rate = b * (acceleration / l.value - growth * growth);
      out.place[idx(i)] = T(0.5) * flow * growth - half * k_rate;
      out.rate[idx(i)] = -(half * k + T(0.5) * flow);
      if (below[idx(i)] == 1.0) continue;
      const T bend = T(d.mass_per_length / (share * share)) * l.value * k * k;
      out.place[idx(i)] += i == 0 ? T(-bend) : bend;
    }
    return out;
  }
};

}  // namespace seacrane
