#pragma once

#include <memory>
#include <vector>

#include "seacrane/run/stepper.hpp"

namespace seacrane {

struct RunOptions;

/// The steppers of a run, one for each set of limits that has held so far. One of them is the current one: it
/// takes the steps.
class StepperPool {
 public:
  /// `options` and `inputs` outlive the pool.
  StepperPool(std::shared_ptr<const Model> model, ClosedSet closed, const RunOptions& options,
              const HeldInputs& inputs);

  Stepper& current() const { return *current_; }

  /// The stepper of a set of limits, compiled when it is first asked for. It takes the inputs, the end of the
  /// smooth stretch of curves and the histories of the current one, at the state (t, bodies).
  Stepper& of(ClosedSet closed, double t, const double* bodies);

  /// Makes `next` the current one and starts its integrator at the state (t, bodies), by a reset where it was
  /// current and started: what another stepper kept from the last time its set held would be missing in a
  /// run that continues from a State.
  void step_from(Stepper& next, double t, const double* bodies);

  /// The counters of all steppers together.
  Counters counters() const;
  long dense_solves() const;

 private:
  std::shared_ptr<const Model> model_;
  const RunOptions& options_;
  const HeldInputs& inputs_;
  std::vector<std::unique_ptr<Stepper>> steppers_;  // in the order of their first use
  Stepper* current_ = nullptr;
  Counters counters_before_;  // of integrators before their last start
  std::vector<double> state_;
};

/// The end of the present smooth stretch of curves, see Curve::at.
void set_curve_limit(Stepper& at, double time);

}  // namespace seacrane
