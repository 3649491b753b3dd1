#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "seacrane/dynamics/dense_kkt.hpp"
#include "seacrane/dynamics/dependence.hpp"
#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

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

/// Solves M a - D^T lambda = load, D a = right in maximal coordinates, for the terms last evaluated: by the
/// Schur complement S = D M^-1 D^T, block by block, where that is accurate. Lost digits come from light
/// bodies, where pivoted LU of the whole system keeps them, or from rows that depend on each other, in
/// redundant joints or near a singular position: there only the independent ones are enforced.
class ConstraintSolver {
 public:
  explicit ConstraintSolver(const Terms& terms);

  void factor();
  /// By the last factor(); acceleration and multipliers by body (ground last) and by row.
  void solve(const std::vector<Vec6d>& load, const std::vector<double>& right,
             std::vector<Vec6d>& acceleration, std::vector<double>& lambda);
  /// Solves with the paper's unsymmetric masses, which factor() leaves out, and factors them.
  void solve_unsymmetric(const std::vector<Vec6d>& load, const std::vector<double>& right,
                         std::vector<Vec6d>& acceleration, std::vector<double>& lambda);
  /// motion := M^-1 D^T S^-1 residual, the smallest one in the mass metric that removes the residual, which
  /// is used up.
  void correct(std::vector<double>& residual, std::vector<Vec6d>& motion);

  /// The largest S_ii / d_i at the last factor(): digits lost.
  double condition() const { return condition_; }
  /// Whether the Schur complement is accurate enough there.
  bool is_regular() const { return regular_; }
  /// Whether all rows are enforced there.
  bool enforces_all() const { return regular_ || !dependent_; }
  Dependence take_dependence();
  /// Whether combinations of rows that depend on the others can be left out: not in large systems.
  bool solves_dependent_rows() const { return row_space_.has_value(); }
  /// Factors. The singular value reported is the smallest but `skipped`.
  ConstraintRank rank(int skipped);

 private:
  void factor_dense();
  double shape_condition();
  int weakest_element(int combination) const;

  const Terms& terms_;
  const Model& model_;
  std::vector<Mat6d> over_mass_;
  std::vector<double> values_, multipliers_;
  std::vector<Vec6d> impulse_;
  std::optional<DenseKkt> dense_;
  std::optional<RowSpace> row_space_;
  std::vector<Mat6d> over_shape_, dense_mass_;
  std::vector<double> shape_values_;
  double condition_ = 1.0;
  bool regular_ = true;
  bool dependent_ = false;                  // not regular, and rows depend on each other
  int redundant_ = -1, most_left_out_ = 0;  // combinations of rows; -1: not known yet
};

}  // namespace seacrane
