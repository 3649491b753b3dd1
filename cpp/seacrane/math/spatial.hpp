#pragma once

#include "seacrane/math/types.hpp"

/// Spatial vectors of a rigid body [R. Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 2], linear
/// part first, in inertial axes about a point of the body. A vector `reach` leads from one point to another:
/// shifted_to(reach) moves a quantity from the first to the second, shifted_from(reach) back to the first.
/// Sums are typed: a wrench cannot be added to a twist.
namespace seacrane {

/// Velocity of the point and angular velocity of the body, or their rates.
template <class T>
class Twist {
 public:
  Twist() = default;  // not set, as Eigen's vectors
  template <class Expression>
  explicit Twist(const Eigen::MatrixBase<Expression>& v) : v_(v) {}
  Twist(const Vec3<T>& linear, const Vec3<T>& angular) {
    v_.template head<3>() = linear;
    v_.template tail<3>() = angular;
  }
  static Twist zero() { return Twist(Vec6<T>::Zero()); }
  static Twist unit(int i) { return Twist(Vec6<T>::Unit(i)); }

  auto linear() { return v_.template head<3>(); }
  auto linear() const { return v_.template head<3>(); }
  auto angular() { return v_.template tail<3>(); }
  auto angular() const { return v_.template tail<3>(); }
  const Vec6<T>& vector() const { return v_; }

  /// Of the point `reach` away: v + omega x reach. Of accelerations without the centripetal part.
  Twist shifted_to(const Vec3<T>& reach) const {
    Twist out = *this;
    const Vec3<T> turning = angular();
    out.linear() += cross<T>(turning, reach);
    return out;
  }

  Twist& operator+=(const Twist& b) {
    v_ += b.v_;
    return *this;
  }
  friend Twist operator*(const T& a, const Twist& b) { return Twist(a * b.v_); }

 private:
  Vec6<T> v_;
};

/// Force, and moment about the point.
template <class T>
class Wrench {
 public:
  Wrench() = default;  // not set
  template <class Expression>
  explicit Wrench(const Eigen::MatrixBase<Expression>& w) : w_(w) {}
  static Wrench zero() { return Wrench(Vec6<T>::Zero()); }

  auto force() const { return w_.template head<3>(); }
  auto moment() { return w_.template tail<3>(); }
  auto moment() const { return w_.template tail<3>(); }
  const Vec6<T>& vector() const { return w_; }

  /// Of a wrench about the end of `reach`, about its start: the moment grows by reach x force.
  Wrench shifted_from(const Vec3<T>& reach) const {
    Wrench out = *this;
    const Vec3<T> f = force();
    out.moment() += cross<T>(reach, f);
    return out;
  }
  /// *this += w.shifted_from(reach).
  void add_shifted_from(const Vec3<T>& reach, const Wrench& w) {
    w_ += w.w_;
    const Vec3<T> f = w.force();
    moment() += cross<T>(reach, f);
  }

  Wrench operator-() const { return Wrench(-w_); }
  Wrench& operator+=(const Wrench& b) {
    w_ += b.w_;
    return *this;
  }
  Wrench& operator-=(const Wrench& b) {
    w_ -= b.w_;
    return *this;
  }
  friend Wrench operator*(const T& a, const Wrench& b) { return Wrench(a * b.w_); }

 private:
  Vec6<T> w_;
};

/// Power, or a wrench along a direction of motion.
template <class T>
T dot(const Twist<T>& v, const Wrench<T>& w) {
  return v.vector().dot(w.vector());
}

/// Symmetric: wrench = inertia * acceleration.
template <class T>
class SpatialInertia {
 public:
  SpatialInertia() = default;  // not set
  explicit SpatialInertia(const Mat6<T>& m) : m_(m) {}
  SpatialInertia& operator=(const Mat6<T>& m) {  // in place, without a temporary
    m_ = m;
    return *this;
  }
  static SpatialInertia zero() { return SpatialInertia(Mat6<T>::Zero()); }

  const Mat6<T>& matrix() const { return m_; }

  /// *this += X^T I X, the inertia I about the end of `reach` seen from its start: X = [1, -reach x; 0, 1].
  void add_shifted_from(const Vec3<T>& reach, const SpatialInertia& inertia) {
    const Mat6<T>& i = inertia.m_;
    Eigen::Matrix<T, 6, 3> right;  // of I X
    right.col(0) = i.col(3) - reach[2] * i.col(1) + reach[1] * i.col(2);
    right.col(1) = i.col(4) - reach[0] * i.col(2) + reach[2] * i.col(0);
    right.col(2) = i.col(5) - reach[1] * i.col(0) + reach[0] * i.col(1);
    m_.template topLeftCorner<3, 3>() += i.template topLeftCorner<3, 3>();
    m_.template bottomLeftCorner<3, 3>() += right.template topRows<3>().transpose();
    for (int j = 0; j < 3; ++j) {
      const Vec3<T> force = right.col(j).template head<3>();
      m_.col(3 + j) += right.col(j);
      m_.col(3 + j).template tail<3>() += cross<T>(reach, force);
    }
  }
  /// *this -= a b^T.
  void subtract_outer(const Wrench<T>& a, const Wrench<T>& b) {
    for (int j = 0; j < 6; ++j) m_.col(j) -= b.vector()[j] * a.vector();
  }

  friend Wrench<T> operator*(const SpatialInertia& inertia, const Twist<T>& a) {
    return Wrench<T>(inertia.m_ * a.vector());
  }

 private:
  Mat6<T> m_;
};

}  // namespace seacrane
