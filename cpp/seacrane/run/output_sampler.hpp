#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/run/extremes.hpp"
#include "seacrane/run/guards.hpp"
#include "seacrane/run/held_forces.hpp"
#include "seacrane/run/recording.hpp"
#include "seacrane/run/restart.hpp"
#include "seacrane/run/stepper.hpp"

namespace seacrane {

/// m, rad: constraints that projection leaves open by more do not hold.
constexpr double kLargestResidual = 1e-6;

/// The states of what is stepped in the last step.
struct StepStates {
  /// Writes the state at a time.
  Extremes::StateAt at;
  /// Solves what is stepped at such a state, or takes over what was solved for elsewhere. Whether its bodies
  /// are placed there.
  std::function<bool(double t, const double* y)> solve;
};

/// Takes the outputs of a run at the times asked for: the state is interpolated, projected, evaluated as far
/// as the channels need, and recorded.
class OutputSampler {
 public:
  /// `options` and `rank` outlive the sampler.
  OutputSampler(const Model& model, const RunOptions& options, RankWatch& rank);

  /// Outputs from time t on; energy_balance is counted from the state (t, bodies).
  void start(Stepper& at, double t, const double* bodies);
  /// Continues what the recording of another run kept.
  void continue_from(const RecordHistory& history);
  /// What a run that continues at time t needs.
  RecordHistory history(double t, double impact_loss) const;

  /// Records the outputs due until t. `impact_loss`: so far, J.
  void record_until(Stepper& at, double t, double impact_loss);
  /// Least and largest values between outputs, see Extremes: call the first right after a step, and
  /// `take_step` behind record_until(). `forces`: see there.
  void read_evaluation(Stepper& at);
  void take_step(Stepper& at, double to, const double* forces);
  /// All three for a step that was taken elsewhere, beside others.
  void take_step_beside(Stepper& at, double from, double to, double impact_loss, const StepStates& states);
  void end_stretch() { extremes_.end_stretch(); }
  void forget_stretch() { extremes_.forget_stretch(); }
  /// One row of all channels of the scene, at the present time.
  Recording snapshot(Stepper& at, double impact_loss);
  /// Takes the largest residual that projection has found since it was asked last.
  void take_residual(Stepper& at);

  const Recording& recording() const { return recording_; }
  const Trail& trail() const { return extremes_.trail(); }
  void drop_rows(std::size_t count) {
    if (count > 0 && count <= recording_.count()) extremes_.drop_trail(recording_.times()[count - 1]);
    recording_.drop(count);
  }

 private:
  double project(Stepper& at, double t);
  StepStates states_of(Stepper& at);
  void record_until(Stepper& at, double t, double impact_loss, const StepStates& states);
  ConstraintResidual evaluate(Stepper& at, double t, const Needs& needs, const StepStates& states);
  bool evaluate_stepped(Stepper& at, double t, const Needs& needs, const StepStates& states);
  void take_ends(Stepper& at, double from, double to, const StepStates& states);
  void write(Stepper& at, double t, double residual_before, double impact_loss, const StepStates& states,
             Recording& out);
  void evaluate_coordinates(const Terms& terms);
  void watch_rank(Stepper& at, double t);

  const Model& model_;
  RankWatch& rank_;
  EnergyWatch energy_;
  const std::vector<double>& times_;
  std::size_t next_ = 0;
  Recording recording_;
  Extremes extremes_;
  double start_energy_ = 0.0, start_work_ = 0.0;
  double largest_residual_ = 0.0;  // before projection, since the last output
  double last_time_ = std::numeric_limits<double>::quiet_NaN(), last_residual_ = 0.0;  // of the last output
  std::vector<double> state_, bodies_, rate_, stepped_rate_;
  std::vector<Vec6d> accelerations_;  // of the described bodies
  VecXd tensions_;                    // of quasi-static lines
  HeldForces held_;
  std::vector<CoordinateRow<double>> coordinates_;
  std::vector<BodyLoad<double>> one_load_;
};

}  // namespace seacrane
