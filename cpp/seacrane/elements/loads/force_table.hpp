#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

struct ForceTableDescription {
  std::string name, body;
  Vec3d point = Vec3d::Zero();
  std::vector<double> times;
  std::vector<Vec6d> wrenches;  // inertial axes, moments about the point

  static constexpr const char* type = "ForceTable";
  static constexpr const char* text =
      "Force and moment (n, 6), N and N m, inertial axes, about a body-fixed point, over times (n,) in s; "
      "linear in between, held outside.";
  static constexpr auto fields() {
    using D = ForceTableDescription;
    return std::tuple(on_body("body", &D::body), optional("point", &D::point, "m", "body coordinates"),
                      required("times", &D::times, "s", ""),
                      required("wrenches", &D::wrenches, "N, N m", "force and moment at the times"));
  }
};

/// A wrench tabulated over time (linear between the times, held outside) at a body-fixed point.
struct ForceTable {
  static constexpr const char* kind = "force table";
  static constexpr bool packs = true;
  using Description = ForceTableDescription;

  Description d;
  int body = 0;
  Vec3d point;  // from the state point, body axes

  Vec6d at(double t) const {
    if (t <= d.times.front()) return d.wrenches.front();
    if (t >= d.times.back()) return d.wrenches.back();
    const auto next = std::upper_bound(d.times.begin(), d.times.end(), t);
    const auto i = static_cast<std::size_t>(next - d.times.begin()) - 1;
    const double s = (t - d.times[i]) / (d.times[i + 1] - d.times[i]);
    return (1.0 - s) * d.wrenches[i] + s * d.wrenches[i + 1];
  }

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body);
    if (d.times.empty() || d.times.size() != d.wrenches.size()) {
      c.fail("has " + std::to_string(d.times.size()) + " times and " + std::to_string(d.wrenches.size()) +
             " wrenches; give as many of both");
    }
    c.increases("times", d.times);
  }

  static Description example() {
    const Vec6d later = (Vec6d() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0).finished();
    return {"load", "second", Vec3d(0.1, 0.2, 0.3), {0.0, 1.0}, {Vec6d::Zero(), later}};
  }

  template <class Context>
  static ForceTable compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, d.point);
    return {d, on.body, on.point};
  }

  std::vector<LoadKinks> kinks() const {
    LoadKinks out;
    Vec6d before = Vec6d::Zero();
    for (std::size_t i = 0; i < d.times.size(); ++i) {
      Vec6d after = Vec6d::Zero();
      if (i + 1 < d.times.size()) after = (d.wrenches[i + 1] - d.wrenches[i]) / (d.times[i + 1] - d.times[i]);
      LoadKink& kink = out.emplace_back();
      kink.time = d.times[i];
      kink.jump.setZero(6, 4);
      kink.jump.col(2) = after - before;
      before = after;
    }
    return {out};
  }

  /// Components: force and moment.
  void add_unit(int component, const LoadInput<double>& in, Vec6d* wrenches) const {
    const Vec6d unit = Vec6d::Unit(component);
    const Vec3d force = unit.head<3>(), lever = in.bodies[body].rotation * point;
    wrenches[body] += unit;
    wrenches[body].tail<3>() += lever.cross(force);
  }

  std::array<int, 1> bodies() const { return {body}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const auto& k = in.bodies[body];
    const Vec6<T> w = at(in.time).template cast<T>();
    const Vec3<T> lever = k.rotation * point.cast<T>(), force = w.template head<3>(),
                  moment = w.template tail<3>();
    out.wrench[body].add(force, lever);
    out.wrench[body].moment += moment;
    out.add_power(force.dot(k.velocity + cross<T>(k.angular_velocity, lever)) +
                  moment.dot(k.angular_velocity));
  }
};

}  // namespace seacrane
