#pragma once

#include <vector>

#include "seacrane/dynamics/terms.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

class Terms;

/// Largest absolute residuals of all constraints.
struct ConstraintResidual {
  double position = 0.0, rate = 0.0;
};

/// Evaluates the rows of every joint and driver, each kind with its like; `blocks` by element.
void evaluate_constraints(const Model& model, double t, double curve_limit,
                          const BodyKinematics<double>* bodies, RowBlock<double>* blocks);

// With the rows that `terms` last evaluated.

/// phi, the largest magnitude.
double position_residual(const Terms& terms);
/// D v - nu by row for the twists in y; returns the largest magnitude.
double rate_residual(const Terms& terms, const double* y, double* out);
/// Both, without the rows.
ConstraintResidual constraint_residual(const Terms& terms, const double* y);
/// Evaluates the terms at (t, y) first.
ConstraintResidual constraint_residual(Terms& terms, double t, const double* y);
/// out := D^T lambda by body, ground last.
void multiplier_load(const Terms& terms, const double* lambda, std::vector<Vec6d>& out);

/// Residual, m or rad, below which projection leaves positions as they are: 1e-13, but less where bodies turn
/// fast. A residual that is left makes speeds jump when it is closed, by the residual times the turning rate;
/// the history of a multistep method does not survive jumps beyond its tolerance.
double position_tolerance(const BodyKinematics<double>* bodies, int count);

/// The force of a limit that holds, from the multipliers `lambda` of the model of `terms`, positive in the
/// direction in which it can act: tension of a wire, push of a stop, pressure on a seat.
double limit_force(const Limit& limit, const Terms& terms, const double* lambda);

}  // namespace seacrane
