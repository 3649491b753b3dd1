#pragma once

#include <memory>
#include <vector>

#include "seacrane/dynamics/gear_gupta_leimkuhler.hpp"
#include "seacrane/dynamics/redundant.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {

struct RunOptions;

/// What steps one model: its equations in the formulation asked for and an integrator over them. A run has
/// one, and one more for every set of limits that holds at some time.
struct Stepper {
  Stepper(std::shared_ptr<const Model> model, const RunOptions& options);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  std::shared_ptr<const Model> model;
  RedundantSystem system;              // of the described bodies: what is recorded
  std::unique_ptr<Formulation> other;  // null: the redundant system itself is stepped
  Formulation& stepped;
  RedundantSystem& loads;  // that are stepped
  GearGuptaLeimkuhler residual;
  std::unique_ptr<Integrator> integrator;
  bool started = false;  // the integrator has been given a state

  /// The state of the bodies that are stepped, merged ones as one.
  const double* stepped_bodies(const double* bodies);
  const std::shared_ptr<const Model>& stepped_model() const { return model->merged ? model->merged : model; }

 private:
  std::vector<double> merged_state_;
};

}  // namespace seacrane
