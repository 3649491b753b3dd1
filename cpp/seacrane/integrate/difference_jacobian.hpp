#pragma once

#include <algorithm>
#include <vector>

#include "seacrane/integrate/error_norm.hpp"
#include "seacrane/integrate/integrator.hpp"
#include "seacrane/integrate/problem.hpp"

namespace seacrane {

/// Increment for a one-sided difference quotient in a component of value y that a step changes by
/// `step_change` and whose changes have a `typical` size: in the direction of the change, exactly
/// representable.
double difference_increment(double y, double step_change, double typical);

/// Whether the system wrote its own, finite Jacobian at (t, y), by columns; counts the evaluation it takes.
bool exact_jacobian(System& system, double t, const double* y, double* out, Counters& counters);

/// Jacobian of f at (t, y) by columns: `evaluate(y, f)` returns 0, `column(j)` is where column j goes. Stops
/// at the first other value of `evaluate` and returns it. `h * slope` is the change of y that a step makes;
/// `trial` and `trial_slope` are scratch of the size of y.
template <class Evaluate, class Column>
int difference_jacobian(const double* y, const double* slope, double h, const ErrorNorm& norm,
                        std::vector<double>& trial, std::vector<double>& trial_slope, Evaluate&& evaluate,
                        Column&& column) {
  const std::size_t n = norm.size();
  std::copy_n(y, n, trial.data());
  for (std::size_t j = 0; j < n; ++j) {
    const double increment = difference_increment(y[j], h * slope[j], norm.typical(j));
    trial[j] = y[j] + increment;
    const int flag = evaluate(trial.data(), trial_slope.data());
    if (flag != 0) return flag;
    trial[j] = y[j];
    double* const quotients = column(j);
    for (std::size_t i = 0; i < n; ++i) quotients[i] = (trial_slope[i] - slope[i]) / increment;
  }
  return 0;
}

}  // namespace seacrane
