#pragma once

#include <vector>

#include "seacrane/dynamics/row_space.hpp"
#include "seacrane/math/dense.hpp"

namespace seacrane {

struct MassCoupling;

/// Pivoted LU of the whole system (9), equilibrated: slower than the Schur complement, but accurate
/// where that loses digits, the way through singular positions and redundant joints (with a RowSpace),
/// and the only one for the paper's unsymmetric vessel block.
class DenseKkt {
 public:
  DenseKkt(int bodies, int rows);

  /// `mass` is one 6 x 6 per body; `independent` restricts the rows, null when all are independent.
  void factor(const std::vector<ElementModel>& elements, const RowBlock<double>* blocks, const Mat6d* mass,
              const std::vector<MassCoupling>& couplings, const RowSpace* independent);
  /// M vdot = load + D^T lambda, D vdot = right; without `load` it is zero. Multipliers are the shortest
  /// ones when rows are left out.
  void solve(const Vec6d* load, const double* right, Vec6d* acceleration, double* lambda);

 private:
  int velocities_, rows_;
  MatXd matrix_, d_, reduced_;
  VecXd right_, solved_, scale_;
  const RowSpace* independent_ = nullptr;
  Eigen::PartialPivLU<MatXd> lu_;
};

}  // namespace seacrane
