#pragma once

#include <vector>

#include "seacrane/model/description.hpp"

namespace seacrane {

/// Where a described body sits on the compiled body that carries it: origin and axes of its frame in the
/// carrier's.
struct Placement {
  int body = 0;  // the carrier among the compiled bodies; ground = their count
  Vec3d origin = Vec3d::Zero();
  Mat3d axes = Mat3d::Identity();

  Vec3d point(const Vec3d& p) const { return origin + axes * p; }
};

/// Two described bodies that never move relative to each other: the second's frame in the first's; ground =
/// their count.
struct RigidLink {
  int first = 0, second = 0;
  Vec3d origin;
  Mat3d axes;
};

/// Bodies that never move relative to each other, as one. The carrier's frame is that of the vessel among
/// them, else of the ground, else of the body described first.
struct MergePlan {
  std::vector<Placement> places;    // of the described bodies, in their order
  std::vector<int> carriers;        // described body whose frame a compiled body has
  std::vector<std::string> locked;  // drivers that hold the coordinate of their joint still

  bool merges() const { return carriers.size() < places.size(); }
};

/// Every body by itself.
MergePlan no_merge(const SceneDescription& scene);

/// Merges across welds, across hinges and slides whose coordinate a driver holds at a constant value, and
/// what such drivers lock around loops (compile/locked_loops.hpp). Two vessels, or a vessel and the ground,
/// stay apart; so does a scene in the paper's kinematics, and one in which nothing would be left to move.
MergePlan plan_merge(const SceneDescription& scene, const std::vector<RigidLink>& loops);

}  // namespace seacrane
