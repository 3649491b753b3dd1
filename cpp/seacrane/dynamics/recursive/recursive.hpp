#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "seacrane/dynamics/formulation.hpp"
#include "seacrane/dynamics/inertial_tensions.hpp"
#include "seacrane/dynamics/recursive/recursive_jacobian.hpp"
#include "seacrane/dynamics/recursive/tree_derivative.hpp"
#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

/// One of several beside each other: its number k is values[k x lanes + lane].
struct LaneOf {
  const double* values;
  std::size_t lane, lanes;
};

/// The recursive formulation: positions and speeds of a tree of clusters, O(n); constraint rows only where
/// the tree leaves a loop or a driver. Loads come from `terms`, whose kinematics this one sets. State:
/// positions, speeds, memory, work, |work|. Coordinates that drivers prescribe stand in it too, but what they
/// are follows from the time.
class RecursiveSystem final : public Formulation, public PositionMap {
 public:
  /// Throws std::invalid_argument for the paper's kinematics and Baumgarte stabilisation.
  explicit RecursiveSystem(std::shared_ptr<Terms> terms);

  std::size_t size() const override { return idx(layout_.size); }
  void derivative(double t, const double* y, double* ydot) override;
  bool project(double t, double* y, bool evaluated_here) override;
  bool has_projection() const override { return true; }

  bool jacobian(double t, const double* y, double* out) override;
  PositionMap& positions() override { return *this; }
  std::size_t position_size() const override { return idx(tree_.positions); }
  void move(double h, double* y) override;
  bool move_jacobian(double /*h*/, const double* /*y*/, double* /*out*/) override { return false; }
  const char* name() const override { return "recursive"; }
  std::vector<double> scale() const override;
  void read_bodies(double t, const double* bodies, double* y) override;
  void write_bodies(double t, const double* y, double* bodies) override;
  void place_bodies(double t, const double* y) override { place(t, y); }
  bool closes_joints() const override { return loops_.rows() == 0; }
  const std::vector<Vec6d>& accelerations() const override {
    return kept_acceleration_.empty() ? acceleration_ : kept_acceleration_;
  }
  double evaluated_at() const override { return evaluated_at_; }
  double tension(int element) const override;
  /// Takes over what was solved for elsewhere at a state, in place of derivative(), but for kinematics and
  /// rates: accelerations by body, forces (TreeDerivative::read_forces), inertial tensions. Not of a scene
  /// with rows.
  void take_solution(double t, const double* y, const LaneOf& solution);
  void load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) override;
  void load_direction(const std::vector<Vec6d>& load, double* power, double* rates) override;
  Terms& terms() override { return *terms_; }
  double take_residual_before_projection() override;
  std::string describe(std::size_t component) const override;

  const BodyTree& tree() const { return tree_; }
  /// Nanoseconds per evaluation by part, each repeated `count` times at (t, y).
  std::vector<std::pair<std::string, double>> time_parts(double t, const double* y, long count);
  /// How much cancels: of inertias along the tree, and of the rows that close loops.
  double condition(double t, const double* y);
  Dependence take_dependence() override { return loops_.take_dependence(); }

 private:
  struct Layout {
    int speeds = 0, memory = 0, work = 0, size = 0;
  };

  const double* followed(double t, const double* y);
  void place(double t, const double* y);
  void place_as_given(const double* y);
  bool follow_drivers(double t, double* y);
  void strike(double t, double* y);
  void evaluate(double t, const double* y, double* ydot, bool actuators_on_tree);
  void evaluate_wrenches(double t, const double* y, double* ydot, bool actuators_on_tree);
  void evaluate_inertia(double t, const double* y);
  void factor(double t, const double* y);
  void choose_rows();
  void solve_acceleration(double* u_rate);
  void solve_with_loops(double* u_rate);
  void find_near();
  void respond_to_tension(Eigen::Index i, double* u_rate);
  void add_inertial_tensions(double* u_rate);
  void move_positions(double* y, const Vec6d* velocities);
  void twists_here();

  std::shared_ptr<Terms> terms_;
  const Model& model_;
  TreeDerivative<double> own_;
  const BodyTree& tree_;
  ArticulatedTree<double>& articulated_;
  DrivenSpeeds& driven_;
  LoopClosure loops_;
  InertialTensions tensions_;
  TreeActuators actuators_;
  // Of the last derivative(), where projections overwrite it.
  std::vector<Vec6d> kept_acceleration_;
  VecXd kept_multipliers_;
  std::vector<double> forces_;  // see TreeDerivative::read_forces
  Layout layout_;
  bool keeps_terms_ = false;  // in mass_ and load_, for rows and the Jacobian
  std::vector<Mat6d> mass_;
  std::vector<Vec6d> load_, acceleration_, twist_, direction_;
  std::vector<Wrench<double>> along_;
  std::vector<BodyKinematics<double>> scratch_;
  std::vector<RowBlock<double>> blocks_;
  std::vector<double> followed_;  // a state with what drivers prescribe
  std::vector<double> speed_rate_, position_rate_;
  // For 1 N of each inertial tension:
  std::vector<std::vector<double>> force_response_;
  MatXd inertial_speed_rates_;
  std::vector<std::vector<std::size_t>> near_;  // clusters that move; empty: all may
  VecXd inertial_;                              // tensions that were solved for elsewhere
  VecXd residual_, loop_bias_;
  std::optional<RecursiveJacobian> jacobian_;
  std::vector<double> jacobian_rate_;
  double before_projection_ = 0.0;
  double evaluated_at_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace seacrane
