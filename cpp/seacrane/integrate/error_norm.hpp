#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace seacrane {

/// Error tolerances: |error_i| is measured against absolute[i] + relative * |y_i|, but never against less
/// than the rounding of y_i, which no method can tell.
struct Tolerances {
  double relative;
  /// One value per component, or a single one for all. Infinity takes a component (a quadrature of
  /// work, say) out of the error norm.
  std::vector<double> absolute;
};

/// Root mean square of an error over the included components, each divided by its tolerance.
class ErrorNorm {
 public:
  /// Throws std::invalid_argument on a wrong count or a value that is not a tolerance.
  ErrorNorm(const Tolerances& tolerances, std::size_t size);

  std::size_t size() const { return absolute_.size(); }
  double relative() const { return relative_; }
  const double* absolute() const { return absolute_.data(); }
  /// What an error of component i is measured against, where its magnitude is `size`.
  double tolerance(std::size_t i, double size) const {
    const double asked = absolute_[i] + relative_ * size;
    return std::max(asked, std::min(rounding * size, most_eased * asked));
  }
  /// 1 / (number of components in the norm).
  double inverse_count() const { return inverse_count_; }

  /// Norm of `vector` at the state y.
  double norm(const double* vector, const double* y) const;
  /// Norm of y over the tolerances alone, without regard to rounding.
  double over_tolerances(const double* y) const;
  /// Norm of a - b at the state a.
  double distance(const double* a, const double* b) const;
  /// Reciprocal tolerances w, scaled so that sqrt(mean over all components of (w e)^2) is norm(e).
  void weights(const double* y, double* w) const;
  /// A size that changes of component i can be expected to have: for difference quotients.
  double typical(std::size_t i) const;

 private:
  /// Of an evaluation and of the sums over a step, relative to the value.
  static constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  /// Tolerances further below rounding are no oversight: steps collapse, and say so.
  static constexpr double most_eased = 1e4;

  double relative_;
  std::vector<double> absolute_;
  double inverse_count_;
  double weight_scale_;
};

/// True when no component is infinite or NaN.
bool all_finite(const double* values, std::size_t size);
/// Index of the first infinite or NaN component, or IntegrationError::no_component.
std::size_t first_non_finite(const double* values, std::size_t size);

}  // namespace seacrane
