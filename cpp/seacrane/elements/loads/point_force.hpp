#pragma once

#include <array>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

struct PointForceDescription {
  std::string name, body;
  Vec3d point = Vec3d::Zero();  // body coordinates
  Vec3d force = Vec3d::Zero();  // inertial or body axes
  bool body_axes = false;

  static constexpr const char* type = "PointForce";
  static constexpr const char* text = "A constant force at a body-fixed point, in inertial or body axes.";
  static constexpr auto fields() {
    using D = PointForceDescription;
    return std::tuple(on_body("body", &D::body), optional("point", &D::point, "m", "body coordinates"),
                      required("force", &D::force, "N", ""),
                      optional("body_axes", &D::body_axes, "", "whether the force turns with the body"));
  }
};

/// A force at a body-fixed point, constant in inertial or in body axes; three slots add to it.
struct PointForce {
  static constexpr const char* kind = "point force";
  static constexpr bool packs = true;
  using Description = PointForceDescription;

  Description d;
  int body = 0;
  Vec3d point;  // from the state point, body axes
  Mat3d axes;   // of the described body
  int slot = 0;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body);
    names.input(c, kind, d.name);
  }

  static Description example() {
    return {"load", "first", Vec3d(0.1, 0.2, 0.3), Vec3d(1.0, -2.0, 3.0), true};
  }

  template <class Context>
  static PointForce compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, d.point);
    return {d, on.body, on.point, on.axes, context.input(d.name + ".force", 3)};
  }

  /// Inputs, which add to it, are held between calls of a controller, and those restart the integration.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 1> bodies() const { return {body}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const auto& k = in.bodies[body];
    const Vec3d total = d.force + view<3>(in.slots + slot);
    Vec3<T> f = total.cast<T>();
    if (d.body_axes) f = times<T>(k.rotation, Vec3d(axes * total));
    const Vec3<T> lever = times<T>(k.rotation, point);
    out.wrench[body].add(f, lever);
    out.add_power(dot<T>(f, k.velocity + cross<T>(k.angular_velocity, lever)));
  }
};

}  // namespace seacrane
