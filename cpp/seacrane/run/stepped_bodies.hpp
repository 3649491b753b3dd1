#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/dynamics/merged_bodies.hpp"

namespace seacrane {

class RecursiveSystem;

/// The bodies of a model as they are described, which is what is recorded, and as they are stepped: merged
/// where they move as one, in one of the formulations; with the way there and back.
class SteppedBodies {
 public:
  /// Formulation "redundant" or "recursive". Throws std::invalid_argument for another name, or for a scene
  /// that does not fit.
  SteppedBodies(const std::string& formulation, std::shared_ptr<const Model> model);
  SteppedBodies(const SteppedBodies&) = delete;
  SteppedBodies& operator=(const SteppedBodies&) = delete;

  /// All bodies, none merged, in maximal coordinates.
  MaximalSystem& described() { return described_; }
  /// What is stepped: the described bodies themselves where nothing is merged and the name is "redundant".
  Formulation& formulation() { return *stepped_; }
  /// The formulation where it has maximal coordinates; null where it has those of the tree.
  MaximalSystem* maximal() { return maximal_; }
  /// The formulation where it has the coordinates of the tree; null where it has maximal ones.
  RecursiveSystem* recursive() { return recursive_; }
  /// The terms that are stepped: inputs, the limit of curves and histories are set there.
  Terms& terms() { return *terms_; }
  /// Evaluations that a dense solver took.
  long dense_solves() const;

  /// A state of the described bodies to the one that is stepped, and back.
  void read(double t, const double* bodies, double* y);
  void write(double t, const double* y, double* bodies);
  /// Kinematics of the described bodies at a state that is stepped, in their terms.
  void place(double t, const double* y);
  /// The same where derivative() was the last to be called, at that state.
  void spread();
  /// The state of the bodies that are stepped, merged ones as one; valid until the next call.
  const double* merged(const double* bodies);
  /// Throws std::invalid_argument where a body is not where it moves as one with what carries it.
  void check_merged(const double* bodies);
  /// Accelerations of the described bodies' state points at the last derivative().
  const std::vector<Vec6d>& accelerations();

  // One history of the vessels' motion for the steps and the outputs: two would differ by rounding, and so
  // would a run that starts from one of them.
  /// See seacrane::start_histories().
  void start_histories(double t, const double* bodies, const std::vector<TwistHistory>& saved);
  void sample_histories(double t, const double* bodies);

 private:
  void share_histories();

  std::shared_ptr<Terms> terms_;  // of the described bodies until these are merged
  MaximalSystem described_;
  std::optional<MergedBodies> map_;
  std::unique_ptr<Formulation> own_;  // null: the described bodies are stepped
  Formulation* stepped_;
  RecursiveSystem* recursive_ = nullptr;
  MaximalSystem* maximal_;
  std::vector<double> merged_;
  std::vector<Vec6d> acceleration_;
};

}  // namespace seacrane
