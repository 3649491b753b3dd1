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
  using Vector = Eigen::Matrix<T, n, 1>;

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

  Vector solve(Vector x) const {
#pragma GCC unroll 6
    for (int j = 0; j < n; ++j) {
#pragma GCC unroll 6
      for (int i = j + 1; i < n; ++i) x[i] -= l(i, j) * x[j];
    }
#pragma GCC unroll 6
    for (int j = n - 1; j >= 0; --j) {
      x[j] *= over_pivot[j];
#pragma GCC unroll 6
      for (int i = j + 1; i < n; ++i) x[j] -= l(i, j) * x[i];
    }
    return x;
  }
};

/// The factors of an inertia; of one whose moving and turning are apart those of either alone, which are the
/// same numbers.
template <class T>
class InertiaFactor {
 public:
  void take(const CompactInertia<T>& inertia) {
    take_apart(Symmetric3<T>::diagonal(inertia.mass), inertia.turning);
  }
  void take(const SpatialInertia<T>& inertia) {
    if (inertia.is_apart()) return take_apart(inertia.moving(), inertia.turning());
    is_apart_ = false;
    whole_ = SpdFactor<6, T>(inertia.matrix());
  }

  Vec6<T> solve(const Vec6<T>& x) const {
    if (!is_apart_) return whole_.solve(x);
    Vec6<T> out;
    out.template head<3>() = moving_.solve(x.template head<3>());
    out.template tail<3>() = turning_.solve(x.template tail<3>());
    return out;
  }

 private:
  void take_apart(const Symmetric3<T>& moving, const Symmetric3<T>& turning) {
    is_apart_ = true;
    moving_ = SpdFactor<3, T>(moving.full());
    turning_ = SpdFactor<3, T>(turning.full());
  }

  bool is_apart_ = true;
  SpdFactor<3, T> moving_, turning_;
  SpdFactor<6, T> whole_;
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
