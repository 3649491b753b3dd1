#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>

#include "seacrane/math/lane_functions.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

/// Vectors of L numbers of 64 bits.
template <int L>
struct VectorsOf {
  typedef double Doubles __attribute__((vector_size(8 * L)));
  typedef std::int64_t Bits __attribute__((vector_size(8 * L)));
  typedef std::uint64_t Unsigned __attribute__((vector_size(8 * L)));
};

/// What a comparison of packs gives, lane by lane. It does not convert to bool: a branch on it would be that
/// of one lane, so templates use select().
template <int L>
struct Mask {
  typename VectorsOf<L>::Bits bits;  // all or none of each lane

  bool operator[](int lane) const { return bits[lane] != 0; }
  void set(int lane, bool value) { bits[lane] = value ? -1 : 0; }
  friend Mask operator&(const Mask& a, const Mask& b) { return {a.bits & b.bits}; }
  friend Mask operator|(const Mask& a, const Mask& b) { return {a.bits | b.bits}; }
  friend Mask operator!(const Mask& a) { return {~a.bits}; }
  friend bool any(const Mask& a) {
    bool out = false;
    for (int i = 0; i < L; ++i) out |= a[i];
    return out;
  }
  friend bool all(const Mask& a) { return !any(!a); }
};

/// L doubles that behave as one scalar, in vector extensions of GCC and Clang: the lanes of a template on the
/// scalar. Compiled for a processor with registers of that length, an operation is one instruction.
template <int L>
struct Pack {
  using Vector = typename VectorsOf<L>::Doubles;
  using Bits = typename VectorsOf<L>::Bits;
  static constexpr int lanes = L;
  Vector v;

  Pack() = default;  // not set
  Pack(double x) : v(x - Vector{}) {}
  explicit Pack(const Vector& vector) : v(vector) {}

  static Pack load(const double* from) {
    Pack out;
    std::memcpy(&out.v, from, sizeof(Vector));
    return out;
  }
  /// f(lane).
  template <class F>
  [[gnu::always_inline]] static Pack by_lane(F&& f) {
    Vector out{};
    for (int lane = 0; lane < L; ++lane) out[lane] = f(lane);
    return Pack(out);
  }
  void store(double* to) const { std::memcpy(to, &v, sizeof(Vector)); }
  double operator[](int lane) const { return v[lane]; }
  void set(int lane, double value) { v[lane] = value; }

  Pack& operator+=(const Pack& b) { return v += b.v, *this; }
  Pack& operator-=(const Pack& b) { return v -= b.v, *this; }
  Pack& operator*=(const Pack& b) { return v *= b.v, *this; }
  Pack& operator/=(const Pack& b) { return v /= b.v, *this; }
  friend Pack operator-(const Pack& a) { return Pack(-a.v); }
  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v + b.v); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v - b.v); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v * b.v); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v / b.v); }

  friend Mask<L> operator<(const Pack& a, const Pack& b) { return {a.v < b.v}; }
  friend Mask<L> operator>(const Pack& a, const Pack& b) { return {a.v > b.v}; }
  friend Mask<L> operator<=(const Pack& a, const Pack& b) { return {a.v <= b.v}; }
  friend Mask<L> operator>=(const Pack& a, const Pack& b) { return {a.v >= b.v}; }

  friend Pack select(const Mask<L>& condition, const Pack& yes, const Pack& no) {
    const Bits chosen =
        (reinterpret_cast<Bits>(yes.v) & condition.bits) | (reinterpret_cast<Bits>(no.v) & ~condition.bits);
    return Pack(reinterpret_cast<Vector>(chosen));
  }
  friend Pack abs(const Pack& a) {
    return Pack(
        reinterpret_cast<Vector>(reinterpret_cast<Bits>(a.v) & std::numeric_limits<std::int64_t>::max()));
  }
  friend Pack min(const Pack& a, const Pack& b) { return select(b < a, b, a); }
  friend Pack max(const Pack& a, const Pack& b) { return select(a < b, b, a); }

  friend double total(const Pack& a) {
    double sum = a.v[0];
    for (int i = 1; i < L; ++i) sum += a.v[i];
    return sum;
  }

  friend Pack sqrt(const Pack& a) {
    return each(a, [](double x) { return std::sqrt(x); });
  }
  friend Pack floor(const Pack& a) {
    return each(a, [](double x) { return std::floor(x); });
  }
  /// NaN beyond sincos_limit, where the reduction is not exact.
  friend CosSin<Pack> cos_sin(const Pack& a) {
    CosSin<Pack> out;
    sincos_lane<Vector, typename VectorsOf<L>::Unsigned>(a.v, out.sine.v, out.cosine.v);
    const Mask<L> known = abs(a) <= Pack(sincos_limit);
    const Pack none(std::numeric_limits<double>::quiet_NaN());
    return {select(known, out.cosine, none), select(known, out.sine, none)};
  }
  friend Pack sin(const Pack& a) { return cos_sin(a).sine; }
  friend Pack cos(const Pack& a) { return cos_sin(a).cosine; }

  /// Arc tangents of a ratio t in [0, 1]: t = tan(u) with u in [0, pi/4] is halved once, to |w| <= tan(pi/8),
  /// and the rational function of Cephes (S. Moshier, atan.c; error 2e-16) takes the rest.
  friend Pack atan2(const Pack& y, const Pack& x) {
    constexpr double pi = std::numbers::pi;
    const Pack high = abs(y), wide = abs(x);
    const Mask<L> steep = high > wide;
    const Pack longer = select(steep, high, wide), shorter = select(steep, wide, high);
    const Mask<L> origin = longer <= Pack(0.0);
    const Pack t = shorter / select(origin, Pack(1.0), longer);
    const Mask<L> large = t > Pack(0.66);
    const Pack w = select(large, (t - 1.0) / (t + 1.0), t), z = w * w;
    const Pack p =
        (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
         1.228866684490136173410e2) *
            z -
        6.485021904942025371773e1;
    const Pack q =
        ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) *
             z +
         4.853903996359136964868e2) *
            z +
        1.945506571482613964425e2;
    const Pack rest = w * z * (p / q);
    Pack angle = select(large, 0.25 * pi + (w + (rest + 0.5 * more_pi_2)), w + rest);
    angle = select(steep, (0.5 * pi - angle) + more_pi_2, angle);
    angle = select(negative(x), (pi - angle) + 2.0 * more_pi_2, angle);
    return Pack(
        reinterpret_cast<Vector>(reinterpret_cast<Bits>(angle.v) |
                                 (reinterpret_cast<Bits>(y.v) & std::numeric_limits<std::int64_t>::min())));
  }
  friend Pack asin(const Pack& a) { return atan2(a, sqrt((1.0 - a) * (1.0 + a))); }

 private:
  static constexpr double more_pi_2 = 6.123233995736765886130e-17;  // pi / 2 less its double

  static Mask<L> negative(const Pack& a) { return {reinterpret_cast<Bits>(a.v) < 0}; }
  template <class F>
  static Pack each(const Pack& a, F&& f) {
    return by_lane([&](int lane) { return f(a.v[lane]); });
  }
};

template <int L, class F>
Eigen::Matrix<Pack<L>, 3, 1> lane_by_lane(const Pack<L>& value, F&& f) {
  Eigen::Matrix<Pack<L>, 3, 1> out;
  for (int lane = 0; lane < L; ++lane) {
    const Eigen::Vector3d one = f(value[lane]);
    for (int i = 0; i < 3; ++i) out[i].set(lane, one[i]);
  }
  return out;
}

/// See select.hpp: what a formula does not hold for becomes NaN in its lane, and the others go on.
template <int L, class Fail>
Pack<L> valid_where(const Mask<L>& holds, const Pack<L>& value, Fail&& /*fail*/) {
  return select(holds, value, Pack<L>(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace seacrane

namespace Eigen {

namespace internal {

/// Arrays of packs are aligned as a pack is. Eigen would ask for its own alignment, which is that of the
/// core's numbers and may be less: some compilers refuse that.
template <int L, int Size>
struct compute_default_alignment<seacrane::Pack<L>, Size> {
  enum { value = 0 };
};

}  // namespace internal

template <int L>
struct NumTraits<seacrane::Pack<L>> : NumTraits<double> {
  using Real = seacrane::Pack<L>;
  using NonInteger = seacrane::Pack<L>;
  using Nested = seacrane::Pack<L>;
};

}  // namespace Eigen
