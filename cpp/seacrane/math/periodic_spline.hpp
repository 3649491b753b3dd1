#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// Weights of a cubic spline at one place: left v[i] + right v[j] + bend_left c[i] + bend_right c[j], with v
/// the values at the knots and c the second derivatives there.
template <class T>
struct SplinePlace {
  std::size_t i = 0, j = 0;
  T left = T(1), right = T(0), bend_left = T(0), bend_right = T(0);
};

/// Knots of a periodic cubic spline over an angle. Values stay with their owner; `curvature` turns them into
/// second derivatives once (de Boor, A Practical Guide to Splines, ch. IV). At least three knots.
class PeriodicKnots {
 public:
  static constexpr double turn = 6.283185307179586476925;

  PeriodicKnots() = default;
  /// Increasing angles, rad, all within one turn; the caller has checked them.
  explicit PeriodicKnots(std::vector<double> angles);

  std::size_t size() const { return angles_.size(); }
  const std::vector<double>& angles() const { return angles_; }
  /// Matrix from values at the knots to second derivatives.
  MatXd curvature() const;

  template <class T>
  SplinePlace<T> place(const T& angle) const {
    using std::floor;
    const T x = angle - T(turn) * floor((angle - T(angles_.front())) / T(turn));
    const auto next = std::upper_bound(angles_.begin() + 1, angles_.end(), x);
    SplinePlace<T> p;
    p.i = static_cast<std::size_t>(next - angles_.begin()) - 1;
    p.j = p.i + 1 == angles_.size() ? 0 : p.i + 1;
    const double h = gaps_[p.i], bend = h * h / 6.0;
    p.right = (x - T(angles_[p.i])) / T(h);
    p.left = T(1) - p.right;
    p.bend_left = T(bend) * p.left * (p.left * p.left - T(1));
    p.bend_right = T(bend) * p.right * (p.right * p.right - T(1));
    return p;
  }

 private:
  std::vector<double> angles_, gaps_;
};

}  // namespace seacrane
