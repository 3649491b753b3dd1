#pragma once

#include <vector>

#include "seacrane/dynamics/body_residual.hpp"
#include "seacrane/dynamics/jacobian.hpp"

namespace seacrane {

/// Exact F_y + c F_y' of the stabilised index-2 form (GearGuptaLeimkuhler), by columns: y = (state, lambda,
/// mu), F = (pose rates, balance over M0, memory, work, velocity constraints, position constraints).
/// Allocates nothing after construction.
class ResidualJacobian {
 public:
  explicit ResidualJacobian(const Model& model);

  /// Right after terms.evaluate(t, y, ...).
  void evaluate(const Terms& terms, double t, double c, const double* y, const double* ydot, double* out);

 private:
  void write_body_columns(int body, const double* y, Eigen::Map<MatXd>& out);
  void write_memory_columns(const double* y, Eigen::Map<MatXd>& out);
  void write_group_columns(std::size_t group, const double* y, Eigen::Map<MatXd>& out);
  void write_load_rates(int direction, double* column) const;
  void write_state_columns(Eigen::Map<MatXd>& out);
  void write_multiplier_columns(const double* y, Eigen::Map<MatXd>& out);
  void write_rate_terms(double c, Eigen::Map<MatXd>& out) const;
  void add_pose_rates(int body, const double* angles, const Vec6d& velocity, double* column) const;
  Vec6d over_mass(int body, const Vec6d& load) const;

  const Model* model_;
  const Terms* terms_ = nullptr;  // during an evaluation
  BodyResidual residual_;
  std::vector<MemoryMatrices> memory_;  // by vessel
  std::vector<MemoryMatrices> groups_;
  std::vector<Vec6d> acceleration_, correction_;
  VecXd column_;
};

}  // namespace seacrane
