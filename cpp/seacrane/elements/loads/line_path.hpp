#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "seacrane/elements/loads/line_tangent.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/with_rate.hpp"

namespace seacrane {

/// A point of a line's path on its compiled body, or a sheave there.
struct PathPoint {
  int body = 0;
  Vec3d point;                    // from the state point, body axes; of a sheave its centre
  double radius = 0.0;            // m, of a sheave; 0: a point
  Vec3d axis = Vec3d::Zero();     // body axes, of length one; the line runs about it by the right hand
  double turned = 0.0;            // rad: whole turns on it besides
  double grip = 0.0, drag = 0.0;  // mu, and -log(efficiency)

  bool at_state = false;  // no sheave, and its body's own, as every node of a line with mass

  bool rubs() const { return grip > 0.0 || drag > 0.0; }
  bool turns_line() const { return radius > 0.0 || rubs(); }
};

/// A section of a line, from one point of its path to the next with half of the arcs on both sheaves. `pull`
/// and `turning` are the gradient of the path's length from a mark on the first sheave to one on the second.
template <class T>
struct PathSection {
  int first = 0, second = 0;  // bodies
  Vec3<T> lever_first, lever_second, along, pull, turning_first, turning_second;
  T length, rate;  // the rate is that of the length between the marks
  T swing;         // of that rate's own, what moving makes; between sheaves see LinePath::swing
  T wrap;          // rad, on the sheave at its second end
  bool turns = false, moves = true;
  // For the sheave at its second end: by what the rope is held, and the larger fleet angle, rad.
  double hold = std::numeric_limits<double>::infinity(), fleet = 0.0;

  /// Adds the wrenches of a tension in this section.
  void add_to(BodyLoad<T>* wrench, const T& tension) const { add_to(wrench[first], wrench[second], tension); }
  void add_to(BodyLoad<T>& on_first, BodyLoad<T>& on_second, const T& tension) const {
    if (!moves) return;
    const Vec3<T> force = pull * tension;
    on_first.add(force, lever_first);
    const Vec3<T> back = -force;
    on_second.add(back, lever_second);
    if (!turns) return;
    on_first.moment -= turning_first * tension;
    on_second.moment -= turning_second * tension;
  }
  void add_to(Vec6d* wrench, double tension) const requires std::is_same_v<T, double> {
    if (!moves) return;
    const Vec3d force = tension * pull;
    wrench[first] += (Vec6d() << force, lever_first.cross(force)).finished();
    wrench[second] -= (Vec6d() << force, lever_second.cross(force)).finished();
    if (!turns) return;
    wrench[first].tail<3>() -= tension * turning_first;
    wrench[second].tail<3>() -= tension * turning_second;
  }
  /// Rate of `rate`, for accelerations of the points of both bodies that are at the levers, and of the
  /// bodies' angular velocities.
  T rate_change(const Vec3<T>& at_first, const Vec3<T>& at_second, const Vec3<T>& turn_first,
                const Vec3<T>& turn_second) const {
    if (!moves) return T(0);
    const Vec3<T> apart = at_second - at_first;
    T out = pull.dot(apart) + swing;
    if (turns) out += turning_first.dot(turn_first) + turning_second.dot(turn_second);
    return out;
  }
};

/// An ordered path over points and sheaves of bodies. A part between two points of one body is rigid.
class LinePath {
 public:
  static constexpr double kWidest = 4.6;   // rad, of a wrap beside its whole turns
  static constexpr double kTurned = -1.4;  // rad, the least one beside whole turns

  LinePath() = default;
  explicit LinePath(std::vector<PathPoint> points) : points_(std::move(points)) {
    for (PathPoint& p : points_) p.at_state = p.radius == 0.0 && p.point.isZero(0.0);
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
      rigid_.push_back(rigid(points_[i], points_[i + 1]));
    }
  }

  const std::vector<PathPoint>& points() const { return points_; }
  bool is_one_section() const { return points_.size() == 2; }
  bool has_friction() const {
    return std::any_of(points_.begin(), points_.end(), [](const PathPoint& p) { return p.rubs(); });
  }

  /// Calls f(section, i) for each section in order, i being the place of its second end in the path.
  template <class T, class F>
  void for_each_section(const LoadInput<T>& in, F&& f) const {
    std::array<PathSection<T>, 2> sections;
    std::array<Place<T>, 2> places;
    Radii<T> radii{Vec3<T>::Zero(), Vec3<T>::Zero()};
    place<T>(in, points_[0], places[0]);
    for (std::size_t i = 1; i < points_.size(); ++i) {
      PathSection<T>&before = sections[(i - 1) % 2], &now = sections[i % 2];
      const Place<T>& from = places[(i - 1) % 2];
      place<T>(in, points_[i], places[i % 2]);
      const Vec3<T> arrived = radii.in;
      fill<T>(in, i, from, places[i % 2], now, radii);
      if (i == 1) continue;
      if (points_[i - 1].radius > 0.0) join<T>(points_[i - 1], from.axis, arrived, radii.out, before, now);
      f(before, i - 1);
    }
    f(sections[(points_.size() - 1) % 2], points_.size() - 1);
  }

  /// The section of a path between two points.
  template <class T>
  void lay_only(const LoadInput<T>& in, PathSection<T>& section) const {
    Place<T> from, to;
    Radii<T> radii;
    place<T>(in, points_[0], from);
    place<T>(in, points_[1], to);
    fill<T>(in, 1, from, to, section, radii);
  }

  /// How the rate of section i between sheaves changes with the places alone, the velocities held.
  template <class T>
  T swing(const LoadInput<T>& in, std::size_t i) const {
    Place<T> from, to;
    place<T>(in, points_[i - 1], from);
    place<T>(in, points_[i], to);
    const Vec3<T>&turn_from = in.bodies[points_[i - 1].body].angular_velocity,
          &turn_to = in.bodies[points_[i].body].angular_velocity;
    const Tangent<WithRate<T>> line = tangent<WithRate<T>>(moving_end<T>(points_[i - 1], from, turn_from),
                                                           moving_end<T>(points_[i], to, turn_to));
    const Vec3<T> pull = value_of_each<T>(line.pull), pulled = rate_of<T>(line.pull);
    const Vec3<T> velocity = touching<T>(points_[i], to, turn_to, line.in) -
                             touching<T>(points_[i - 1], from, turn_from, line.out);
    const Vec3<T> gliding =
        glided<T>(points_[i], turn_to, line.in) - glided<T>(points_[i - 1], turn_from, line.out);
    return pulled.dot(velocity) + pull.dot(gliding) + rate_of<T>(line.turning_from).dot(turn_from) +
           rate_of<T>(line.turning_to).dot(turn_to);
  }

 private:
  /// The part between two points, if they are of one body and one is a sheave.
  struct Rigid {
    bool is = false;
    double length = 0.0;
    Vec3d out = Vec3d::Zero(), in = Vec3d::Zero(), along = Vec3d::Zero();  // body axes
  };
  /// A point of the path at an instant, inertial axes.
  template <class T>
  struct Place {
    Vec3<T> lever, center, rate, axis;
  };
  /// Radii of the sheaves where a section leaves the first and meets the second.
  template <class T>
  struct Radii {
    Vec3<T> out, in;
  };

  static Rigid rigid(const PathPoint& a, const PathPoint& b) {
    Rigid part;
    part.is = a.body == b.body && (a.radius > 0.0 || b.radius > 0.0);
    if (!part.is) return part;
    std::tie(part.out, part.in) =
        line_tangent::radii({a.radius, a.point, a.axis}, {b.radius, b.point, b.axis});
    const Vec3d apart = b.point + b.radius * part.in - a.point - a.radius * part.out;
    part.length = apart.norm();
    if (part.length > 0.0) part.along = apart / part.length;
    return part;
  }

  template <class T>
  static void place(const LoadInput<T>& in, const PathPoint& p, Place<T>& out) {
    const BodyKinematics<T>& k = in.bodies[p.body];
    if (p.at_state) {
      out.lever.setZero();
      out.center = k.position;
      out.rate = k.velocity;
      return;
    }
    out.lever = k.rotation * p.point.template cast<T>();
    out.center = k.position + out.lever;
    out.rate = k.velocity + cross<T>(k.angular_velocity, out.lever);
    if (p.radius > 0.0) out.axis = k.rotation * p.axis.template cast<T>();
  }

  template <class T>
  void fill(const LoadInput<T>& in, std::size_t i, const Place<T>& from, const Place<T>& to,
            PathSection<T>& s, Radii<T>& radii) const {
    const PathPoint &a = points_[i - 1], &b = points_[i];
    s.turns = false;
    s.moves = true;
    s.rate = s.swing = s.wrap = T(0);
    s.hold = std::numeric_limits<double>::infinity();
    s.fleet = 0.0;
    s.first = a.body;
    s.second = b.body;
    s.lever_first = from.lever;
    s.lever_second = to.lever;
    if (rigid_[i - 1].is) {
      carry<T>(in.bodies[a.body].rotation, rigid_[i - 1], s, radii);
    } else if (a.radius > 0.0 || b.radius > 0.0) {
      lay<T>(in, end<T>(a, from), end<T>(b, to), from, to, s, radii);
    } else {
      stretch<T>(from, to, s);
    }
  }

  template <class T>
  static TangentEnd<T> end(const PathPoint& p, const Place<T>& at) {
    return {p.radius, at.center, p.radius > 0.0 ? at.axis : Vec3<T>(Vec3<T>::Zero())};
  }

  template <class T>
  static TangentEnd<WithRate<T>> moving_end(const PathPoint& p, const Place<T>& at, const Vec3<T>& turning) {
    const Vec3<T> axis = p.radius > 0.0 ? at.axis : Vec3<T>(Vec3<T>::Zero());
    return {p.radius, with_rate<T>(at.center, at.rate), with_rate<T>(axis, cross<T>(turning, axis))};
  }
  /// Velocity of the point of a body that is where the line touches it.
  template <class T>
  static Vec3<T> touching(const PathPoint& p, const Place<T>& at, const Vec3<T>& turning,
                          const Vec3<WithRate<T>>& radius) {
    const Vec3<T> arm = value_of_each<T>(radius) * T(p.radius);
    return at.rate + cross<T>(turning, arm);
  }
  /// What gliding along the rim adds to the rate of that velocity.
  template <class T>
  static Vec3<T> glided(const PathPoint& p, const Vec3<T>& turning, const Vec3<WithRate<T>>& radius) {
    const Vec3<T> n = value_of_each<T>(radius);
    const Vec3<T> glides = (rate_of<T>(radius) - cross<T>(turning, n)) * T(p.radius);
    return cross<T>(turning, glides);
  }

  template <class T>
  static void carry(const Mat3<T>& rotation, const Rigid& part, PathSection<T>& s, Radii<T>& radii) {
    s.moves = false;
    s.length = T(part.length);
    s.pull.setZero();
    s.along = rotation * part.along.template cast<T>();
    radii = {rotation * part.out.template cast<T>(), rotation * part.in.template cast<T>()};
  }

  /// Between two points; without length it has no direction.
  template <class T>
  static void stretch(const Place<T>& from, const Place<T>& to, PathSection<T>& s) {
    using std::sqrt;
    const Vec3<T> apart = to.center - from.center, rate = to.rate - from.rate;
    const T square = apart.dot(apart);
    const bool has_direction = square > T(0);
    s.length = has_direction ? T(sqrt(square)) : T(0);
    s.along = has_direction ? Vec3<T>(apart / s.length) : Vec3<T>(Vec3<T>::Zero());
    s.pull = s.along;
    s.rate = s.along.dot(rate);
    s.swing = has_direction ? T((rate.dot(rate) - s.rate * s.rate) / s.length) : T(0);
  }

  /// Between two ends of which one is a sheave.
  template <class T>
  static void lay(const LoadInput<T>& in, const TangentEnd<T>& a, const TangentEnd<T>& b,
                  const Place<T>& from, const Place<T>& to, PathSection<T>& s, Radii<T>& radii) {
    const Tangent<T> line = tangent<T>(a, b);
    const Vec3<T> first = line.out * T(a.radius), second = line.in * T(b.radius);
    const Vec3<T>&turn_first = in.bodies[s.first].angular_velocity,
          &turn_second = in.bodies[s.second].angular_velocity;
    s.turns = true;
    s.length = line.length;
    s.along = line.along;
    s.pull = line.pull;
    s.turning_first = line.turning_from;
    s.turning_second = line.turning_to;
    s.lever_first += first;
    s.lever_second += second;
    const Vec3<T> rate = to.rate + cross<T>(turn_second, second) - from.rate - cross<T>(turn_first, first);
    s.rate = s.pull.dot(rate) + s.turning_first.dot(turn_first) + s.turning_second.dot(turn_second);
    s.hold = line_tangent::clearance(line_tangent::plain(a), line_tangent::plain(b));
    radii = {line.out, line.in};
  }

  /// Two sections over the sheave between them.
  template <class T>
  static void join(const PathPoint& sheave, const Vec3<T>& axis, const Vec3<T>& arrives,
                   const Vec3<T>& leaves, PathSection<T>& before, PathSection<T>& after) {
    const T angle = angle_about<T>(axis, arrives, leaves);
    before.wrap = angle + T(sheave.turned);
    const T half = T(0.5 * sheave.radius) * before.wrap;
    before.length += half;
    after.length += half;
    const double least = sheave.turned > 0.0 ? kTurned : 0.0;
    const double held = std::min(value_of(angle) - least, kWidest - value_of(angle));
    before.hold = std::min({held, before.hold, after.hold});
    const double leaning =
        std::max(std::abs(value_of(T(axis.dot(before.along)))), std::abs(value_of(T(axis.dot(after.along)))));
    before.fleet = std::asin(std::min(leaning, 1.0));
  }

  std::vector<PathPoint> points_;
  std::vector<Rigid> rigid_;
};

}  // namespace seacrane
