#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "seacrane/dynamics/dense_kkt.hpp"
#include "seacrane/dynamics/dependence.hpp"
#include "seacrane/dynamics/kept_rows.hpp"
#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

/// Unknowns, six a body and one a row, above which the dense fall-back would not be affordable.
constexpr int kDenseLimit = 1500;
/// Rows above which those that depend on others are told by the pivots of S alone, which is sparse.
constexpr int kManyRows = 64;

/// Rank of D at one state and the largest S_ii / d_i of the rows that are kept. The smallest singular value
/// over the largest that is asked for, by geometry alone, with the element that takes the largest part in
/// that combination of rows (NaN and -1 where rows are many).
struct ConstraintRank {
  int rank = 0;
  VecXd shared;                // by row: its part in combinations that depend on others; empty: no such
  std::vector<char> left_out;  // by row, where rows are many and depend on each other
  double condition = 0.0;
  double smallest_singular_value = std::numeric_limits<double>::quiet_NaN();
  int weakest = -1;
};

/// Solves M a - D^T lambda = load, D a = right in maximal coordinates, for the terms last evaluated: by the
/// Schur complement S = D M^-1 D^T, block by block, where that is accurate. Lost digits come from light
/// bodies, where pivoted LU of the whole system keeps them, or from rows that depend on each other, in
/// redundant joints or near a singular position: there only the independent ones are enforced. Of many rows,
/// those that the others hold are left out of S as long as they do.
class ConstraintSolver {
 public:
  explicit ConstraintSolver(const Terms& terms);

  /// Tells at each factor() which of many rows depend on others, while a model is assembled.
  void choose_rows_at_each_pose() { chooses_ = has_many_rows(); }
  bool has_many_rows() const;
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
  /// Takes from multipliers, at the pose of the last factor(), what loads no body: of many rows, those left
  /// out have none of their own.
  void shorten(std::vector<double>& lambda);
  /// Whether rows that were left out of S do not hold under accelerations by body, ground last.
  bool misses(const std::vector<Vec6d>& acceleration) const;
  /// With rows told anew at this pose, after misses().
  void factor_anew();
  Dependence take_dependence();
  /// Whether any combinations of rows that depend on the others can be left out: not in large systems.
  bool solves_dependent_rows() const { return row_space_.has_value(); }
  /// Factors. The singular value reported is the smallest but `skipped`.
  ConstraintRank rank(int skipped);

 private:
  void factor_dense();
  void add_over_mass(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) const;
  void assemble();
  void assemble_shape();
  void choose_here(double most);
  ConstraintRank rank_of_many();
  VecXd shared_rows();
  const MatXd& null_space(double* factored, const std::vector<char>& left_out);
  int weakest_element(int combination) const;

  const Terms& terms_;
  const Model& model_;
  std::vector<Mat6d> over_mass_;  // of sides, then of crossings
  std::vector<double> values_, multipliers_;
  std::vector<Vec6d> impulse_;
  std::optional<DenseKkt> dense_;
  std::optional<RowSpace> row_space_;
  std::vector<Mat6d> over_shape_, dense_mass_;
  std::vector<double> shape_values_;
  MatXd null_space_;
  LeftOutRows others_hold_;
  std::vector<char> here_;  // rows left out, where they were told at the pose of the last factor()
  bool chooses_ = false;
  double condition_ = 1.0;
  bool regular_ = true;
  bool dependent_ = false;                  // not regular, and rows depend on each other
  int left_out_ = 0;                        // rows or combinations, at the last factor()
  int redundant_ = -1, most_left_out_ = 0;  // combinations of rows; -1: not known yet
};

}  // namespace seacrane
