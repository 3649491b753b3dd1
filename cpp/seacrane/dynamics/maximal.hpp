#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "seacrane/dynamics/constraint_solver.hpp"
#include "seacrane/dynamics/formulation.hpp"
#include "seacrane/dynamics/inertial_tensions.hpp"
#include "seacrane/dynamics/jacobian.hpp"
#include "seacrane/dynamics/terms.hpp"
#include "seacrane/integrate/problem.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// Poses of all bodies, moved along their twists (StateLayout).
class PoseMap final : public PositionMap {
 public:
  explicit PoseMap(const Model& model) : model_(model), moved_(idx(model.layout.size)) {}

  std::size_t position_size() const override { return idx(model_.layout.velocity); }
  void move(double h, double* y) override;
  bool move_jacobian(double h, const double* y, double* out) override;

 private:
  const Model& model_;
  std::vector<double> moved_;
};

/// The paper's formulation, eqs (5)-(9), (32)-(35), in maximal coordinates: every body with six velocities,
/// every joint with multipliers. Its state is that of the bodies (StateLayout). Users know it as
/// formulation "redundant".
class MaximalSystem final : public Formulation {
 public:
  explicit MaximalSystem(std::shared_ptr<const Model> model);
  /// On terms that it shares with others.
  explicit MaximalSystem(std::shared_ptr<Terms> terms);

  std::size_t size() const override { return idx(model_.layout.size); }
  void derivative(double t, const double* y, double* ydot) override;
  bool project(double t, double* y, bool evaluated_here) override;
  bool has_projection() const override { return true; }
  bool jacobian(double t, const double* y, double* out) override;

  const char* name() const override { return "redundant"; }
  Terms& terms() override { return *terms_; }
  const Terms& terms() const { return *terms_; }
  PositionMap& positions() override { return positions_; }
  std::vector<double> scale() const override { return model_.scale; }
  void read_bodies(double t, const double* bodies, double* y) override;
  void write_bodies(double t, const double* y, double* bodies) override;
  void place_bodies(double t, const double* y) override { terms_->read(t, y); }
  bool closes_joints() const override { return false; }
  const std::vector<Vec6d>& accelerations() const override { return acceleration_; }
  double evaluated_at() const override { return evaluated_at_; }
  double tension(int element) const override;
  void load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) override;
  void load_direction(const std::vector<Vec6d>& load, double* power, double* rates) override;
  Dependence take_dependence() override { return solver_.take_dependence(); }
  double take_residual_before_projection() override;
  std::string describe(std::size_t component) const override;

  /// Why jacobian() returned false or would; empty when it is there.
  std::string missing_jacobian() const;
  const Model& model() const { return model_; }
  /// The multipliers of the last derivative(), by row.
  const std::vector<double>& multipliers() const { return lambda_; }
  /// Makes them the shortest that load the bodies alike, where rows depend on others.
  void shorten_multipliers() { solver_.shorten(lambda_); }
  /// With the factors of the last evaluation.
  ConstraintSolver& solver() { return solver_; }
  InertialTensions& tensions() { return tensions_; }
  /// The rank of the rows at (t, y), see ConstraintSolver::rank().
  ConstraintRank rank(double t, const double* y, int skipped = 0);
  /// Evaluations that the dense solver took.
  long dense_solves() const { return dense_solves_; }

 private:
  friend std::vector<std::pair<std::string, double>> time_parts(MaximalSystem& system, double t,
                                                                const double* y, long count);

  void find_joined();
  void solve_acceleration();
  void add_inertial_tensions();
  void write_rates(const double* y, double* ydot);
  void write_pose_rates(const double* y, double* ydot) const;
  void move_poses(double* y);

  std::shared_ptr<Terms> terms_;
  const Model& model_;
  ConstraintSolver solver_;
  PoseMap positions_;
  InertialTensions tensions_;
  std::vector<char> alone_;  // tensions that act on bodies that nothing joins
  std::vector<Vec6d> acceleration_, correction_, direction_;
  std::vector<double> lambda_, gamma_, residual_;
  std::vector<double> no_right_, response_multipliers_;  // of load_response()
  MatXd inertial_multipliers_;                           // for 1 N of each inertial tension
  std::optional<MaximalJacobian> jacobian_;
  std::vector<double> jacobian_rate_;
  double before_projection_ = 0.0;
  double evaluated_at_ = std::numeric_limits<double>::quiet_NaN();
  long dense_solves_ = 0;
};

/// Goes on from saved histories of the vessels; none at all: at rest before t, with the accelerations that
/// the start gives.
void start_histories(MaximalSystem& system, double t, const double* y,
                     const std::vector<TwistHistory>& saved);
/// Takes the samples due at (t, y).
void sample_histories(Terms& terms, double t, const double* y);

}  // namespace seacrane
