#pragma once

#include <memory>

#include "seacrane/math/types.hpp"
#include "seacrane/model/description.hpp"

namespace seacrane {

/// Wave loads on one vessel during one run: the loads last evaluated, in axes that follow its yaw about its
/// reference point, and the scratch of their tables.
class WaveForces {
 public:
  explicit WaveForces(const WaveLoadDescription& sources);

  /// Makes the knots of their tables once for both, where these are the same.
  void share_knots(const WaveForces& other);

  /// `pose`: x, y (m) and yaw (rad) of the vessel.
  void evaluate(double t, const Vec3d& pose);

  /// First order; slow drift; N and N m.
  const Vec6d& force() const { return force_; }
  const Vec6d& drift() const { return drift_; }
  Vec6d sum() const { return force_ + drift_; }
  double elevation() const { return elevation_; }  // m

 private:
  const WaveLoadDescription* sources_;  // of the model, which outlives every run
  std::shared_ptr<WaveTableBlock> block_;
  std::shared_ptr<DriftTableBlock> drift_block_;
  Vec6d force_ = Vec6d::Zero(), drift_ = Vec6d::Zero();
  double elevation_ = 0.0;
};

}  // namespace seacrane
