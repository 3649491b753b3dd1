#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace seacrane {

/// Error tolerances: |error_i| is measured against absolute[i] + (relative + growth[i]) * |y_i|, but never
/// against less than the rounding of y_i, which no method can tell.
struct Tolerances {
  double relative;
  /// One value per component, or a single one for all. Infinity takes a component (a quadrature of
  /// work, say) out of the error norm.
  std::vector<double> absolute;
  /// Systems side by side, component i of lane j number i x lanes + j: 1, 4 or 8.
  std::size_t lanes = 1;
  /// One value per component; empty: none grows.
  std::vector<double> growth = {};
};

/// Root mean square of an error over the included components, each divided by its tolerance; of lanes that of
/// the lane where it is largest.
class ErrorNorm {
 public:
  /// Throws std::invalid_argument on a wrong count or a value that is not a tolerance.
  ErrorNorm(const Tolerances& tolerances, std::size_t size);

  /// A number for each lane, and none beyond.
  using Lanes = std::array<double, 8>;

  std::size_t size() const { return absolute_.size(); }
  std::size_t lanes() const { return lanes_; }
  double relative() const { return relative_; }
  const double* absolute() const { return absolute_.data(); }
  /// What an error of component i is measured against, where its magnitude is `size`.
  double tolerance(std::size_t i, double size) const {
    const double asked = absolute_[i] + growth_[i] * size;
    return std::max(asked, std::min(rounding * size, most_eased * asked));
  }
  /// 1 / (number of components in the norm), those of one lane.
  double inverse_count() const { return inverse_count_; }

  /// The largest of an array with a number for each lane, f.template operator()<lanes>(); NaN where one is.
  template <class F>
  double largest(F&& f) const {
    switch (lanes_) {
      case 4:
        return largest_of(f.template operator()<4>());
      case 8:
        return largest_of(f.template operator()<8>());
      default:
        return f.template operator()<1>()[0];
    }
  }

  /// Norm of `vector` at the state y.
  double norm(const double* vector, const double* y) const;
  /// The norm of each lane.
  Lanes norms(const double* vector, const double* y) const;
  /// Norm of y over the tolerances alone, without regard to rounding.
  double over_tolerances(const double* y) const;
  /// Norm of a - b at the state a.
  double distance(const double* a, const double* b) const;
  /// The distance of each lane.
  Lanes distances(const double* a, const double* b) const;
  /// Reciprocal tolerances w, scaled so that sqrt(mean over all components of (w e)^2) is norm(e).
  void weights(const double* y, double* w) const;
  /// A size that changes of component i can be expected to have: for difference quotients.
  double typical(std::size_t i) const;

 private:
  /// The rounding of an evaluation and of the sums over a step, relative to the value.
  static constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  /// Tolerances further below rounding are no oversight: steps collapse, and say so.
  static constexpr double most_eased = 1e4;

  template <std::size_t lanes>
  static double largest_of(const std::array<double, lanes>& values) {
    double out = 0.0;
    for (const double value : values) {
      if (std::isnan(value)) return value;
      out = std::max(out, value);
    }
    return out;
  }
  template <std::size_t lanes, class Ratio>
  std::array<double, lanes> sums(const Ratio& ratio) const;
  template <class Ratio>
  double root_mean_square(const Ratio& ratio) const;
  template <class Ratio>
  Lanes root_mean_squares(const Ratio& ratio) const;

  double relative_;
  std::vector<double> absolute_, growth_;  // the relative tolerance is part of each growth
  std::size_t lanes_;
  double inverse_count_;
  double weight_scale_;
};

/// True when no component is infinite or NaN.
bool all_finite(const double* values, std::size_t size);
/// Index of the first infinite or NaN component, or IntegrationError::no_component.
std::size_t first_non_finite(const double* values, std::size_t size);

}  // namespace seacrane
