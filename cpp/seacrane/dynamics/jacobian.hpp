#pragma once

#include <vector>

#include "seacrane/dynamics/body_residual.hpp"

namespace seacrane {

class MaximalSystem;

inline double sign(double x) { return x < 0.0 ? -1.0 : 1.0; }

/// x' = a x + ..., mu = c x + ... of every vessel's memory and fast motion.
struct MemoryMatrices {
  MatXd a, c;
};
std::vector<MemoryMatrices> memory_matrices(const Model& model);
/// The same of the groups' memories, mu of all their motions.
std::vector<MemoryMatrices> group_matrices(const Model& model);
/// Sign of the memory's power at x; `x_rate` is scratch.
double memory_power_sign(const Vessel& vessel, const YawFrame<double>& frame, const double* x,
                         double* x_rate);

/// Slopes of some numbers in one direction.
inline void write_slopes(const std::vector<BodyResidual::Scalar>& numbers, int direction, double* out) {
  for (const auto& number : numbers) *out++ = number.slope[idx(direction)];
}

/// Into c, how the wave load changes with the vessel's fast motion.
void write_wave_slopes(const Vessel& vessel, const BodyResidual::WaveSlopes& slopes, MatXd& c);

/// Rotation vector (inertial axes) per change of the orientation's variables: 3 x 4 or 3 x 3.
using TurningMatrix = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 4>;
TurningMatrix turning(Orientation orientation, const double* angles);

/// Derivatives of the rate of the orientation's variables in these variables, and in the angular velocity.
struct TurningRate {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> in_angles;
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 4, 3> in_omega;
  TurningRate(Orientation orientation, const double* angles, const Vec3d& omega);
};

/// Exact Jacobian of dy/dt in maximal coordinates: with the slopes of the residual (BodyResidual),
/// M dvdot - D^T dlambda = dp, D dvdot = ds is solved with the factors of the evaluation, which are never
/// differentiated themselves.
class MaximalJacobian {
 public:
  explicit MaximalJacobian(const Model& model);

  /// Right after system.derivative(t, y, ...): writes df/dy by columns.
  void evaluate(MaximalSystem& system, double t, const double* y, double* out);

 private:
  void solve_column(double* column, double power, double absolute_power);
  void write_body_columns(int body, const double* y, double* out);
  void write_memory_columns(const double* y, double* out);
  void write_group_columns(std::size_t group, const double* y, Eigen::Map<MatXd>& jacobian);
  void respond_to_motions(std::size_t vessel, double direction);
  void write_state_columns(double* out);
  void write_pose_rates(const double* y, double* out) const;

  const Model* model_;
  MaximalSystem* system_ = nullptr;  // during an evaluation
  BodyResidual residual_;
  std::vector<MemoryMatrices> memory_;  // by vessel
  std::vector<MemoryMatrices> groups_;
  std::vector<Vec6d> load_, acceleration_;
  std::vector<double> given_, lambda_, column_;
  VecXd own_;       // changes of inertial tensions with accelerations held
  MatXd response_;  // to unit loads of the memory
};

}  // namespace seacrane
