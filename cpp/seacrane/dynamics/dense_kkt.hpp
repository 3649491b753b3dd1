#pragma once

#include <Eigen/LU>
#include <vector>

#include "seacrane/dynamics/joint_rows.hpp"

namespace seacrane {

struct ElementModel;

/// Pivoted LU of the whole system (9), equilibrated: slower than the Schur complement, but accurate
/// where that loses digits, and the only way for the paper's unsymmetric vessel block.
class DenseKkt {
 public:
  DenseKkt(int bodies, int rows);

  /// M vdot = load + D^T lambda, D vdot = gamma; `mass` is one 6 x 6 per body.
  void solve(const std::vector<ElementModel>& elements, const RowBlock<double>* blocks, const Mat6d* mass,
             const Vec6d* load, const double* gamma, Vec6d* acceleration, double* lambda);

 private:
  int velocities_, rows_;
  MatXd matrix_;
  VecXd right_, scale_;
  Eigen::PartialPivLU<MatXd> lu_;
};

/// Minimum-norm multipliers when constraints are redundant: S lambda = r with singular, consistent S.
class MinimumNormSolver {
 public:
  MinimumNormSolver(int bodies, int rows);

  /// Decomposes S = D M^-1 D^T (`over_mass` holds D M^-1 of each side); returns the rank found.
  int factor(const std::vector<ElementModel>& elements, const RowBlock<double>* blocks,
             const Mat6d* over_mass);
  void solve(double* x) const;
  /// Orthonormal basis of ker(D^T), columns; rows as the multipliers.
  const MatXd& null_space() const { return null_space_; }

 private:
  int bodies_, rows_;
  MatXd d_, dw_, s_, vectors_, null_space_;
  VecXd scale_, inverse_;
};

}  // namespace seacrane
