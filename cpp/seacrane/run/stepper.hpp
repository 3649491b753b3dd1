#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "seacrane/dynamics/gear_gupta_leimkuhler.hpp"
#include "seacrane/dynamics/stiff_loads.hpp"
#include "seacrane/integrate/registry.hpp"
#include "seacrane/run/stepped_bodies.hpp"

namespace seacrane {

struct RunOptions {
  std::string formulation = "redundant";
  std::string integrator = "dopri5";
  /// Local error of a step in units of the scale of each state: absolute, so that results do not depend on
  /// where the origin is.
  double scaled_tolerance = 1e-6;
  std::optional<double> fixed_step;       // s, of fixed-step methods; none: the method's own
  std::optional<double> max_step;         // s; none: no limit
  std::optional<double> spectral_radius;  // of generalized-alpha; none: the method's own
  std::optional<double> energy_limit;     // of the energy balance, see EnergyWatch; none: no limit
  std::vector<double> output_times;       // increasing; those before the start are left out
  std::optional<std::size_t> capacity;    // outputs to take memory for; none: all
  std::set<std::string> channels;
  std::set<std::string> extremes;  // channels of which least and largest values between outputs are kept
  std::set<std::string> trail;     // channels whose values at every step are kept, see Trail
  std::chrono::milliseconds ask_every{20};  // of wall time: how often advance() asks whether to go on
};

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

/// The inputs of a run, one number for each slot of the model, held from one call of a controller to the
/// next.
class HeldInputs {
 public:
  /// Throws std::invalid_argument for a wrong count, and for a value that is not finite; so does set().
  HeldInputs(const Model& model, const std::vector<double>& slots);

  void set(const std::vector<double>& slots);
  void give_to(Stepper& stepper) const;
  const std::vector<double>& slots() const { return slots_; }

 private:
  const Model& model_;
  std::vector<double> slots_;
};

}  // namespace seacrane
