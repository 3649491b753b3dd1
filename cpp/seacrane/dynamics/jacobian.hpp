#pragma once

#include <vector>

#include "seacrane/dynamics/kinematics.hpp"
#include "seacrane/math/dual.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

class RedundantSystem;

/// Exact Jacobian of dy/dt of the redundant formulation. The residual of eq (9),
///
///   p = load + D^T lambda - M vdot,   s = gamma - D vdot,   vdot and lambda held,
///
/// is differentiated element by element in the twelve directions of one body at a time (translation, rotation
/// vector in inertial axes, velocity, angular velocity); then M dvdot - D^T dlambda = dp, D dvdot = ds is
/// solved with the factors of the evaluation, which are never differentiated themselves. Load, constraint and
/// vessel are the code of the run with a Dual for a double. Only a function force, a C function, is
/// differentiated by central differences.
class RedundantJacobian {
 public:
  explicit RedundantJacobian(const Model& model);

  /// Right after system.derivative(t, y, ...): writes df/dy by columns.
  void evaluate(RedundantSystem& system, double t, const double* y, double* out);

 private:
  static constexpr int kDirections = 12;
  using Scalar = Dual<kDirections>;
  struct MemoryMatrices {
    MatXd a, c;  // x' = a x + ..., mu = c x + ...
  };

  void seed(const BodyKinematics<double>& k, BodyKinematics<Scalar>& out) const;
  void add_inertia(int body);
  void add_loads(int body, const LoadInput<Scalar>& input, LoadSum<Scalar>& sum);
  void add_differences(const FunctionForce& load, double t, LoadSum<Scalar>& sum);
  void add_hydrodynamics(int body, const LoadInput<Scalar>& input, const double* y, LoadSum<Scalar>& sum);
  void add_waves(int body, double t, LoadSum<Scalar>& sum);
  void add_rows(int body, double t);
  void add_rows(const RowBlock<Scalar>& block, const ElementModel& element);
  void solve_column(double* column, double power, double absolute_power);
  void write_body_columns(int body, const double* y, const LoadSum<Scalar>& sum, double* out);
  void write_memory_columns(const double* y, double* out);
  void write_pose_rates(const double* y, double* out) const;

  const Model* model_;
  RedundantSystem* system_ = nullptr;   // during an evaluation
  std::vector<MemoryMatrices> memory_;  // by vessel
  std::vector<BodyKinematics<Scalar>> bodies_;
  std::vector<BodyKinematics<double>> moved_;
  std::vector<Wrench<Scalar>> wrench_;
  std::vector<Wrench<double>> moved_wrench_;
  std::vector<Scalar> right_, memory_state_, memory_rate_;
  std::vector<Vec6d> load_, acceleration_;
  std::vector<double> given_, lambda_, column_;
  MatXd response_;  // to unit loads of the memory
};

}  // namespace seacrane
