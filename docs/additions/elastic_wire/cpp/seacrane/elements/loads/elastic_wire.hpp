#pragma once

#include "seacrane/elements/loads/span.hpp"

namespace seacrane {

struct ElasticWireDescription {
  std::string name, first, over, second;
  Vec3d first_point = Vec3d::Zero(), over_point = Vec3d::Zero(), second_point = Vec3d::Zero();
  double stiffness = 0.0, damping = 0.0, natural_length = 0.0;

  static constexpr const char* type = "ElasticWire";
  static constexpr const char* text =
      "An elastic wire from a point of one body over a point of another, "
      "without friction, to a third body: "
      "tension stiffness (length - natural_length) + damping times the rate of "
      "length, never a push.";
  static constexpr auto fields() {
    using D = ElasticWireDescription;
    return std::tuple(
        on_body("first", &D::first), on_body("over", &D::over), on_body("second", &D::second),
        optional("first_point", &D::first_point, "m", "coordinates of the first body"),
        optional("over_point", &D::over_point, "m", "coordinates of the body it runs over"),
        optional("second_point", &D::second_point, "m", "coordinates of the second body"),
        required("stiffness", &D::stiffness, "N/m", "").not_negative(),
        optional("damping", &D::damping, "N s/m", "").not_negative(),
        required("natural_length", &D::natural_length, "m", "of both parts together").not_negative());
  }
};

/// Length l = |p_over - p_first| + |p_second - p_over|; the tension T =
/// stiffness (l - natural_length) + damping l' is the same in both parts, and
/// zero where the wire is slack.
struct ElasticWire {
  static constexpr const char* kind = "elastic wire";
  using Description = ElasticWireDescription;

  Description d;
  Span before, after;  // what it runs over

  static void check(const Description& d, const Check& c, SceneNames& names) {
    for (const std::string& body : {d.first, d.over, d.second}) names.body(c, body, true);
  }

  static Description example() {
    return {"load",           "first", "third", "second", Vec3d(2.0, 0.5, -1.0), Vec3d(0.1, -0.3, 0.2),
            Vec3d(0.4, 0, 1), 30.0,    0.5,     0.2};
  }

  template <class Context>
  static ElasticWire compile(const Description& d, Context& context) {
    const Attachment first = context.attach(d.first, d.first_point),
                     over = context.attach(d.over, d.over_point),
                     second = context.attach(d.second, d.second_point);
    return {d,
            {first.body, over.body, first.point, over.point},
            {over.body, second.body, over.point, second.point}};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 3> bodies() const { return {before.first, after.first, after.second}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const SpanMotion<T> one = before.motion(in), other = after.motion(in);
    const T elastic = T(d.stiffness) * (one.length + other.length - T(d.natural_length));
    if (!(elastic > T(0))) return;
    const T rate = one.rate + other.rate;
    T viscous = T(d.damping) * rate;
    if (elastic + viscous < T(0)) viscous = -elastic;
    const T tension = elastic + viscous;
    before.pull(one, tension, out);
    after.pull(other, tension, out);
    if (d.damping != 0.0) out.add_power(-viscous * rate);
  }

  double potential(const LoadInput<double>& in) const {
    const double length = before.length(in) + after.length(in);
    const double stretch = length > d.natural_length ? length - d.natural_length : 0.0;
    return 0.5 * d.stiffness * stretch * stretch;
  }
};

}  // namespace seacrane
