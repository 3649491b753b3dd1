#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

template <class T>
struct CoordinateRow;
template <class T>
struct BodyLoad;
class MaximalSystem;
class Terms;
struct Model;

/// A dimension of channels, beside time, and the names along it.
struct Axis {
  std::string name;
  std::vector<std::string> labels;  // the same in every scene; empty: those of a scene
  std::vector<std::string> (*of_scene)(const Model& model) = nullptr;
  bool only_if_several = false;  // channels have no such dimension in a scene with one name along it
};

std::vector<std::string> labels_of(const Axis& axis, const Model& model);

/// What a channel needs at an output, beside the kinematics.
struct Needs {
  bool residual = false;  // of the constraints, beyond that they are closed
  bool loads = false;
  bool energy = false;
  bool accelerations = false;
  bool tensions = false;   // of lines: accelerations, where these are quasi-static
  bool held = false;       // forces of links and drivers
  bool solution = false;   // the multipliers of all joints described: of all needs by far the dearest
  bool reactions = false;  // the shortest of these, where those of joints are not unique
  bool coordinates = false;

  Needs& operator|=(const Needs& other) {
    residual |= other.residual;
    loads |= other.loads;
    energy |= other.energy;
    accelerations |= other.accelerations;
    tensions |= other.tensions;
    held |= other.held;
    solution |= other.solution;
    reactions |= other.reactions;
    coordinates |= other.coordinates;
    return *this;
  }
};

/// One output: the state of the described bodies, the system evaluated there as far as its channels need, and
/// what only the run knows.
struct Output {
  double time = 0.0;
  const double* state = nullptr;
  const MaximalSystem& system;
  const Terms& terms;
  const std::vector<Vec6d>& accelerations;  // of the described bodies' state points
  const std::vector<CoordinateRow<double>>& coordinates;
  std::span<const double> links, drivers;      // tensions and forces of those described
  const std::span<BodyLoad<double>> one_load;  // zeros, for all bodies and the ground; left as zeros
  double* const load_rates;                    // room for the rates of all states of loads
  double residual = 0.0, residual_rate = 0.0;  // of constraints, after projection: largest magnitudes
  double residual_before_projection = 0.0;     // largest since the last output
  double energy_balance = 0.0;                 // J, change of mechanical energy minus work since the start
  double impact_loss = 0.0;                    // J, since the start
};

/// Where least and largest values of a channel between outputs come from.
enum class Peaks {
  of_none,           // none are kept
  of_poses,          // none are kept; what follows from it has them
  of_states,         // the states at the ends and in the middle of every step: it follows from these
  of_lines,          // likewise; where lines are quasi-static the last evaluation of every step
  of_held,           // the last evaluation of every step, see Formulation::tension()
  of_accelerations,  // likewise, with the kinematics of its state
  of_limits,         // what the search for events has evaluated there
  of_ends,           // an evaluation at the end of every step, as at an output
};

/// A quantity that can be recorded.
struct Channel {
  std::string name;
  std::vector<const Axis*> axes;
  std::string unit, text;
  Needs needs = {};
  Peaks peaks = Peaks::of_ends;
  bool by_default = true;
  bool (*offered)(const Model& model) = nullptr;  // whether a scene has it; null: where no axis is empty
  /// Writes the values, the last axis fastest, over those of the output before (zeros at the first).
  void (*write)(const Output& output, double* values) = nullptr;
};

Needs needs_of(const Channel& channel, const Model& model);

inline bool has_extremes(const Channel& channel) {
  return channel.peaks != Peaks::of_none && channel.peaks != Peaks::of_poses;
}

/// Shape of an output of the channel.
std::vector<std::size_t> shape_of(const Channel& channel, const Model& model);

namespace axes {

extern const Axis xyz, wxyz, motion, water;
extern const Axis body, vessel, joint, joint_coordinate, actuator, driver, link, limit, point, load;

}  // namespace axes

}  // namespace seacrane
