#pragma once

#include <array>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"

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
    return std::tuple(on_body("first", &D::first), on_body("over", &D::over), on_body("second", &D::second),
                      optional("first_point", &D::first_point, "m", "coordinates of the first body"),
                      optional("over_point", &D::over_point, "m", "coordinates of the body it runs over"),
                      optional("second_point", &D::second_point, "m", "coordinates of the second body"),
                      required("stiffness", &D::stiffness, "N/m", ""),
                      optional("damping", &D::damping, "N s/m", ""),
                      required("natural_length", &D::natural_length, "m", "of both parts together"));
  }
};

/// Length l = |p_over - p_first| + |p_second - p_over|; the tension T =
/// stiffness (l - natural_length) + damping l' is the same in both parts, and
/// zero where the wire is slack.
struct ElasticWire {
  static constexpr const char* kind = "elastic wire";
  using Description = ElasticWireDescription;

  std::array<int, 3> on = {};
  std::array<Vec3d, 3> points;  // from the state points, body axes
  double stiffness = 0.0, damping = 0.0, natural_length = 0.0;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    for (const std::string& body : {d.first, d.over, d.second}) names.body(c, body, true);
    c.near("first_point", d.first_point);
    c.near("over_point", d.over_point);
    c.near("second_point", d.second_point);
    c.not_negative("stiffness", d.stiffness);
    c.not_negative("damping", d.damping);
    c.not_negative("natural_length", d.natural_length);
  }

  static Description example() {
    return {"load",           "first", "third", "second", Vec3d(2.0, 0.5, -1.0), Vec3d(0.1, -0.3, 0.2),
            Vec3d(0.4, 0, 1), 30.0,    0.5,     0.2};
  }

  template <class Context>
  static ElasticWire compile(const Description& d, Context& context) {
    const std::array<Attachment, 3> at = {context.attach(d.first, d.first_point),
                                          context.attach(d.over, d.over_point),
                                          context.attach(d.second, d.second_point)};
    return {{at[0].body, at[1].body, at[2].body},
            {at[0].point, at[1].point, at[2].point},
            d.stiffness,
            d.damping,
            d.natural_length};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 3> bodies() const { return on; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    using std::sqrt;
    Vec3<T> lever[3], place[3], velocity[3], along[2];
    for (int i = 0; i < 3; ++i) {
      const auto& k = in.bodies[on[idx(i)]];
      lever[i] = k.rotation * points[idx(i)].template cast<T>();
      place[i] = k.position + lever[i];
      velocity[i] = k.velocity + cross<T>(k.angular_velocity, lever[i]);
    }
    T length(0), rate(0);
    for (int i = 0; i < 2; ++i) {
      const Vec3<T> d = place[i + 1] - place[i];
      const T part = sqrt(d.dot(d));
      if (!(part > T(0))) return;  // coincident points: no direction
      along[i] = d / part;
      length += part;
      rate += along[i].dot(velocity[i + 1] - velocity[i]);
    }
    const T elastic = T(stiffness) * (length - T(natural_length));
    if (!(elastic > T(0))) return;
    T viscous = T(damping) * rate;
    if (elastic + viscous < T(0)) viscous = -elastic;
    for (int i = 0; i < 2; ++i) {
      const Vec3<T> pull = along[i] * (elastic + viscous), back = -pull;
      out.wrench[on[idx(i)]].add(pull, lever[i]);
      out.wrench[on[idx(i) + 1]].add(back, lever[i + 1]);
    }
    if (damping != 0.0) out.add_power(-viscous * rate);
  }

  double potential(const LoadInput<double>& in) const {
    double length = 0.0;
    const auto place = [&](std::size_t i) -> Vec3d {
      return in.bodies[on[i]].position + in.bodies[on[i]].rotation * points[i];
    };
    for (const std::size_t i : {0, 1}) length += (place(i + 1) - place(i)).norm();
    const double stretch = length > natural_length ? length - natural_length : 0.0;
    return 0.5 * stiffness * stretch * stretch;
  }
};

}  // namespace seacrane
