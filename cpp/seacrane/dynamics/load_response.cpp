// What loads add to the accelerations of bodies as they are joined, at the state and by the factors of the
// last evaluation: a = M^-1 (load + D^T lambda) with D a = 0, in both formulations.

#include <algorithm>

#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"

namespace seacrane {

void MaximalSystem::load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) {
  solver_.solve(load, no_right_, acceleration, response_multipliers_);
}

void RecursiveSystem::load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) {
  articulated_.solve(load.data(), false, acceleration.data(), speed_rate_.data());
  if (loops_.rows() == 0) return;
  // Rows know gamma - D a: without gamma, the difference from that of bodies at rest.
  std::ranges::fill(load_, Vec6d::Zero());
  loops_.acceleration_residual(blocks_.data(), load_.data(), loop_bias_);
  loops_.acceleration_residual(blocks_.data(), acceleration.data(), residual_);
  residual_ -= loop_bias_;
  std::ranges::copy(load, load_.begin());
  loops_.add_load(blocks_.data(), loops_.solve(residual_), load_.data());
  articulated_.solve(load_.data(), false, acceleration.data(), speed_rate_.data());
}

}  // namespace seacrane
