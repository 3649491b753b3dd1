#include "seacrane/model/limit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/joints/distance.hpp"
#include "seacrane/elements/joints/weld.hpp"
#include "seacrane/math/rotation.hpp"
#include "seacrane/model/description.hpp"

namespace seacrane {
namespace {

constexpr double kTaut = 1e-6;     // relative to its length: a described wire this short is stretched
constexpr double kInwards = 1e-9;  // m/s
constexpr double kTurn = std::numbers::pi;

const LimitKind& kind_of(const Check& c, const LimitDescription& d) {
  std::string known;
  for (const LimitKind& kind : limit_kinds()) {
    if (d.kind == kind.name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(kind.name);
  }
  c.fail("kind '" + d.kind + "' is unknown; choose one of " + known);
}

const JointDescription* find_joint(const SceneDescription& scene, const std::string& name) {
  const auto found = std::find_if(scene.joints.begin(), scene.joints.end(),
                                  [&](const JointDescription& j) { return j.name == name; });
  return found == scene.joints.end() ? nullptr : &*found;
}

bool turns(const std::string& coordinate) {
  return coordinate == "angle" || coordinate == "roll" || coordinate == "pitch" || coordinate == "yaw";
}

void check_stop(const Check& c, const SceneDescription& scene, const LimitDescription& d) {
  const bool low = d.minimum > -kNoStop, high = d.maximum < kNoStop;
  if (!low && !high) c.fail("has neither minimum nor maximum; give at least one");
  if (!(d.minimum < d.maximum)) {
    c.fail("minimum is " + to_text(d.minimum) + " and maximum " + to_text(d.maximum) +
           "; the minimum must be below the maximum");
  }
  if (turns(d.coordinate.coordinate)) {
    if (!low || !high || d.minimum <= -kTurn || d.maximum >= kTurn) {
      c.fail("bounds of an angle are " + to_text(d.minimum) + " and " + to_text(d.maximum) +
             " rad; give both, between -pi and pi: the other way round would reach them too");
    }
  }
  for (const auto& driver : scene.drivers) {
    if (driver.coordinate.joint == d.coordinate.joint &&
        driver.coordinate.coordinate == d.coordinate.coordinate) {
      c.fail("driver '" + driver.name + "' prescribes " + d.coordinate.joint + "." + d.coordinate.coordinate +
             ", which no stop can hold; remove one of them");
    }
  }
}

void check_joint_limit(const Check& c, const SceneDescription& scene, const LimitDescription& d,
                       const std::string& kind) {
  const JointDescription* joint = find_joint(scene, d.coordinate.joint);
  if (!joint) c.fail("there is no joint '" + d.coordinate.joint + "'; add it first");
  if (joint->kind != kind) {
    c.fail("joint '" + joint->name + "' is " + joint->kind + "; a " + d.kind + " takes a " + kind + " joint");
  }
}

double length_of(const JointDescription& distance) { return distance.parameters.at("length"); }

struct Point {
  Vec3d position, velocity;
};

/// A joint's point at the described pose of its body.
Point described_point(const SceneDescription& scene, const std::string& body, const Frame& frame) {
  for (const BodyDescription& b : scene.bodies) {
    if (b.name != body) continue;
    const Vec3d lever = rotation_from_quaternion<double>(b.quaternion.normalized()) * frame.point;
    return {b.position + lever, b.velocity + b.angular_velocity.cross(lever)};
  }
  return {frame.point, Vec3d::Zero()};
}

/// Half the diagonal of the box that has a body's mass and inertia.
double half_diagonal(const SceneDescription& scene, const std::string& body) {
  const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                  [&](const BodyDescription& b) { return b.name == body; });
  return found == scene.bodies.end() ? 0.0 : std::sqrt(1.5 * found->inertia.trace() / found->mass);
}

bool stretched(const SceneDescription& scene, const JointDescription& joint) {
  const Point a = described_point(scene, joint.first, joint.first_frame),
              b = described_point(scene, joint.second, joint.second_frame);
  const Vec3d d = b.position - a.position;
  const double length = d.norm();
  if (!(length >= length_of(joint) * (1.0 - kTaut))) return false;
  return d.dot(b.velocity - a.velocity) >= -kInwards * length;
}

}  // namespace

const std::vector<LimitKind>& limit_kinds() {
  static const std::vector<LimitKind> kinds = {
      {"wire", Distance::kind, false, true}, {"stop", "", true, true}, {"seat", Weld::kind, false, false}};
  return kinds;
}

std::vector<std::string> names_of(const std::vector<Limit>& limits, ClosedSet closed) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (holds(closed, static_cast<int>(i))) out.push_back(limits[i].name);
  }
  return out;
}

ClosedSet set_of(const std::vector<Limit>& limits, const std::vector<std::string>& names) {
  ClosedSet out = 0;
  for (const std::string& name : names) {
    const auto at =
        std::find_if(limits.begin(), limits.end(), [&](const Limit& limit) { return limit.name == name; });
    if (at == limits.end()) {
      throw std::invalid_argument("state: limit '" + name +
                                  "' holds, which this scene does not have; give a state of this scene");
    }
    out |= bit_of(static_cast<int>(at - limits.begin()));
  }
  return out;
}

CoordinateRow<double> evaluate_limit(const Limit& limit, const BodyKinematics<double>* bodies) {
  const JointData& joint = limit.coordinate.joint;
  const BodyKinematics<double>&ka = bodies[joint.first], &kb = bodies[joint.second];
  if (limit.kind->of_coordinate) {
    CoordinateRow<double> row = evaluate_coordinate<double>(limit.coordinate, ka, kb);
    row.value -= limit.bound;
    return row;
  }
  RowBlock<double> block;
  rows::distance<double>(JointGeometry<double>(joint, ka, kb), limit.bound, block, 0);
  return {block.phi[0], block.d[0].row(0).transpose(), block.d[1].row(0).transpose(), block.gamma[0]};
}

Vec3d offset_of_seat(const Limit& limit, const BodyKinematics<double>* bodies) {
  const JointData& joint = limit.coordinate.joint;
  const JointGeometry<double> g(joint, bodies[joint.first], bodies[joint.second]);
  return g.a.transpose() * g.d;
}

void check_limits(const SceneDescription& scene, const SceneNames& names) {
  std::map<std::string, std::string> held;
  int count = 0;
  for (const LimitDescription& d : scene.limits) {
    const Check c("limit", d.name);
    check_fields(d, c);
    const LimitKind& kind = kind_of(c, d);
    if (kind.of_coordinate) {
      names.coordinate(c, d.coordinate);
      check_stop(c, scene, d);
    } else {
      check_joint_limit(c, scene, d, kind.joint);
    }
    const std::string what = d.coordinate.joint + "." + (kind.of_coordinate ? d.coordinate.coordinate : "");
    const auto [other, fresh] = held.insert({what, d.name});
    if (!fresh) c.fail("limits what limit '" + other->second + "' limits already; remove one of them");
    count += kind.of_coordinate ? (d.minimum > -kNoStop) + (d.maximum < kNoStop) : 1;
  }
  const Check c("scene", scene.name);
  if (count > kMostLimits) {
    c.fail("has " + std::to_string(count) + " bounds, wires and seats that may open and close; at most " +
           std::to_string(kMostLimits) + " are kept apart, use soft stops for the others");
  }
  if (scene.limits.empty() || !paper_vessel(scene)) return;
  c.fail(
      "kinematics 'paper' have no symmetric mass matrix, in which impacts would keep momentum; use "
      "'yaw_following' with limits");
}

std::vector<Limit> list_limits(const SceneDescription& scene) {
  std::vector<Limit> out;
  for (const LimitDescription& d : scene.limits) {
    Limit limit;
    limit.name = d.name;
    limit.joint = static_cast<int>(find_joint(scene, d.coordinate.joint) - scene.joints.data());
    limit.described = d.coordinate;
    limit.restitution = d.restitution;
    limit.sticking_speed = d.sticking_speed;
    limit.kind = &kind_of(Check("limit", d.name), d);
    if (!limit.kind->of_coordinate) {
      const JointDescription& joint = scene.joints[idx(limit.joint)];
      if (limit.kind->closes_again) {
        limit.bound = length_of(joint);
      } else {
        limit.reach = half_diagonal(scene, joint.second);
      }
      limit.side = -1.0;
      out.push_back(limit);
      continue;
    }
    const bool both = d.minimum > -kNoStop && d.maximum < kNoStop;
    for (const double side : {1.0, -1.0}) {
      limit.side = side;
      limit.bound = side > 0.0 ? d.minimum : d.maximum;
      limit.name = d.name + (!both ? "" : (side > 0.0 ? ".minimum" : ".maximum"));
      if (std::abs(limit.bound) < kNoStop) out.push_back(limit);
    }
  }
  return out;
}

ClosedSet described_set(const SceneDescription& scene, const std::vector<Limit>& limits) {
  ClosedSet closed = 0;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const Limit& limit = limits[i];
    const bool holds_here = !limit.kind->closes_again ||
                            (!limit.kind->of_coordinate && stretched(scene, scene.joints[idx(limit.joint)]));
    if (holds_here) closed |= bit_of(static_cast<int>(i));
  }
  return closed;
}

SceneDescription scene_of(const SceneDescription& scene, const std::vector<Limit>& limits, ClosedSet closed) {
  SceneDescription out = scene;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const Limit& limit = limits[i];
    const bool here = holds(closed, static_cast<int>(i));
    if (!limit.kind->of_coordinate) {
      out.joints[idx(limit.joint)].open = !here;
    } else if (here) {
      out.drivers.push_back({limit.name, limit.described, Curve::constant(limit.bound)});
    }
  }
  return out;
}

}  // namespace seacrane
