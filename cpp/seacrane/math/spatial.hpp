#pragma once

#include "seacrane/math/symmetric.hpp"

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
  Wrench(const Vec3<T>& force, const Vec3<T>& moment) {
    w_.template head<3>() = force;
    w_.template tail<3>() = moment;
  }
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

/// Inertia of a rigid body about its centre of mass, or of what is as plain: wrench = inertia * acceleration.
template <class T>
struct CompactInertia {
  T mass;
  Symmetric3<T> turning;

  friend Wrench<T> operator*(const CompactInertia& inertia, const Twist<T>& a) {
    return {inertia.mass * a.linear(), inertia.turning * Vec3<T>(a.angular())};
  }
};

/// Symmetric, in blocks of forces and moments: wrench = inertia * acceleration.
template <class T>
class SpatialInertia {
 public:
  SpatialInertia() = default;  // not set
  /// Of a matrix of which only the lower triangle is read.
  explicit SpatialInertia(const Mat6<T>& m) { *this = m; }
  explicit SpatialInertia(const CompactInertia<T>& inertia) { *this = inertia; }
  SpatialInertia& operator=(const Mat6<T>& m) {
    moving_ = Symmetric3<T>::lower(m.template topLeftCorner<3, 3>());
    coupling_ = m.template bottomLeftCorner<3, 3>().transpose();
    turning_ = Symmetric3<T>::lower(m.template bottomRightCorner<3, 3>());
    return *this;
  }
  SpatialInertia& operator=(const CompactInertia<T>& inertia) {
    moving_ = Symmetric3<T>::diagonal(inertia.mass);
    coupling_.setZero();
    turning_ = inertia.turning;
    return *this;
  }
  static SpatialInertia zero() { return SpatialInertia(Mat6<T>(Mat6<T>::Zero())); }

  Mat6<T> matrix() const {
    Mat6<T> out;
    out << moving_.full(), coupling_, coupling_.transpose(), turning_.full();
    return out;
  }

  /// *this += X^T I X, the inertia I about the end of `reach` seen from its start: X = [1, -reach x; 0, 1].
  void add_shifted_from(const Vec3<T>& reach, const SpatialInertia& inertia) {
    const Mat3<T>& h = inertia.coupling_;
    const Mat3<T> moving = inertia.moving_.full();
    Mat3<T> k;  // coupling about the start: H - M (reach x)
    k.col(0) = h.col(0) - reach[2] * moving.col(1) + reach[1] * moving.col(2);
    k.col(1) = h.col(1) - reach[0] * moving.col(2) + reach[2] * moving.col(0);
    k.col(2) = h.col(2) - reach[1] * moving.col(0) + reach[0] * moving.col(1);
    // (reach x) K + ((reach x) H)^T
    const auto crossed = [&](const Mat3<T>& m, int i, int j) {
      const int next = (i + 1) % 3, last = (i + 2) % 3;
      return reach[next] * m(last, j) - reach[last] * m(next, j);
    };
    const auto gained = [&](int i, int j) { return crossed(k, i, j) + crossed(h, j, i); };
    moving_ += inertia.moving_;
    coupling_ += k;
    turning_ += inertia.turning_;
    turning_ +=
        Symmetric3<T>{gained(0, 0), gained(1, 0), gained(1, 1), gained(2, 0), gained(2, 1), gained(2, 2)};
  }
  void add_shifted_from(const Vec3<T>& reach, const CompactInertia<T>& inertia) {
    const T& m = inertia.mass;
    const Vec3<T> moment = m * reach;
    moving_ += Symmetric3<T>::diagonal(m);
    coupling_(0, 1) += moment[2], coupling_(1, 0) -= moment[2];
    coupling_(1, 2) += moment[0], coupling_(2, 1) -= moment[0];
    coupling_(2, 0) += moment[1], coupling_(0, 2) -= moment[1];
    turning_ += inertia.turning;
    turning_ += Symmetric3<T>::diagonal(moment.dot(reach));
    turning_ -= Symmetric3<T>::outer(moment, reach);
  }
  /// *this -= a b^T, or a sum of such products of which only the whole is symmetric.
  void subtract_outer(const Wrench<T>& a, const Wrench<T>& b) {
    const Vec3<T> a_force = a.force(), a_moment = a.moment(), b_force = b.force(), b_moment = b.moment();
    moving_ -= Symmetric3<T>::outer(a_force, b_force);
    for (int j = 0; j < 3; ++j) coupling_.col(j) -= b_moment[j] * a_force;
    turning_ -= Symmetric3<T>::outer(a_moment, b_moment);
  }

  friend Wrench<T> operator*(const SpatialInertia& inertia, const Twist<T>& a) {
    const Vec3<T> linear = a.linear(), angular = a.angular();
    const Vec3<T> force = inertia.moving_ * linear + inertia.coupling_ * angular;
    const Vec3<T> moment = inertia.coupling_.transpose() * linear + inertia.turning_ * angular;
    return {force, moment};
  }

 private:
  Symmetric3<T> moving_, turning_;
  Mat3<T> coupling_;  // forces for turning
};

}  // namespace seacrane
