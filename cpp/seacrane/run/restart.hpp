#pragma once

#include <optional>
#include <string>
#include <vector>

#include "seacrane/run/stepper.hpp"

namespace seacrane {

/// What an integrator keeps from step to step, with the state in the coordinates it steps.
struct StepHistory {
  std::string formulation, integrator;  // empty: none
  std::vector<double> values;           // Integrator::save()
  std::vector<double> rate;             // of the state stepped: tells whether the scene is the same
  std::optional<double> kink;           // s: where a step that is taken again is to end; none: nowhere
};

/// What recording keeps from output to output.
struct RecordHistory {
  double start_energy = 0.0, start_work = 0.0;  // J, where energy_balance is counted from
  double residual = 0.0;                        // m or rad, largest before projection since the last output
  double impact_loss = 0.0;                     // J, of limits since the start
  std::vector<double> quaternions;              // of the last output; none: not recorded
  std::vector<double> extremes;                 // see Extremes::save()
};

/// Everything that changes during a run; a copy is a checkpoint.
struct State {
  double time = 0.0;
  std::vector<double> values;           // poses, twists, memory states, work; see StateLayout
  std::vector<double> inputs;           // zero-order-held slots
  std::vector<TwistHistory> histories;  // one per vessel with a convolution; none: at rest before `time`
  StepHistory steps;                    // the same formulation and integrator continue it bit for bit
  std::optional<std::vector<std::string>> closed;  // limits that hold; none: as described
  std::optional<RecordHistory> record;             // goes with `steps`; none: recording starts afresh
  std::vector<std::string> parts;                  // see state_parts(); none: not known
};

State initial_state(const Model& model);

/// What the values and inputs of a state belong to, one text each: tells the state of another scene.
std::vector<std::string> state_parts(const Model& model);

/// The states of loads in a state whose parts are known: their names, and the place of the first one in the
/// values.
struct LoadStates {
  std::vector<std::string> names;
  std::size_t first = 0;
};
LoadStates load_states(const State& state);

/// The state itself. Throws std::invalid_argument for one of another scene, with the first difference named,
/// and for values that are not finite.
const State& checked_state(const Model& model, const State& state);

/// The limits that hold in a state.
ClosedSet closed_limits(const Model& model, const State& state);

StepHistory save_steps(Stepper& at, const std::string& integrator);

/// Gives the integrator the state `start` and what it kept, and returns whether it continues from there as if
/// it had not stopped: the history is that of this formulation and integrator, and, to the bit, of these
/// values, inputs and scene.
bool load_steps(Stepper& at, const std::string& integrator, const State& start);

}  // namespace seacrane
