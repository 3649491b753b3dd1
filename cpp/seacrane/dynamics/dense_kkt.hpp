#pragma once

#include <vector>

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/math/dense.hpp"

namespace seacrane {

struct ElementModel;

/// Calls f(element, side, body) for every side of an element with rows that is not the ground.
template <class Elements, class F>
void for_each_side(const Elements& elements, int bodies, F&& f) {
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto& element = elements[e];
    if (element.rows == 0) continue;
    if (element.first < bodies) f(e, 0, element.first);
    if (element.second < bodies) f(e, 1, element.second);
  }
}

/// Independent combinations of constraint rows, found from geometry alone: every body counts with mass one
/// (its inertia divided by its mass), so that light bodies are not taken for redundancy.
class RowSpace {
 public:
  RowSpace(int bodies, int rows);

  /// Decomposes G = D M1^-1 D^T (`over_shape` holds D M1^-1 of each side), rows scaled to length one.
  /// Combinations whose singular value is below `cut` times the largest are left out. Returns the rank.
  int factor(const std::vector<ElementModel>& elements, const RowBlock<double>* blocks,
             const Mat6d* over_shape, double cut);
  int rank() const { return static_cast<int>(basis_.cols()); }
  /// basis()^T D are the independent rows; shape (rows, rank).
  const MatXd& basis() const { return basis_; }
  /// Orthonormal basis of what is left out, ker(D^T) when D is singular: shape (rows, rows - rank).
  const MatXd& null_space() const { return null_space_; }
  /// Singular values over the largest, in increasing order, and the combination of rows (of length one each)
  /// that one belongs to.
  double singular_value(int i) const { return singular_values_[i]; }
  auto combination(int i) const { return combinations_.col(i); }

 private:
  int bodies_, rows_;
  MatXd d_, over_shape_, basis_, null_space_, combinations_;
  VecXd singular_values_;
};

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
