#pragma once

#include <vector>

#include "seacrane/dynamics/formulation.hpp"
#include "seacrane/integrate/problem.hpp"

namespace seacrane {

/// The stiff part of a model: of each load that declares states of its own as stiff (StiffLoad), its rate
/// along the direction in which it acts, and those states. With u the wrenches of 1 N in that direction, its
/// rate changes with velocities as u does work on them, and its force makes M^-1 u of acceleration.
class StiffLoads final : public StiffPart {
 public:
  explicit StiffLoads(Formulation& system);

  std::size_t rank() const override { return rank_; }
  void linearise(double t, const double* y, double* in, double* out) override;

 private:
  Formulation& system_;
  std::size_t rank_ = 0;
  std::vector<double> rate_, power_, response_;
  std::vector<Vec6d> unit_;
};

}  // namespace seacrane
