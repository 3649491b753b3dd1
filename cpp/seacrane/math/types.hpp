#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>

namespace seacrane {

template <class T>
using Vec3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Vec4 = Eigen::Matrix<T, 4, 1>;
template <class T>
using Vec6 = Eigen::Matrix<T, 6, 1>;
template <class T>
using Mat3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Mat6 = Eigen::Matrix<T, 6, 6>;

using Vec3d = Vec3<double>;
using Vec4d = Vec4<double>;
using Vec6d = Vec6<double>;
using Mat3d = Mat3<double>;
using Mat6d = Mat6<double>;
using VecXd = Eigen::VectorXd;
using MatXd = Eigen::MatrixXd;

/// An int as an index of a standard container.
constexpr std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// A fixed-size vector over plain memory.
template <int N>
Eigen::Map<Eigen::Matrix<double, N, 1>> view(double* p) {
  return Eigen::Map<Eigen::Matrix<double, N, 1>>(p);
}
template <int N>
Eigen::Map<const Eigen::Matrix<double, N, 1>> view(const double* p) {
  return Eigen::Map<const Eigen::Matrix<double, N, 1>>(p);
}

/// Cross-product matrix: skew(a) b = a x b.
template <class T>
Mat3<T> skew(const Vec3<T>& a) {
  Mat3<T> s;
  s << T(0), -a.z(), a.y(), a.z(), T(0), -a.x(), -a.y(), a.x(), T(0);
  return s;
}

template <class T>
[[gnu::always_inline]] inline Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

}  // namespace seacrane
