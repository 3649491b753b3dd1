#pragma once

#include <memory>
#include <optional>

#include "seacrane/dynamics/gear_gupta_leimkuhler.hpp"
#include "seacrane/dynamics/stiff_loads.hpp"
#include "seacrane/integrate/registry.hpp"
#include "seacrane/run/stepped_bodies.hpp"

namespace seacrane {

struct RunOptions;

/// What steps one model: its equations in the formulation asked for and an integrator over them. A run has
/// one, and one more for every set of limits that holds at some time.
struct Stepper {
  Stepper(std::shared_ptr<const Model> model, const RunOptions& options);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  std::shared_ptr<const Model> model;
  SteppedBodies bodies;
  MaximalSystem& system;  // of the described bodies: what is recorded
  Formulation& stepped;
  Terms& loads;                                 // that are stepped
  std::optional<GearGuptaLeimkuhler> residual;  // of what is stepped in maximal coordinates, where asked for
  StiffLoads stiff;
  std::unique_ptr<Integrator> integrator;
  bool started = false;  // the integrator has been given a state

  /// A state of the described bodies to the one that is stepped, and back.
  void read_bodies(double t, const double* described, double* y) { bodies.read(t, described, y); }
  void write_bodies(double t, const double* y, double* described) { bodies.write(t, y, described); }
  /// The state of the bodies that are stepped, merged ones as one.
  const double* stepped_bodies(const double* described) { return bodies.merged(described); }
  const std::shared_ptr<const Model>& stepped_model() const { return model->merged ? model->merged : model; }
};

/// What the integrator of a run is made with.
IntegratorOptions integrator_options(const Formulation& stepped, const Model& model, const RunOptions& run);

}  // namespace seacrane
