#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "seacrane/elements/joint_coordinate.hpp"
#include "seacrane/model/description.hpp"

namespace seacrane {

inline constexpr int kMostLimits = 64;

/// A kind of limit, and what the engine asks of it.
struct LimitKind {
  const char* name;
  const char* joint;   // that it takes; empty: any, of which it bounds a coordinate
  bool of_coordinate;  // where it holds, it is a driver at its bound; else its joint, which is open elsewhere
  bool closes_again;   // has a gap and an impact; else it stays open once it lets go, and pushes over an area
};
/// Every kind that the engine has.
const std::vector<LimitKind>& limit_kinds();

/// Which limits hold, one bit each: the discrete part of the state.
using ClosedSet = std::uint64_t;
constexpr ClosedSet bit_of(int limit) { return ClosedSet{1} << limit; }
constexpr bool holds(ClosedSet closed, int limit) { return (closed & bit_of(limit)) != 0; }

/// One bound. Open: side * gap >= 0; closed: side * multiplier >= 0 (wire and stop).
struct Limit {
  std::string name;
  const LimitKind* kind = nullptr;
  int joint = 0;                    // among the described joints
  CoordinateDescription described;  // of a stop
  CoordinateData coordinate;        // its data; of a wire or seat only the joint's
  double bound = 0.0;               // of the coordinate, or the length of a wire
  double side = 1.0;                // 1: the coordinate stays above the bound
  double restitution = 0.0, sticking_speed = 0.0;
  double reach = 0.0;  // m, of a seat: half the diagonal of a box with the second body's inertia
  int element = -1;    // where it holds: its element in the model of that set
};

/// Names of the limits that hold, and the set of those named. Throws std::invalid_argument for a name that
/// is not there.
std::vector<std::string> names_of(const std::vector<Limit>& limits, ClosedSet closed);
ClosedSet set_of(const std::vector<Limit>& limits, const std::vector<std::string>& names);

/// Distance from the bound, its row of D, its rate: as a driver at the bound would have them.
CoordinateRow<double> evaluate_limit(const Limit& limit, const BodyKinematics<double>* bodies);

/// The second body's point of a seat from the first's, along the axes of the joint there.
Vec3d offset_of_seat(const Limit& limit, const BodyKinematics<double>* bodies);

/// Checks the limits of a scene whose joints, drivers and names have been checked.
void check_limits(const SceneDescription& scene, const SceneNames& names);
/// One entry per bound, in the order described, without the data of coordinates.
std::vector<Limit> list_limits(const SceneDescription& scene);
/// Limits that hold at the described poses: seats, and wires that are not shorter than their length.
ClosedSet described_set(const SceneDescription& scene, const std::vector<Limit>& limits);
/// The scene with the rows of the given set only: other wires and seats are left open, closed stops are
/// drivers at their bound, after the described ones.
SceneDescription scene_of(const SceneDescription& scene, const std::vector<Limit>& limits, ClosedSet closed);

}  // namespace seacrane
