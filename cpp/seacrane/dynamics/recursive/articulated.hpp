#pragma once

#include <memory>
#include <vector>

#include "seacrane/dynamics/recursive/body_tree.hpp"

namespace seacrane {

/// Forward dynamics of a tree of clusters by articulated-body inertias [R. Featherstone, Rigid Body Dynamics
/// Algorithms, 2008, chapter 7], with all quantities in inertial axes about the bodies' state points, and
/// several bodies that share the speeds of one cluster. Cost linear in the bodies; nothing is allocated after
/// construction. Scratch of one run.
class ArticulatedTree {
 public:
  ArticulatedTree(const BodyTree& tree, int bodies);

  /// Poses and twists of all bodies from positions q and speeds u; `bodies` ends with the ground.
  void place(const double* q, const double* u, BodyKinematics<double>* bodies);
  /// Rates of the positions for speeds u (which need not be those of place()) and the bodies' angular
  /// velocities that go with them.
  void position_rates(const double* q, const double* u, const BodyKinematics<double>* bodies,
                      double* q_rate) const;
  /// Positions and speeds of given poses and twists; what leaves the joints open is dropped.
  void read(const BodyKinematics<double>* bodies, double* q, double* u) const;

  /// Articulated inertias for the bodies' mass matrices (about state points), at the last place().
  void factor(const Mat6d* mass);
  /// Largest factor by which inertias cancelled in the last factor(mass), like S_ii / d_i of the redundant
  /// form, times that of the joints' own inertias: digits that joints between light and heavy bodies cost.
  /// Allocates; for reports.
  double condition(const Mat6d* mass) const;
  /// Accelerations of the bodies (ground last) and of the speeds under `load`, wrench less M-independent
  /// velocity terms. Without `moving` velocities count as zero: the response to an impulse.
  void solve(const Vec6d* load, bool moving, Vec6d* acceleration, double* u_rate);
  /// Velocities of all bodies for given speeds, ground last.
  void velocities(const double* u, Vec6d* twists) const;

  /// Velocity of a body per unit speed, its parent at rest, at the last place(); by Member::column.
  const std::vector<Vec6d>& columns() const { return column_; }
  /// From the parent's state point to a body's, at the last place().
  const Vec3d& reach(int body) const { return reach_[idx(body)]; }

 private:
  void place_floating(const Cluster& c, const double* q, const double* u, BodyKinematics<double>* bodies);
  void place_joint(const Cluster& c, const double* q, const double* u, BodyKinematics<double>* bodies);
  void place_struts(const Cluster& c, const BranchMotion& hinge, double rate, BodyKinematics<double>* bodies);
  template <int speeds>
  void place_member(const Member& m, const BodyKinematics<double>& parent, const BranchMotion& motion,
                    const Vec3d& lever, const double* u, BodyKinematics<double>& body);
  template <int speeds>
  void factor_cluster(std::size_t i);
  template <int speeds>
  void gather(std::size_t i, bool moving);
  template <int speeds>
  void spread(std::size_t i, bool moving, Vec6d* acceleration, double* u_rate) const;
  template <class F>
  void with_speeds(const Cluster& c, F&& f) const;

  const BodyTree& tree_;
  int ground_;
  std::vector<Vec6d> column_;     // S: body velocity per unit speed
  std::vector<Vec6d> at_parent_;  // sum over the members of X^T I S, per speed
  std::vector<Vec3d> reach_;      // parent's state point to the body's
  std::vector<Vec6d> bias_;       // acceleration with udot = 0 and the parent at rest
  std::vector<Mat6d> inertia_;    // articulated
  std::vector<Vec6d> force_;      // articulated, minus the load
  std::vector<Mat6d> inverse_;    // (S^T I S)^-1 per cluster
  std::vector<Vec6d> torque_;     // -S^T p per cluster
};

}  // namespace seacrane
