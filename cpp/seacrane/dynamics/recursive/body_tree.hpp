#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/dynamics/recursive/strut.hpp"
#include "seacrane/elements/joint_coordinate.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// A body moved by a cluster's own speeds.
struct Member {
  int body = -1;
  int column = 0;     // first of its columns, one per speed
  bool leaf = false;  // compact, and carries no cluster: a mass and an inertia about its centre of mass
};

/// The drivers that prescribe all coordinates of a cluster: one that of its joint, or the stroke of one of
/// its struts; or six those of a floating body over the ground, x, y, z, roll, pitch, yaw.
struct Drive {
  std::vector<int> drivers;  // of the model; none: the cluster is free
  int strut = -1;
  double sign = 1.0;  // of the driver's coordinate over the tree's
};

/// Bodies that move together over one parent: one body of a tree joint, with the struts across a hinge, or
/// a body that floats freely (no parent, six speeds).
struct Cluster {
  static constexpr std::size_t floating = static_cast<std::size_t>(-1);
  std::size_t kind = floating;  // of the joint, index in JointTypes
  TreeJoint joint;
  int parent = -1, body = -1;  // indices; ground = body count
  int q = 0, u = 0;            // offsets in positions and speeds
  int positions = 7, speeds = 6;
  int element = -1;  // the joint
  int first_strut = 0, struts = 0;
  Drive drive;
  std::vector<Member> members;  // the joint's child first

  bool is_driven() const { return !drive.drivers.empty(); }
};

/// Floating clusters of one group, between whose bodies the mass matrix has blocks.
struct CoupledRoots {
  std::size_t group = 0;              // of the model
  std::vector<std::size_t> clusters;  // by place in the group
};

/// A spanning tree of clusters, parents before children, and the elements left for constraint rows.
struct BodyTree {
  std::vector<Cluster> clusters;
  std::vector<Strut> struts;
  std::vector<CoupledRoots> coupled;
  std::string refused;     // why the mass matrix of a group does not fit the tree; empty: it does
  std::vector<int> loops;  // elements with rows that no branch stands for: cut joints and other drivers
  int positions = 0, speeds = 0, columns = 0;
  int driven = 0;  // of the speeds
  int loop_rows = 0;

  /// Typical magnitude of every position, then of every speed.
  std::vector<double> scales(double length, double angle) const;
};

/// Joints with the most rows become branches first, and of these such that a driver moves; a joint type
/// without a branch is left to rows. Struts are found wherever their pattern occurs.
BodyTree build_tree(const Model& model);

/// The tree of every body, by the order of its root; -1: the ground's. Trees whose roots are coupled are
/// one.
std::vector<int> roots_of(const BodyTree& tree, int bodies);

/// The clusters whose joints hold one direction.
std::vector<std::size_t> links_of(const BodyTree& tree);

/// Calls f(place in the positions) for every quaternion.
template <class F>
void for_each_quaternion(const BodyTree& tree, F&& f) {
  for (const Cluster& c : tree.clusters) {
    const int first = c.kind == Cluster::floating ? 3 : 0;
    for (int i = first; i + 4 <= c.positions; i += 4) f(c.q + i);
  }
}

/// Departure of |q|^2 from one at which a quaternion is normalised: its length drifts by truncation only,
/// and rotations do not depend on it.
inline constexpr double kQuaternionDrift = 1e-3;

/// Normalises four numbers beyond that; whether it did.
template <class Quaternion>
bool normalise_drifted(Quaternion&& q) {
  const double squared = q.squaredNorm();
  if (std::abs(squared - 1.0) <= kQuaternionDrift) return false;
  q /= std::sqrt(squared);
  return true;
}

/// A joint coordinate that is one of a tree: the angle of a hinge, the way of a slide, the stroke of a strut.
struct TreeCoordinate {
  std::size_t cluster = 0;
  int q = 0, u = 0;
  int strut = -1;     // -1: the coordinate is that of the joint itself
  double sign = 1.0;  // of the joint's coordinate over the tree's
};

/// Where a tree has the coordinate, if it has.
std::optional<TreeCoordinate> find_coordinate(const CoordinateData& coordinate, const BodyTree& tree);

}  // namespace seacrane
