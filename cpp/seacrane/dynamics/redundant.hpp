#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "seacrane/dynamics/dense_kkt.hpp"
#include "seacrane/dynamics/formulation.hpp"
#include "seacrane/dynamics/inertia.hpp"
#include "seacrane/dynamics/jacobian.hpp"
#include "seacrane/dynamics/wave_forces.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// Largest absolute residuals of all constraints.
struct ConstraintResidual {
  double position = 0.0, rate = 0.0;
};

/// Unknowns, six a body and one a row, above which the dense fall-back would not be affordable.
constexpr int kDenseLimit = 1500;

/// Rank of D at one state, a basis of ker(D^T) (empty for large systems) and the largest S_ii / d_i. The
/// smallest singular value over the largest that is asked for, by geometry alone, with the element that takes
/// the largest part in that combination of rows (NaN and -1 for large systems).
struct ConstraintRank {
  int rank = 0;
  MatXd null_space;
  double condition = 0.0;
  double smallest_singular_value = std::numeric_limits<double>::quiet_NaN();
  int weakest = -1;
};

/// The paper's formulation, eqs (5)-(9), (32)-(35): every body with six velocities, every joint with
/// multipliers. Holds the scratch of one run; the Model stays untouched.
class RedundantSystem final : public Formulation, public PositionMap {
 public:
  explicit RedundantSystem(std::shared_ptr<const Model> model);

  std::size_t size() const override { return static_cast<std::size_t>(model_->layout.size); }
  void derivative(double t, const double* y, double* ydot) override;
  bool project(double t, double* y, bool evaluated_here) override;
  bool has_projection() const override { return true; }
  const char* name() const override { return "redundant"; }
  std::vector<double> scale() const override { return model_->scale; }
  void read_bodies(double t, const double* bodies, double* y) override;
  void write_bodies(double t, const double* y, double* bodies) override;
  const std::vector<Vec6d>& accelerations() override { return acceleration_; }
  void load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) override;
  RedundantSystem& loads_from() override { return *this; }
  double condition() const override { return condition_; }
  Dependence take_dependence() override;
  std::string describe(std::size_t component) const override;
  PositionMap& positions() override { return *this; }
  std::size_t position_size() const override { return static_cast<std::size_t>(model_->layout.velocity); }
  void move(double h, double* y) override;
  bool move_jacobian(double h, const double* y, double* out) override;
  bool jacobian(double t, const double* y, double* out) override;
  /// What a state of the fluid memory is, counted from the first of them, for messages.
  std::string describe_memory(int state) const;
  /// What is not finite at (t, y), named with its value: a state, a load, the rows of a joint or what comes
  /// of them; empty where all is. For reports: loads are evaluated one by one.
  std::string non_finite(double t, const double* y);
  /// Why jacobian() returned false or would; empty when it is there.
  std::string missing_jacobian() const;

  const Model& model() const { return *model_; }
  void set_inputs(const std::vector<double>& slots) { slots_ = slots; }
  /// End of the present smooth stretch of the reference curves, see Curve::at.
  void set_curve_limit(double time) { curve_limit_ = time; }

  /// Histories of the vessels with a convolution, in their order; they change between steps only.
  std::vector<TwistHistory> histories() const;
  /// Goes on from `histories`; none at all: at rest before t.
  void start_histories(double t, const double* y, const std::vector<TwistHistory>& histories);
  /// When the next history wants its sample: no evaluation may go beyond. Infinity without convolution.
  double next_sample() const;
  /// Takes the samples due at t.
  void sample(double t, const double* y);
  /// Those of a system with the same vessels.
  void take_histories(const RedundantSystem& other);

  ConstraintResidual residual(double t, const double* y);
  /// As residual(), with the rows that the last evaluation left.
  ConstraintResidual residual_here(const double* y);
  /// Whether combinations of rows that depend on the others can be left out: not in large systems.
  bool solves_dependent_rows() const { return row_space_.has_value(); }
  /// The singular value told is the smallest but `skipped`.
  ConstraintRank rank(double t, const double* y, int skipped = 0);
  /// Nanoseconds per evaluation by part, each repeated `count` times at (t, y).
  std::vector<std::pair<std::string, double>> time_parts(double t, const double* y, long count);
  double take_residual_before_projection() override;
  /// Kinetic energy (added mass included) plus potential energy of gravity, springs and restoring.
  double energy(double t, const double* y);
  /// As energy(), with what the last evaluation left.
  double energy_here(double t, const double* y) const;

  // What the last derivative() computed.
  const std::vector<BodyKinematics<double>>& bodies() const { return bodies_; }
  const std::vector<Vec6d>& acceleration() const { return acceleration_; }
  const std::vector<double>& multipliers() const { return lambda_; }
  const std::vector<RowBlock<double>>& blocks() const { return blocks_; }
  const WaveForces& waves(std::size_t load) const { return waves_[load]; }
  /// x, y and yaw of the vessel where its wave loads are taken; `memory`: the memory part of a state.
  Vec3d wave_pose(const WaveLoad& wave, const double* memory) const;
  LoadInput<double> load_input(double t) const { return {t, curve_limit_, bodies_.data(), slots_.data()}; }
  const std::vector<BodyInertia>& inertia() const { return inertia_; }
  /// Loads minus velocity terms per body, and the mass matrix: M vdot = load + D^T lambda.
  const std::vector<Vec6d>& loads() const { return load_; }
  Mat6d mass_matrix(int body) const;
  long dense_solves() const { return dense_solves_; }

  // For a formulation with other coordinates: kinematics of all bodies (ground last) that it may set, and
  // the loads that go with them.
  BodyKinematics<double>* kinematics() { return bodies_.data(); }
  void read_kinematics(double t, const double* y) { read_state(t, y); }
  /// Yaw frames of the vessels at the present kinematics.
  void follow_yaw();
  const YawFrame<double>& frame(int vessel) const { return frames_[idx(vessel)]; }
  double curve_limit() const { return curve_limit_; }
  /// Running convolution of a vessel; null where its memory has states, or where it has none.
  const RunningConvolution* convolution(int vessel) const;
  /// Loads on the bodies without velocity terms; `memory` and its rates: the memory part of a state.
  void evaluate_wrenches(double t, const double* memory, double* memory_rate);
  Vec6d wrench(int body) const {
    return (Vec6d() << wrench_[idx(body)].force, wrench_[idx(body)].moment).finished();
  }

  /// Kinematics, inertia, rows and loads at (t, y) without solving, for the residual form.
  void evaluate_terms(double t, const double* y, double* ydot);
  void multiplier_load(const double* lambda, std::vector<Vec6d>& out) const;
  /// M vdot - D^T lambda = load, D vdot = right, by the factors of the last evaluation.
  void solve(const std::vector<Vec6d>& load, const std::vector<double>& right,
             std::vector<Vec6d>& acceleration, std::vector<double>& lambda);
  /// D v - nu by row, with the rows last evaluated; returns the largest magnitude.
  double rate_residual(const double* y, double* out) const;
  /// Power of the loads without potential, drivers included, and the sum of its absolute parts.
  double power() const { return power_; }
  double absolute_power() const { return absolute_power_; }
  void add_driver_power(double power);

 private:
  void read_state(double t, const double* y);
  void evaluate_inertia();
  void evaluate_rows(double t);
  void evaluate_loads(double t, const double* y, double* ydot);
  void apply_hydrodynamics(const LoadInput<double>& input, const double* memory, double* memory_rate,
                           LoadSum<double>& sum);
  void apply_waves(double t, const double* memory, LoadSum<double>& sum);
  void factor();
  void factor_dense();
  void solve_dense();
  double shape_condition();
  int weakest_element(int combination) const;
  std::string non_finite_load(double t, const double* y);
  std::string non_finite_rows() const;
  Mat6d symmetric_mass(int body) const;
  void correct();
  void solve_acceleration();
  void write_pose_rates(const double* y, double* ydot) const;
  void write_rates(const double* y, double* ydot);
  double position_residual() const;
  void move_poses(double* y);
  void move_twists(double* y);

  std::shared_ptr<const Model> model_;
  std::vector<double> slots_;
  double curve_limit_ = std::numeric_limits<double>::infinity();
  std::vector<BodyKinematics<double>> bodies_;
  std::vector<BodyLoad<double>> wrench_;
  std::vector<BodyInertia> inertia_;
  std::vector<Vec6d> bias_, load_, acceleration_, impulse_;
  std::vector<YawFrame<double>> frames_;
  std::vector<std::pair<std::size_t, RunningConvolution>> convolutions_;  // by vessel
  std::vector<RowBlock<double>> blocks_;
  std::vector<Mat6d> over_mass_, mass_;
  std::vector<double> values_, lambda_, gamma_, residual_, moved_;
  std::vector<WaveForces> waves_;
  std::optional<DenseKkt> dense_;
  std::optional<RowSpace> row_space_;
  std::vector<Mat6d> over_shape_, dense_mass_;
  std::vector<double> shape_values_;
  double condition_ = 1.0;
  bool regular_ = true;                                  // the Schur complement is accurate enough here
  bool dependent_ = false;                               // not regular, and rows depend on each other
  int redundant_ = -1, most_left_out_ = 0;               // combinations of rows; -1: not told yet
  std::vector<double> no_right_, response_multipliers_;  // of load_response()
  std::optional<RedundantJacobian> jacobian_;
  std::vector<double> jacobian_rate_;
  double power_ = 0.0, absolute_power_ = 0.0;
  double before_projection_ = 0.0;
  long dense_solves_ = 0;
};

}  // namespace seacrane
