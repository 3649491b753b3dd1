#pragma once

#include "seacrane/math/spatial.hpp"

namespace seacrane {

/// Masses that differ along the axes of a frame, and their moments about its origin.
template <class T>
struct LeverMasses {
  Vec3<T> mass = Vec3<T>::Zero();
  Mat3<T> first = Mat3<T>::Zero();               // sum of skew(lever) diag(mass)
  Symmetric3<T> second = Symmetric3<T>::zero();  // and that times skew(lever)^T

  template <class R>
  void add(const Vec3<R>& lever, const Vec3<T>& own) {
    const R x = lever.x(), y = lever.y(), z = lever.z();
    const T y0 = y * own[0], z0 = z * own[0], x1 = x * own[1], z1 = z * own[1], x2 = x * own[2],
            y2 = y * own[2];
    mass += own;
    first(1, 0) += z0, first(2, 0) -= y0, first(0, 1) -= z1;
    first(2, 1) += x1, first(0, 2) += y2, first(1, 2) -= x2;
    second +=
        {z * z1 + y * y2, T(0) - x * y2, z * z0 + x * x2, T(0) - x * z1, T(0) - y * z0, y * y0 + x * x1};
  }
  /// All that packs hold.
  template <class P>
  void add_lanes(const LeverMasses<P>& other) {
    for (int j = 0; j < 3; ++j) {
      mass[j] += total(other.mass[j]);
      for (int i = 0; i < 3; ++i) first(i, j) += total(other.first(i, j));
    }
    const Symmetric3<P>& s = other.second;
    second += {total(s.xx), total(s.yx), total(s.yy), total(s.zx), total(s.zy), total(s.zz)};
  }
  /// To the inertia of a body, from the frame of these axes at its state point.
  void add_to(const Mat3<T>& axes, Mat6<T>& to) const {
    const auto turned = [&](const Mat3<T>& own) -> Mat3<T> { return axes * own * axes.transpose(); };
    const Mat3<T> moved = turned(first);
    to.template topLeftCorner<3, 3>() += turned(mass.asDiagonal());
    to.template bottomLeftCorner<3, 3>() += moved;
    to.template topRightCorner<3, 3>() += moved.transpose();
    to.template bottomRightCorner<3, 3>() += turned(second.full());
  }
};

}  // namespace seacrane
