#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace seacrane {

/// A number with its derivatives in N directions (forward-mode automatic differentiation; Griewank, Walther,
/// Evaluating Derivatives, ch. 3): exact to rounding through any code that is a template on the scalar.
/// Comparisons look at the value: where branches meet, the derivative is that of the branch taken.
template <int N>
struct Dual {
  double value = 0.0;
  std::array<double, N> slope{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // implicit, as a double converts to a wider scalar

  static Dual variable(double value, int direction) {
    Dual out(value);
    out.slope[static_cast<std::size_t>(direction)] = 1.0;
    return out;
  }
  /// A function of this number, with its value and derivative here.
  Dual chain(double f, double df) const {
    Dual out(f);
    for (std::size_t i = 0; i < N; ++i) out.slope[i] = df * slope[i];
    return out;
  }

  Dual& operator+=(const Dual& b) {
    value += b.value;
    for (std::size_t i = 0; i < N; ++i) slope[i] += b.slope[i];
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    for (std::size_t i = 0; i < N; ++i) slope[i] -= b.slope[i];
    return *this;
  }
  Dual& operator*=(const Dual& b) {
    for (std::size_t i = 0; i < N; ++i) slope[i] = slope[i] * b.value + value * b.slope[i];
    value *= b.value;
    return *this;
  }
  Dual& operator/=(const Dual& b) {
    const double inverse = 1.0 / b.value;
    value *= inverse;
    for (std::size_t i = 0; i < N; ++i) slope[i] = (slope[i] - value * b.slope[i]) * inverse;
    return *this;
  }

  friend Dual operator-(const Dual& a) { return a.chain(-a.value, -1.0); }
  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator*(double a, const Dual& b) { return b.chain(a * b.value, a); }

  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }
  friend Dual sin(const Dual& a) { return a.chain(std::sin(a.value), std::cos(a.value)); }
  friend Dual cos(const Dual& a) { return a.chain(std::cos(a.value), -std::sin(a.value)); }
  friend Dual asin(const Dual& a) {
    return a.chain(std::asin(a.value), 1.0 / std::sqrt(1.0 - a.value * a.value));
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    const double inverse = 1.0 / (x.value * x.value + y.value * y.value);
    Dual out(std::atan2(y.value, x.value));
    for (std::size_t i = 0; i < N; ++i) {
      out.slope[i] = (x.value * y.slope[i] - y.value * x.slope[i]) * inverse;
    }
    return out;
  }
  friend Dual tanh(const Dual& a) {
    const double t = std::tanh(a.value);
    return a.chain(t, 1.0 - t * t);
  }
  friend Dual floor(const Dual& a) { return Dual(std::floor(a.value)); }
};

inline double value_of(double x) { return x; }
template <int N>
double value_of(const Dual<N>& x) {
  return x.value;
}

/// A positive number to a constant exponent.
inline double power(double a, double exponent) { return std::pow(a, exponent); }
template <int N>
Dual<N> power(const Dual<N>& a, double exponent) {
  const double value = std::pow(a.value, exponent);
  return a.chain(value, exponent * value / a.value);
}

inline double exponential(double x) { return std::exp(x); }

template <int N>
Dual<N> exponential(const Dual<N>& x) {
  const double e = std::exp(x.value);
  return x.chain(e, e);
}

}  // namespace seacrane

namespace Eigen {

template <int N>
struct NumTraits<seacrane::Dual<N>> : NumTraits<double> {
  using Real = seacrane::Dual<N>;
  using NonInteger = seacrane::Dual<N>;
  using Nested = seacrane::Dual<N>;
  enum { RequireInitialization = 1, ReadCost = N + 1, AddCost = N + 1, MulCost = 2 * N + 1 };
};

}  // namespace Eigen
