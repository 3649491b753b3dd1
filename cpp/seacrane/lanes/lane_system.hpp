#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "seacrane/integrate/problem.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// Runs of one model, each in a sea of its own, as one system for one integrator: component i of lane j is
/// number i x lanes + j. The recursive form, evaluated for all lanes at once.
class LaneSystem : public System {
 public:
  /// End of the present smooth stretch of the reference curves, see Curve::at.
  virtual void set_curve_limit(double time) = 0;
  /// Zero-order-held inputs of the loads, the same in all lanes.
  virtual void set_inputs(const std::vector<double>& slots) = 0;
  /// Holds the state of a lane from now on, whatever its equations say.
  virtual void freeze(std::size_t lane) = 0;
  /// Largest angular velocity (rad/s) of a body in a lane, where it was evaluated last.
  virtual double turning_rate(std::size_t lane) const = 0;
  /// Time of the last derivative(); not a number before it.
  virtual double evaluated_at() const = 0;
  /// What was solved for there, see RecursiveSystem::take_solution(), side by side as the states are.
  virtual void write_solution(std::vector<double>& out) const = 0;
};

/// One model for each lane, which differ in their seas alone.
using LaneModels = std::vector<std::shared_ptr<const Model>>;

/// What a module that is compiled for one kind of processor offers to the core. Models go there as they are:
/// both must agree on their layout.
struct LaneModule {
  const char* instructions;  // as has_instructions() of the bindings calls them
  std::size_t lanes;
  std::array<std::size_t, 6> layout;
  std::unique_ptr<LaneSystem> (*make)(const LaneModels& models);
};

/// Sizes that tell of another compiler, or of another alignment.
constexpr std::array<std::size_t, 6> layout_of_models() {
  return {sizeof(Model),  sizeof(Vessel), sizeof(BodyModel), sizeof(WaveLoadDescription),
          alignof(Model), alignof(Mat6d)};
}

/// Why a model cannot be stepped in lanes; empty: it can.
std::string kept_out_of_lanes(const Model& model);

}  // namespace seacrane
