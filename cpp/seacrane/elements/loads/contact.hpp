#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/elements/loads/contact_description.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/elements/loads/surface_law.hpp"

namespace seacrane {

/// Points of one body against the surface of another. A point that is inside by p, which grows at the rate
/// p', is pressed out with N of hunt_crossley(). With friction it hangs on an anchor a, in axes of the
/// surface, by a spring and a damper along the surface: with x the point in these axes and s the velocity at
/// which it slides over the surface,
///
///   z = x - a along the surface,   T = k z + c s, not above friction N,   a' = s - (T - k z) / c.
///
/// While T is below its bound, a' is zero: a point that sticks does not creep. Beyond, the anchor follows,
/// and k |z| comes to friction N. Open points do not pull, and their anchors rest. Where one touches, and
/// only there, its anchor jumps to it (settle): steps end on that instant.
///
/// T s is lost in the ledger, what the spring holds with it, which is friction N hold / 2 of a point at most.
struct Contact {
  static constexpr const char* kind = "contact";
  static constexpr bool own_pace = true;  // it strikes
  using Description = ContactDescription;

  /// A point at an instant, inertial axes.
  template <class T>
  struct Touch {
    T gap{1}, rate{0};  // m, and of the compression, m/s
    NormalForce<T> press;
    Vec3<T> lever, surface_lever;  // from the state points of both bodies
    Vec3<T> normal = Vec3<T>::Zero();
    Vec3<T> slip = Vec3<T>::Zero();       // velocity along the surface
    Vec3<T> shear = Vec3<T>::Zero();      // on the point
    Vec3<T> spring = Vec3<T>::Zero();     // z, axes of the surface
    Vec3<T> following = Vec3<T>::Zero();  // a', likewise
    Vec3<T> at = Vec3<T>::Zero();         // the point, from the place of the surface, likewise
    T square{0};                          // of k z + c s
    bool slides = false;                  // presses, and is not held by friction

    Vec3<T> force() const { return normal * press.total() + shear; }
  };

  Description d;
  ContactSurface surface;
  int body = 0, on = 0;
  std::vector<Vec3d> points;       // from the state point, body axes
  Vec3d center = Vec3d::Zero();    // of a ball about all points, likewise
  double radius = 0.0;             // of the ball
  double at_middle = 0.0;          // N, of the law that is described, at the middle of the surface
  Vec3d place = Vec3d::Zero();     // of the surface, from the state point of `on`, its axes
  Mat3d axes = Mat3d::Identity();  // likewise
  StateRange states;               // anchors, and what friction has taken, J

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names); }

  static Description example() {
    Description d;
    d.name = "load";
    d.body = "second";
    d.on = "third";
    d.points = {{0.3, -0.2, 0.4}, {0.5, 0.1, 9.0}};
    d.axes = Eigen::AngleAxisd(0.4, Vec3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    d.surface = "box";
    d.place = {7.0, -0.7, -2.6};
    d.size = {30.0, 29.0, 28.0};
    d.edge = 13.9;
    d.stiffness = 0.2;
    d.damping = 0.01;
    d.friction = 0.3;
    d.shear_stiffness = 3.0;
    d.shear_damping = 6.0;
    return d;
  }

  template <class Context>
  static Contact compile(const Description& d, Context& context) {
    Contact out;
    out.d = d;
    out.surface = d.shape();
    if (d.surface != "plane") out.at_middle = out.law(out.surface.thin());
    const Attachment surface = context.attach(d.on, d.place);
    out.on = surface.body;
    out.place = surface.point;
    out.axes = surface.axes * d.axes;
    for (const Vec3d& point : d.points) {
      const Attachment at = context.attach(d.body, point);
      out.body = at.body;
      out.points.push_back(at.point);
      out.center += at.point / static_cast<double>(d.points.size());
    }
    for (const Vec3d& point : out.points) out.radius = std::max(out.radius, (point - out.center).norm());
    if (d.friction == 0.0) return out;
    for (std::size_t i = 0; i < d.points.size(); ++i) {
      for (const char* axis : {"x", "y", "z"}) {
        const int at = context.state({out.point_name(i) + ".anchor_" + axis, "m", 0.0, d.hold});
        if (out.states.count++ == 0) out.states.first = at;
      }
    }
    const double weight = d.shear_stiffness * d.hold;
    context.state({d.name + ".friction_loss", "J", 0.0, weight * context.length_scale()});
    ++out.states.count;
    return out;
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return {on, body}; }

  /// "<contact>.1" and so on, as channels and events have it.
  std::string point_name(std::size_t i) const { return d.name + "." + std::to_string(i + 1); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    for (int i = 0; i < states.count; ++i) out.state_rates[states.first + i] = T(0);
    if (apart(in)) return;
    T loss(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Touch<T> now = touch(in, i);
      out.add_power(-now.press.viscous * now.rate);  // of a point that is torn off too, which does not press
      if (!(now.press.total() > T(0))) continue;
      const Vec3<T> force = now.force();
      out.wrench[idx(body)].add(force, now.lever);
      out.wrench[idx(on)].add(-force, now.surface_lever);
      if (states.count == 0) continue;
      for (int k = 0; k < 3; ++k) out.state_rates[anchor(i) + k] = now.following[k];
      const T taken = -now.shear.dot(now.slip);
      out.add_power(-taken);
      loss += taken;
    }
    if (states.count > 0) out.state_rates[states.first + states.count - 1] = loss;
  }

  template <class T>
  Touch<T> touch(const LoadInput<T>& in, std::size_t i) const {
    const auto &b = in.bodies[body], &s = in.bodies[on];
    Touch<T> out;
    out.lever = b.rotation * points[i].cast<T>();
    out.surface_lever = b.position + out.lever - s.position;
    out.at = local(s, out.surface_lever);
    const SurfaceDistance<T> found = surface.at<T>(out.at);
    out.gap = found.distance;
    const Mat3<T> turn = s.rotation * axes.cast<T>();
    out.normal = turn * found.normal;
    const Vec3<T> over = b.velocity + cross<T>(b.angular_velocity, out.lever) - s.velocity -
                         cross<T>(s.angular_velocity, out.surface_lever);
    out.rate = -out.normal.dot(over);
    out.slip = over + out.normal * out.rate;
    if (out.gap < T(0)) out.press = hunt_crossley<T>(elastic<T>(-out.gap), d.damping, out.rate);
    out.slides = out.press.total() > T(0);
    if (states.count > 0) rub(in, i, found.normal, turn, out);
    return out;
  }

  double potential(const LoadInput<double>& in) const {
    if (apart(in)) return 0.0;
    double out = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double p = -touch(in, i).gap;
      if (p > 0.0) out += stored(p);
    }
    return out;
  }

  /// Of each point, whether it is closed, and whether it is free: not held by friction, or open and outside
  /// the surface, not torn off inside it.
  Side side(const LoadInput<double>& in) const {
    if (!apart(in)) return margins(in).side();
    Side out;
    for (std::size_t i = 0; i < points.size(); ++i) out.set(free(i));
    return out;
  }
  double across(const LoadInput<double>& in, const Side& from, const Side& to) const {
    return margins(in).across(from, to);
  }

  /// Points that do not press: those of a ball about all of them while that is outside. One that is torn off
  /// is at the surface.
  Sight look(const LoadInput<double>& in) const {
    const auto &b = in.bodies[body], &s = in.bodies[on];
    const Vec3d lever = b.rotation * center, ball = b.position + lever - s.position;
    const Vec3d over =
        b.velocity + b.angular_velocity.cross(lever) - s.velocity - s.angular_velocity.cross(ball);
    Sight out{.side = side(in),
              .pace = over.norm() + (b.angular_velocity - s.angular_velocity).norm() * radius,
              .thin = surface.thin(),
              .strikes = true,
              .at = axes.transpose() * (s.rotation.transpose() * ball - place)};
    const double apart = surface.at<double>(out.at).distance - radius;
    for (std::size_t i = 0; i < points.size(); ++i) {
      out.presses = out.presses || out.side[closed(i)];
      if (out.side[closed(i)]) continue;
      out.watched.set(closed(i));
      out.clear = std::min(out.clear, apart > 0.0 ? apart : std::max(0.0, touch(in, i).gap));
    }
    return out;
  }

  /// What a change of the side is, point by point.
  std::vector<Happening> happened(const LoadInput<double>& in, const Side& from, const Side& to) const {
    std::vector<Happening> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool is_closed = to[closed(i)];
      if (is_closed != from[closed(i)]) {
        const double speed = is_closed ? std::max(touch(in, i).rate, 0.0) : 0.0;
        out.push_back({point_name(i), is_closed ? "contact" : "release", speed});
      } else if (states.count > 0 && is_closed && to[free(i)] != from[free(i)]) {
        out.push_back({point_name(i), to[free(i)] ? "slip" : "stick"});
      }
    }
    return out;
  }

  /// Whether a point touches where the side changes, and its anchor jumps.
  bool jumps(const Side& from, const Side& to) const {
    if (states.count == 0) return false;
    bool out = false;
    for (std::size_t i = 0; i < points.size(); ++i) out = out || (to[closed(i)] && !from[closed(i)]);
    return out;
  }

  /// Writes the anchors of points that may not have one yet, among the states of all loads: of those that are
  /// open at `side`, or, where no side is known, of those whose spring is longer than friction allows.
  void settle(const LoadInput<double>& in, const std::optional<Side>& side, double* all_states) const {
    if (states.count == 0) return;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Touch<double> now = touch(in, i);
      const double longest = kLongest * d.friction * now.press.total() / d.shear_stiffness;
      const bool held = side ? (*side)[closed(i)] : now.spring.norm() <= longest;
      if (!held) view<3>(all_states + anchor(i)) = now.at;
    }
  }

  /// Throws where a point starts deep inside the surface, pressed beyond what its body weighs, N by body.
  void check_start(const LoadInput<double>& in, const std::vector<double>& weights) const {
    const std::size_t of = idx(body) < weights.size() ? idx(body) : idx(on);
    const double share = weights[of] / static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Touch<double> now = touch(in, i);
      if (-now.gap <= kDeep || now.press.elastic <= kCrushed * share) continue;
      throw SceneError("contact '" + d.name + "': point " + std::to_string(i + 1) + " of '" + d.body +
                       "' starts " + to_text(-now.gap) + " m inside '" + d.on +
                       "', where it is pressed out with " + to_text(now.press.elastic) +
                       " N; move the body out, turn the axis of the surface, or correct its place");
    }
  }

 private:
  static constexpr double kDeep = 0.1;      // m, that a point may start inside
  static constexpr double kCrushed = 10.0;  // times its share of the weight, that presses it there
  static constexpr double kLeast = 1e-6;    // of that quarter
  static constexpr double kLongest = 1.5;   // of the spring of a point that slides, in a state that is given

  static std::size_t closed(std::size_t i) { return 2 * i; }
  static std::size_t free(std::size_t i) { return 2 * i + 1; }
  int anchor(std::size_t i) const { return states.first + 3 * static_cast<int>(i); }

  /// A point from the state point of `on`, in axes of the surface.
  template <class T>
  Vec3<T> local(const BodyKinematics<T>& s, const Vec3<T>& lever) const {
    return axes.transpose().cast<T>() * (s.rotation.transpose() * lever - place.cast<T>());
  }

  /// Whether the ball about all points is.
  template <class T>
  bool apart(const LoadInput<T>& in) const {
    const auto &b = in.bodies[body], &s = in.bodies[on];
    const Vec3<T> ball = b.position + b.rotation * center.cast<T>() - s.position;
    return surface.at<T>(local<T>(s, ball)).distance > T(radius);
  }

  /// Elastic force at a compression. From half of the way to its middle a surface stiffens, without a bound
  /// at three quarters: what comes in by one face is not pressed out by another, and passes no axis.
  template <class T>
  T elastic(const T& p) const {
    const T left = left_to_core(p), gone = T(1) - left, given = law(p);
    if (!(gone > T(0))) return given;
    return given + T(at_middle) * gone * gone * gone / (left * left);
  }
  /// What that stiffening has stored.
  double stored_beyond_half(double p) const {
    const double left = left_to_core(p);
    if (!(left < 1.0)) return 0.0;
    const double sum = 1.5 + 1.0 / left + 3.0 * std::log(left) - 3.0 * left + 0.5 * left * left;
    return 0.25 * surface.thin() * at_middle * sum;
  }
  /// 1 at half of the way to the middle, 0 at three quarters of it, more nearer to the face.
  template <class T>
  T left_to_core(const T& p) const {
    const T out = T(3) - p * T(4.0 / surface.thin());
    return out < T(kLeast) ? T(kLeast) : out;
  }

  /// What is described: beyond the table its last slope goes on.
  template <class T>
  T law(const T& p) const {
    if (d.forces.empty()) return T(d.stiffness) * p;
    const std::size_t i = piece(p);
    return T(d.forces[i]) + T(slope(i)) * (p - T(d.compressions[i]));
  }
  double stored(double p) const {
    double out = stored_beyond_half(p);
    if (d.forces.empty()) return out + 0.5 * d.stiffness * p * p;
    const std::size_t last = piece(p);
    for (std::size_t i = 0; i <= last; ++i) {
      const double x = (i == last ? p : d.compressions[i + 1]) - d.compressions[i];
      out += x * (d.forces[i] + 0.5 * slope(i) * x);
    }
    return out;
  }
  template <class T>
  std::size_t piece(const T& p) const {
    std::size_t i = 0;
    while (i + 2 < d.compressions.size() && p >= T(d.compressions[i + 1])) ++i;
    return i;
  }
  double slope(std::size_t i) const {
    return (d.forces[i + 1] - d.forces[i]) / (d.compressions[i + 1] - d.compressions[i]);
  }

  template <class T>
  void rub(const LoadInput<T>& in, std::size_t i, const Vec3<T>& normal, const Mat3<T>& turn,
           Touch<T>& out) const {
    for (int k = 0; k < 3; ++k) out.spring[k] = out.at[k] - in.states[anchor(i) + k];
    out.spring -= normal * normal.dot(out.spring);
    const Vec3<T> slip = turn.transpose() * out.slip;
    const Vec3<T> pull = out.spring * T(d.shear_stiffness) + slip * T(d.shear_damping);
    const auto held = bristle_friction<T, 3>(pull, T(d.friction) * out.press.total(), d.shear_damping);
    out.square = pull.squaredNorm();
    out.slides = out.slides && held.slides;
    out.following = held.follow;
    out.shear = -(turn * held.force);
  }

  /// Two of each point: how far it is open, and what friction could hold beyond what it is asked for; where
  /// there is none, or nothing is held, how far the point is inside.
  Margins margins(const LoadInput<double>& in) const {
    Margins out;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Touch<double> now = touch(in, i);
      const double open = std::max(now.gap, -1.0 - d.damping * now.rate);
      const double spare = d.friction * now.press.total() - std::sqrt(now.square);
      out.add({nullptr, open});
      out.add({nullptr, states.count > 0 && !(open > 0.0) ? spare : -now.gap});
    }
    return out;
  }
};

}  // namespace seacrane
