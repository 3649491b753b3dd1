#pragma once

#include <vector>

#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

/// Between the states of the described bodies of a model and those of its merged bodies: poses and twists
/// move between the state points, all else is the same.
class MergedBodies {
 public:
  MergedBodies(const Model& full, const Model& merged);

  /// The state of the merged bodies from that of the described ones.
  void merge(const double* bodies, double* y) const;
  /// From merged bodies back to those described.
  void spread(const double* y, double* bodies) const;
  /// Kinematics of the described bodies from those of the merged ones, grounds last.
  void spread_kinematics(const BodyKinematics<double>* merged, BodyKinematics<double>* described) const;
  /// Accelerations of the described bodies from those of the merged ones, whose kinematics `terms` holds.
  void spread_accelerations(const Terms& terms, const std::vector<Vec6d>& merged,
                            std::vector<Vec6d>& described) const;

 private:
  const Model& full_;
  const Model& merged_;
  std::vector<Vec3d>
      reach_;  // to the state point of each described body from its carrier's, in the carrier's axes
};

}  // namespace seacrane
