#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/elements/loads/surface_law.hpp"

namespace seacrane {

struct SeabedNodeDescription {
  std::string name, body;
  Vec3d point = Vec3d::Zero();
  double depth = 0.0, stiffness = 0.0, damping = 0.0, friction = 0.0;
  double load = 0.0, give = 0.0;
  Vec3d anchor = Vec3d::Zero();

  static constexpr const char* type = "SeabedNode";
  static constexpr const char* text =
      "A level seabed under a point of a line: it bears, and holds by friction; see Scene.add_line.";
  static constexpr auto fields() {
    using D = SeabedNodeDescription;
    return std::tuple(
        on_body("body", &D::body), optional("point", &D::point, "m", "body coordinates"),
        required("depth", &D::depth, "m", "of the seabed below z = 0").usually(1.0, 1.2e4),
        required("stiffness", &D::stiffness, "N/m", "of the seabed under the point").positive(),
        optional("damping", &D::damping, "s/m", "share of the force for each m/s of sinking in")
            .not_negative()
            .usually(0.0, 100.0),
        optional("friction", &D::friction, "", "Coulomb's coefficient").not_negative().usually(0.02, 3.0),
        optional("load", &D::load, "N", "that it bears at rest").not_negative(),
        optional("give", &D::give, "m", "that it slides under this load before friction is full")
            .not_negative()
            .usually(1e-4, 1.0),
        optional("anchor", &D::anchor, "m",
                 "place, inertial axes, that it holds at the start; z is left out"));
  }
};

/// A level seabed under a point of a line, which is in it by p and moves along it by s:
///
///   N = k p (1 + d p')   (Hunt, Crossley 1975), never a pull,
///   T = K (x - a) + D s   within friction N,   a' = s - (T - K (x - a)) / D,
///
/// both against the motion. a is the anchor, a place in the seabed whose rate is slip alone: it is 0 while
/// friction holds, so that nothing creeps. K is that of full friction under `load` within `give`, D critical
/// with the mass of the body. Off the seabed the anchor comes to where the point is, and what K has stored is
/// lost.
struct SeabedNode {
  static constexpr const char* kind = "seabed node";
  static constexpr bool from_outside = true, own_pace = true;
  using Description = SeabedNodeDescription;

  Description d;
  int body = 0;
  Vec3d point;                    // from the state point, body axes
  double grip = 0.0, drag = 1.0;  // K, N/m, and D, N s/m
  StateRange states;              // a; none without friction

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body);
    if (d.friction == 0.0 || (d.load > 0.0 && d.give > 0.0)) return;
    c.fail("has friction with a load of " + to_text(d.load) + " N and a give of " + to_text(d.give) +
           " m; give both above zero, or no friction");
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.body = "second";
    d.point = {0.3, -0.2, 0.4};
    d.depth = -9.0;
    d.stiffness = 3.0;
    d.damping = 0.1;
    d.friction = 0.6;
    d.load = 2.0;
    d.give = 0.8;
    d.anchor = {0.1, -0.2, 0.0};
    return d;
  }

  template <class Context>
  static SeabedNode compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, d.point);
    SeabedNode out{d, on.body, on.point, 0.0, 1.0, {}};
    if (d.friction == 0.0) return out;
    out.grip = d.friction * d.load / d.give;
    out.drag = 2.0 * std::sqrt(out.grip * context.mass(d.body));
    const int first = context.state({d.name + ".anchor_x", "m", d.anchor.x(), d.give});
    context.state({d.name + ".anchor_y", "m", d.anchor.y(), d.give});
    out.states = {first, 2};
    return out;
  }

  /// Its kinks are in the state.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 1> bodies() const { return {body}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Place<T> at = place(in);
    const NormalForce<T> press = normal(at);
    Vec3<T> force(T(0), T(0), press.total());
    T power = press.viscous * at.velocity.z();
    if (states.count > 0) {
      const Vec2<T> away = this->away(in, at), rate = at.velocity.template head<2>();
      const auto held = bristle_friction<T, 2>(pull(away, at), T(d.friction) * press.total(), drag);
      for (int i = 0; i < 2; ++i) out.state_rates[states.first + i] = held.follow[i];
      force.template head<2>() = -held.force;
      power += T(grip) * away.dot(rate - held.follow) - held.force.dot(rate);
    }
    out.wrench[body].add(force, at.lever);
    out.add_power(power);
  }

  double potential(const LoadInput<double>& in) const {
    const Place<double> at = place(in);
    const double sunk = std::max(at.depth, 0.0), normal = 0.5 * d.stiffness * sunk * sunk;
    if (states.count == 0) return normal;
    return normal + 0.5 * grip * away(in, at).squaredNorm();
  }

  /// The seabed below it.
  Sight look(const LoadInput<double>& in) const {
    constexpr std::size_t below = 0;  // as margins() adds it
    const Side now = margins(in).side();
    if (now[below]) return {.side = now};
    const auto& k = in.bodies[body];
    Sight out{.side = now, .watched = side_of({below}), .pace = velocity_of(k, point).norm()};
    out.at = k.position + k.rotation * point;
    out.clear = std::max(0.0, out.at.z() + d.depth);
    return out;
  }

  /// Positive above the seabed, while it would not pull, and while friction holds; below zero off the seabed.
  Margins margins(const LoadInput<double>& in) const {
    const Place<double> at = place(in);
    const bool touches = at.depth > 0.0;
    const double share = 1.0 - d.damping * at.velocity.z();
    Margins out;
    out.add({nullptr, -at.depth});
    out.add({nullptr, touches ? share : 1.0});
    if (states.count == 0) return out;
    const double most = d.friction * d.stiffness * at.depth * (touches ? std::max(share, 0.0) : 1.0);
    out.add({nullptr, most - pull(away(in, at), at).norm()});
    return out;
  }

 private:
  template <class T>
  using Vec2 = Eigen::Matrix<T, 2, 1>;

  template <class T>
  struct Place {
    Vec3<T> lever, point, velocity;
    T depth;  // in the seabed; negative above it
  };

  template <class T>
  Place<T> place(const LoadInput<T>& in) const {
    const auto& k = in.bodies[body];
    Place<T> out;
    out.lever = k.rotation * point.template cast<T>();
    out.point = k.position + out.lever;
    out.velocity = k.velocity + cross<T>(k.angular_velocity, out.lever);
    out.depth = T(-d.depth) - out.point.z();
    return out;
  }

  template <class T>
  NormalForce<T> normal(const Place<T>& at) const {
    if (!(at.depth > T(0))) return {};
    return hunt_crossley<T>(T(d.stiffness) * at.depth, d.damping, T(-at.velocity.z()));
  }

  /// x - a.
  template <class T>
  Vec2<T> away(const LoadInput<T>& in, const Place<T>& at) const {
    return {at.point[0] - in.states[states.first], at.point[1] - in.states[states.first + 1]};
  }
  /// The T that holds without slip.
  template <class T>
  Vec2<T> pull(const Vec2<T>& away, const Place<T>& at) const {
    return away * T(grip) + at.velocity.template head<2>() * T(drag);
  }
};

}  // namespace seacrane
