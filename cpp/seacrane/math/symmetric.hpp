#pragma once

#include "seacrane/math/products.hpp"

namespace seacrane {

/// A symmetric 3 x 3 matrix by its six numbers.
template <class T>
struct Symmetric3 {
  T xx, yx, yy, zx, zy, zz;

  static Symmetric3 zero() { return {T(0), T(0), T(0), T(0), T(0), T(0)}; }
  [[gnu::always_inline]] static Symmetric3 diagonal(const T& a) { return {a, T(0), a, T(0), T(0), a}; }
  /// From a square block whose lower triangle alone is read.
  template <class Block>
  static Symmetric3 lower(const Block& m) {
    return {m(0, 0), m(1, 0), m(1, 1), m(2, 0), m(2, 1), m(2, 2)};
  }
  /// a b^T where that is symmetric.
  [[gnu::always_inline]] static Symmetric3 outer(const Vec3<T>& a, const Vec3<T>& b) {
    return {a[0] * b[0], a[1] * b[0], a[1] * b[1], a[2] * b[0], a[2] * b[1], a[2] * b[2]};
  }
  /// turned * rotation^T for turned = rotation * inertia.
  [[gnu::always_inline]] static Symmetric3 turned(const Mat3<T>& turned, const Mat3<T>& rotation) {
    const auto entry = [&](int i, int j) {
      return turned(i, 0) * rotation(j, 0) + turned(i, 1) * rotation(j, 1) + turned(i, 2) * rotation(j, 2);
    };
    return {entry(0, 0), entry(1, 0), entry(1, 1), entry(2, 0), entry(2, 1), entry(2, 2)};
  }

  [[gnu::always_inline]] Mat3<T> full() const {
    Mat3<T> out;
    write(out);
    return out;
  }
  /// To a square block, entry by entry.
  template <class Block>
  void write(Block&& to) const {
    to(0, 0) = xx, to(1, 1) = yy, to(2, 2) = zz;
    to(1, 0) = to(0, 1) = yx;
    to(2, 0) = to(0, 2) = zx;
    to(2, 1) = to(1, 2) = zy;
  }

  [[gnu::always_inline]] Symmetric3& operator+=(const Symmetric3& b) {
    xx += b.xx, yx += b.yx, yy += b.yy, zx += b.zx, zy += b.zy, zz += b.zz;
    return *this;
  }
  [[gnu::always_inline]] Symmetric3& operator-=(const Symmetric3& b) {
    xx -= b.xx, yx -= b.yx, yy -= b.yy, zx -= b.zx, zy -= b.zy, zz -= b.zz;
    return *this;
  }
  [[gnu::always_inline]] friend Vec3<T> operator*(const Symmetric3& a, const Vec3<T>& v) {
    return {a.xx * v[0] + a.yx * v[1] + a.zx * v[2], a.yx * v[0] + a.yy * v[1] + a.zy * v[2],
            a.zx * v[0] + a.zy * v[1] + a.zz * v[2]};
  }
};

}  // namespace seacrane
