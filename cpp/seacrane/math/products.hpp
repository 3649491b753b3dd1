#pragma once

#include "seacrane/math/types.hpp"

/// Products of 3-vectors and 3 x 3 matrices, written out: Eigen's loops over so few numbers are not always
/// inlined, and constants need no conversion to the scalar.
namespace seacrane {

template <class T>
[[gnu::always_inline]] inline T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T, class S = T>
[[gnu::always_inline]] inline Vec3<T> times(const Mat3<T>& m, const Vec3<S>& v) {
  const T x(v[0]), y(v[1]), z(v[2]);
  return {m(0, 0) * x + m(0, 1) * y + m(0, 2) * z, m(1, 0) * x + m(1, 1) * y + m(1, 2) * z,
          m(2, 0) * x + m(2, 1) * y + m(2, 2) * z};
}

template <class T>
[[gnu::always_inline]] inline Vec3<T> times_transposed(const Mat3<T>& m, const Vec3<T>& v) {
  return {m(0, 0) * v[0] + m(1, 0) * v[1] + m(2, 0) * v[2], m(0, 1) * v[0] + m(1, 1) * v[1] + m(2, 1) * v[2],
          m(0, 2) * v[0] + m(1, 2) * v[1] + m(2, 2) * v[2]};
}

/// a b.
template <class T>
[[gnu::always_inline]] inline Mat3<T> times(const Mat3<T>& a, const Mat3d& b) {
  Mat3<T> out;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i)
      out(i, j) = a(i, 0) * T(b(0, j)) + a(i, 1) * T(b(1, j)) + a(i, 2) * T(b(2, j));
  }
  return out;
}

/// a b^T.
template <class T>
[[gnu::always_inline]] inline Mat3<T> times_transpose(const Mat3<T>& a, const Mat3d& b) {
  Mat3<T> out;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i)
      out(i, j) = a(i, 0) * T(b(j, 0)) + a(i, 1) * T(b(j, 1)) + a(i, 2) * T(b(j, 2));
  }
  return out;
}

}  // namespace seacrane
