#pragma once

namespace seacrane {

struct Model;

/// S_ii / d_i, what a row of the Schur complement S = D M^-1 D^T has over what the rows before it leave of
/// it, beyond which S has lost too many digits and something else takes over.
inline constexpr double kInaccuratePivot = 1e5;
/// The bound of this ratio with every mass one. Beyond it, rows may depend on each other by geometry alone.
inline constexpr double kDependentPivot = 1e7;
/// Relative singular value of D, every mass one, below which a combination of rows is not enforced.
/// Change-point four-bars pass their singular position onto the right branch with 1e-4, and lose it with
/// 1e-6.
inline constexpr double kEnforcedSingularValue = 1e-4;
/// This bound for an eigenvalue of D M^-1 D^T.
inline constexpr double kEnforcedEigenvalue = kEnforcedSingularValue * kEnforcedSingularValue;
/// Relative singular value below which rows are redundant, as an assembled model reports.
inline constexpr double kRedundantSingularValue = 3e-6;

/// How near constraint rows are to depending on each other, beyond those that do from the start.
struct Dependence {
  double ratio = 0.0;  // the inverse of what is left of the worst row, at the last factorisation; 0: no rows
  int redundant = 0;   // combinations of rows that depend on the others from the start
  int left_out = 0;    // those not enforced at the last factorisation
  int most_left_out = 0;  // the same, at any since it was taken last

  bool lost_rank() const { return most_left_out > redundant; }
  /// The start was the singular position.
  bool gained_rank() const { return left_out < redundant; }
};

/// Combinations of rows that depend on the others in the assembled model; of a model that was not assembled,
/// another set of limits, the fewest left out so far, `known` (-1: none yet) or `left_out`.
int redundant_rows(const Model& model, int known, int left_out);

}  // namespace seacrane
