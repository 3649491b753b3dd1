#pragma once

#include <type_traits>

#include "seacrane/math/products.hpp"

/// Spatial vectors of a rigid body [R. Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 2], linear
/// part first, in inertial axes about a point of the body. A vector `reach` leads from one point to another:
/// shifted_to(reach) moves a quantity from the first to the second, shifted_from(reach) back to the first.
/// Sums are typed: a wrench cannot be added to a twist.

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

  /// By cofactors: one division, where a factorisation waits for three.
  [[gnu::always_inline]] Symmetric3 inverse() const {
    const T a = yy * zz - zy * zy, b = zx * zy - yx * zz, c = yx * zy - yy * zx;
    const T over = T(1) / (xx * a + yx * b + zx * c);
    return {over * a,
            over * b,
            over * (xx * zz - zx * zx),
            over * c,
            over * (yx * zx - xx * zy),
            over * (xx * yy - yx * yx)};
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

/// Velocity of the point and angular velocity of the body, or their rates.
template <class T>
class Twist {
 public:
  Twist() = default;  // not set, as Eigen's vectors
  template <class Expression>
  explicit Twist(const Eigen::MatrixBase<Expression>& v) : Twist(Vec6<T>(v)) {}
  explicit Twist(const Vec6<T>& v) : linear_(v[0], v[1], v[2]), angular_(v[3], v[4], v[5]) {}
  Twist(const Vec3<T>& linear, const Vec3<T>& angular) : linear_(linear), angular_(angular) {}
  static Twist zero() { return Twist(Vec3<T>::Zero(), Vec3<T>::Zero()); }
  static Twist unit(int i) { return Twist(Vec6<T>(Vec6<T>::Unit(i))); }

  Vec3<T>& linear() { return linear_; }
  const Vec3<T>& linear() const { return linear_; }
  Vec3<T>& angular() { return angular_; }
  const Vec3<T>& angular() const { return angular_; }
  Vec6<T> vector() const {
    return {linear_[0], linear_[1], linear_[2], angular_[0], angular_[1], angular_[2]};
  }

  /// The twist at the point `reach` away: v + omega x reach. Accelerations go without their centripetal part.
  [[gnu::always_inline]] Twist shifted_to(const Vec3<T>& reach) const {
    return {linear_ + cross<T>(angular_, reach), angular_};
  }

  Twist& operator+=(const Twist& b) {
    linear_ += b.linear_;
    angular_ += b.angular_;
    return *this;
  }
  friend Twist operator-(const Twist& a, const Twist& b) {
    return {a.linear_ - b.linear_, a.angular_ - b.angular_};
  }
  friend Twist operator*(const T& a, const Twist& b) { return {a * b.linear_, a * b.angular_}; }

 private:
  Vec3<T> linear_, angular_;
};

/// Force, and moment about the point.
template <class T>
class Wrench {
 public:
  Wrench() = default;  // not set
  template <class Expression>
  explicit Wrench(const Eigen::MatrixBase<Expression>& w) : Wrench(Vec6<T>(w)) {}
  explicit Wrench(const Vec6<T>& w) : force_(w[0], w[1], w[2]), moment_(w[3], w[4], w[5]) {}
  Wrench(const Vec3<T>& force, const Vec3<T>& moment) : force_(force), moment_(moment) {}
  static Wrench zero() { return Wrench(Vec3<T>::Zero(), Vec3<T>::Zero()); }

  const Vec3<T>& force() const { return force_; }
  Vec3<T>& moment() { return moment_; }
  const Vec3<T>& moment() const { return moment_; }
  Vec6<T> vector() const { return {force_[0], force_[1], force_[2], moment_[0], moment_[1], moment_[2]}; }

  /// A wrench about the end of `reach`, moved to its start: the moment grows by reach x force.
  Wrench shifted_from(const Vec3<T>& reach) const { return {force_, moment_ + cross<T>(reach, force_)}; }
  /// *this += w.shifted_from(reach).
  [[gnu::always_inline]] void add_shifted_from(const Vec3<T>& reach, const Wrench& w) {
    force_ += w.force_;
    moment_ += w.moment_ + cross<T>(reach, w.force_);
  }

  Wrench operator-() const { return {-force_, -moment_}; }
  Wrench& operator+=(const Wrench& b) {
    force_ += b.force_;
    moment_ += b.moment_;
    return *this;
  }
  Wrench& operator-=(const Wrench& b) {
    force_ -= b.force_;
    moment_ -= b.moment_;
    return *this;
  }
  friend Wrench operator*(const T& a, const Wrench& b) { return {a * b.force_, a * b.moment_}; }

 private:
  Vec3<T> force_, moment_;
};

/// Power, or a wrench along a direction of motion.
template <class T>
[[gnu::always_inline]] inline T dot(const Twist<T>& v, const Wrench<T>& w) {
  return dot<T>(v.linear(), w.force()) + dot<T>(v.angular(), w.moment());
}

/// To the inertia of a body, that of a mass `own` that differs by direction, at a lever from its state point.
template <class T>
void add_mass_at(const Vec3<T>& lever, const Mat3<T>& own, Mat6<T>& to) {
  const Mat3<T> across = skew<T>(lever), turned = across * own;
  to.template topLeftCorner<3, 3>() += own;
  to.template bottomLeftCorner<3, 3>() += turned;
  to.template topRightCorner<3, 3>() += turned.transpose();
  to.template bottomRightCorner<3, 3>() -= turned * across;
}

/// Inertia of a rigid body about its centre of mass, or of what is as plain: wrench = inertia * acceleration.
template <class T>
struct CompactInertia {
  T mass;
  Symmetric3<T> turning;

  [[gnu::always_inline]] friend Wrench<T> operator*(const CompactInertia& inertia, const Twist<T>& a) {
    return {inertia.mass * a.linear(), inertia.turning * a.angular()};
  }
};

/// Compact inertias about one point, from which levers lead to them.
template <class T>
struct LeverInertia {
  T mass;
  Vec3<T> moment;  // mass x lever
  Symmetric3<T> turning;

  static LeverInertia zero() { return {T(0), Vec3<T>::Zero(), Symmetric3<T>::zero()}; }
  [[gnu::always_inline]] void add(const Vec3<T>& lever, const CompactInertia<T>& inertia) {
    const Vec3<T> own = inertia.mass * lever;
    mass += inertia.mass;
    moment += own;
    turning += inertia.turning;
    turning += Symmetric3<T>::diagonal(dot<T>(own, lever));
    turning -= Symmetric3<T>::outer(own, lever);
  }
};

/// Symmetric, in blocks of forces and moments: wrench = inertia * acceleration.
template <class T>
class SpatialInertia {
 public:
  SpatialInertia() = default;  // not set
  /// From a matrix whose lower triangle alone is read.
  explicit SpatialInertia(const Mat6<T>& m) { *this = m; }
  explicit SpatialInertia(const CompactInertia<T>& inertia) { *this = inertia; }
  /// `coupling`: forces for turning.
  SpatialInertia(const Symmetric3<T>& moving, const Mat3<T>& coupling, const Symmetric3<T>& turning)
      : moving_(moving), turning_(turning), coupling_(coupling) {}
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

  const Symmetric3<T>& moving() const { return moving_; }
  const Symmetric3<T>& turning() const { return turning_; }
  const Mat3<T>& coupling() const { return coupling_; }
  /// Whether it is known that neither forces turn it nor moments move it.
  bool is_apart() const {
    if constexpr (std::is_floating_point_v<T>) return coupling_.isZero(T(0));
    return false;
  }

  Mat6<T> matrix() const {
    const Mat3<T> moving = moving_.full(), turning = turning_.full();
    Mat6<T> out;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        out(i, j) = moving(i, j);
        out(3 + i, j) = coupling_(j, i);
        out(i, 3 + j) = coupling_(i, j);
        out(3 + i, 3 + j) = turning(i, j);
      }
    }
    return out;
  }

  /// *this += X^T I X, the inertia I about the end of `reach` seen from its start: X = [1, -reach x; 0, 1].
  [[gnu::always_inline]] void add_shifted_from(const Vec3<T>& reach, const SpatialInertia& inertia) {
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
  [[gnu::always_inline]] void add_shifted_from(const Vec3<T>& reach, const CompactInertia<T>& inertia) {
    LeverInertia<T> one = LeverInertia<T>::zero();
    one.add(reach, inertia);
    *this += one;
  }
  [[gnu::always_inline]] SpatialInertia& operator+=(const LeverInertia<T>& b) {
    moving_ += Symmetric3<T>::diagonal(b.mass);
    coupling_(0, 1) += b.moment[2], coupling_(1, 0) -= b.moment[2];
    coupling_(1, 2) += b.moment[0], coupling_(2, 1) -= b.moment[0];
    coupling_(2, 0) += b.moment[1], coupling_(0, 2) -= b.moment[1];
    turning_ += b.turning;
    return *this;
  }
  SpatialInertia& operator+=(const SpatialInertia& b) {
    moving_ += b.moving_;
    coupling_ += b.coupling_;
    turning_ += b.turning_;
    return *this;
  }
  /// *this -= a b^T, or a sum of such products of which only the whole is symmetric.
  [[gnu::always_inline]] void subtract_outer(const Wrench<T>& a, const Wrench<T>& b) {
    const Vec3<T> a_force = a.force(), a_moment = a.moment(), b_force = b.force(), b_moment = b.moment();
    moving_ -= Symmetric3<T>::outer(a_force, b_force);
    for (int j = 0; j < 3; ++j) coupling_.col(j) -= b_moment[j] * a_force;
    turning_ -= Symmetric3<T>::outer(a_moment, b_moment);
  }

  [[gnu::always_inline]] friend Wrench<T> operator*(const SpatialInertia& inertia, const Twist<T>& a) {
    const Vec3<T>&v = a.linear(), &w = a.angular();
    const Mat3<T>& h = inertia.coupling_;
    const Vec3<T> force = inertia.moving_ * v + times<T>(h, w);
    const Vec3<T> moment = inertia.turning_ * w + times_transposed<T>(h, v);
    return {force, moment};
  }

 private:
  Symmetric3<T> moving_, turning_;
  Mat3<T> coupling_;  // forces for turning
};

}  // namespace seacrane
