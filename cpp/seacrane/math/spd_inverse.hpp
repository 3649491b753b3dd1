#pragma once

#include <Eigen/Core>

#include "seacrane/math/spatial.hpp"

namespace seacrane {

/// A small symmetric positive definite matrix, of which only the lower triangle is read, as L D L^T. Loops of
/// constant length, which the compiler unrolls; a general solver spends several times as much on finding out
/// how small the matrix is.
template <int n, class T>
struct SpdFactor {
  using Square = Eigen::Matrix<T, n, n>;

  Square l;  // below the diagonal L
  T over_pivot[n];

  SpdFactor() = default;  // not set
  explicit SpdFactor(const Square& a) : l(a) {
#pragma GCC unroll 6
    for (int j = 0; j < n; ++j) {
      over_pivot[j] = T(1) / l(j, j);
#pragma GCC unroll 6
      for (int k = j + 1; k < n; ++k) {
        const T factor = l(k, j) * over_pivot[j];
#pragma GCC unroll 6
        for (int i = k; i < n; ++i) l(i, k) -= factor * l(i, j);
      }
#pragma GCC unroll 6
      for (int i = j + 1; i < n; ++i) l(i, j) *= over_pivot[j];
    }
  }
};

/// An inertia M H; H^T C factored in its blocks, by one division each: M^-1, M^-1 H, and the inverse of
/// C - H^T M^-1 H. Where moving and turning are apart, H = 0, they give the same numbers as either alone.
template <class T>
class InertiaFactor {
 public:
  void take(const CompactInertia<T>& inertia) {
    is_apart_ = true;
    moving_ = Symmetric3<T>::diagonal(T(1) / inertia.mass);
    turning_ = inertia.turning.inverse();
  }
  void take(const SpatialInertia<T>& inertia) {
    is_apart_ = inertia.is_apart();
    moving_ = inertia.moving().inverse();
    if (is_apart_) {
      turning_ = inertia.turning().inverse();
      return;
    }
    const Mat3<T>& h = inertia.coupling();
    for (int j = 0; j < 3; ++j) carried_.col(j) = moving_ * Vec3<T>(h.col(j));
    const auto less = [&](int i, int j) { return dot<T>(h.col(i), carried_.col(j)); };
    Symmetric3<T> left = inertia.turning();
    left -= {less(0, 0), less(1, 0), less(1, 1), less(2, 0), less(2, 1), less(2, 2)};
    turning_ = left.inverse();
  }

  /// The acceleration under a wrench.
  Twist<T> solve(const Wrench<T>& w) const {
    if (is_apart_) return {moving_ * w.force(), turning_ * w.moment()};
    const Vec3<T> turning = turning_ * Vec3<T>(w.moment() - times_transposed<T>(carried_, w.force()));
    return {moving_ * w.force() - times<T>(carried_, turning), turning};
  }

 private:
  bool is_apart_ = true;
  Symmetric3<T> moving_, turning_;
  Mat3<T> carried_;  // M^-1 H
};

/// Inverse of such a matrix: L^-T D^-1 L^-1.
template <int n, class T>
Eigen::Matrix<T, n, n> spd_inverse(const Eigen::Matrix<T, n, n>& a) {
  using Square = Eigen::Matrix<T, n, n>;
  const SpdFactor<n, T> factor(a);
  const Square& l = factor.l;
  Square w;  // below the diagonal L^-1
#pragma GCC unroll 6
  for (int j = 0; j < n; ++j) {
#pragma GCC unroll 6
    for (int i = j + 1; i < n; ++i) {
      T sum = -l(i, j);
#pragma GCC unroll 6
      for (int k = j + 1; k < i; ++k) sum -= l(i, k) * w(k, j);
      w(i, j) = sum;
    }
  }
  Square out;
#pragma GCC unroll 6
  for (int j = 0; j < n; ++j) {
#pragma GCC unroll 6
    for (int i = j; i < n; ++i) {
      T sum = i == j ? factor.over_pivot[i] : factor.over_pivot[i] * w(i, j);
#pragma GCC unroll 6
      for (int k = i + 1; k < n; ++k) sum += w(k, i) * factor.over_pivot[k] * w(k, j);
      out(i, j) = sum;
      out(j, i) = sum;
    }
  }
  return out;
}

}  // namespace seacrane
