#pragma once

#include <memory>
#include <vector>

#include "seacrane/dynamics/recursive/loop_closure.hpp"
#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {

/// The recursive formulation: positions and speeds of a tree of clusters, O(n); constraint rows only where
/// the tree leaves a loop or a driver. Loads come from `terms`, the redundant system of the same model, whose
/// kinematics this one sets. State: positions, speeds, memory, work, |work|.
class RecursiveSystem final : public System {
 public:
  /// Throws std::invalid_argument for the paper's kinematics and Baumgarte stabilisation.
  explicit RecursiveSystem(RedundantSystem& terms);

  std::size_t size() const override { return idx(layout_.size); }
  void derivative(double t, const double* y, double* ydot) override;
  bool project(double t, double* y, bool evaluated_here) override;
  bool has_projection() const override { return true; }

  /// Typical magnitude per state component, as Model::scale.
  std::vector<double> scale() const;
  /// From a state of the redundant form (see StateLayout) to this one, and back; lossless but for rounding.
  void read_bodies(double t, const double* redundant, double* y);
  void write_bodies(double t, const double* y, double* redundant);

  const BodyTree& tree() const { return tree_; }
  /// Accelerations of the bodies at the last derivative(), ground last.
  const std::vector<Vec6d>& acceleration() const { return acceleration_; }
  double take_residual_before_projection();

 private:
  struct Layout {
    int speeds = 0, memory = 0, work = 0, size = 0;
  };

  void place(const double* y);
  void evaluate_inertia();
  void factor(double t);
  void move_positions(double* y, const Vec6d* velocities);
  void twists_here();

  RedundantSystem& terms_;
  const Model& model_;
  BodyTree tree_;
  ArticulatedTree articulated_;
  LoopClosure loops_;
  Layout layout_;
  std::vector<Mat6d> mass_;
  std::vector<Vec6d> bias_, load_, acceleration_, twist_;
  std::vector<BodyKinematics<double>> scratch_;
  std::vector<RowBlock<double>> blocks_;
  std::vector<double> speed_rate_, position_rate_;
  VecXd residual_;
  double before_projection_ = 0.0;
};

}  // namespace seacrane
