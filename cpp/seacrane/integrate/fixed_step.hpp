#pragma once

#include <vector>

#include "seacrane/integrate/one_step.hpp"

namespace seacrane {

/// What the own methods of fixed step share: the step loop and dense output of order 4.
///
/// Dense output is a quartic: the cubic Hermite polynomial of the step, corrected so that its slope at one
/// inner point is the system's there (evaluated on the cubic, whose error there is O(h^4), which makes the
/// quartic's O(h^5)). That evaluation is made once, and only for a step somebody looks into.
class FixedStep : public OneStepIntegrator {
 public:
  FixedStep(const IntegratorProperties& properties, const Problem& problem, const IntegratorOptions& options);

  double step_in_use() const final { return length_; }
  void step(double t_limit) final;
  void interpolate(double t, double* y) const override;

 protected:
  /// Fills end_state_ with the result of a step of length h from state_, where start_derivative_ is f.
  virtual void advance(double h, double t_end) = 0;
  void require_finite(double h, const std::vector<double>& values) const;

 private:
  double cubic(std::size_t i, double s, double h) const;
  void find_quartic() const;

  double length_;
  // Filled on the first look into a step.
  mutable std::vector<double> inner_state_, quartic_;
  mutable bool quartic_known_ = false;
};

}  // namespace seacrane
