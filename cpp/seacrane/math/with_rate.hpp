#pragma once

#include <Eigen/Core>
#include <cmath>

#include "seacrane/math/dual.hpp"

namespace seacrane {

/// A number with its rate over time, of any scalar: what a function of places is at one instant, and how fast
/// it changes there.
template <class T>
struct WithRate {
  T value = T(0), rate = T(0);

  WithRate() = default;
  explicit WithRate(double constant) : value(constant) {}
  WithRate(const T& v, const T& r) : value(v), rate(r) {}

  WithRate& operator+=(const WithRate& b) { return *this = *this + b; }
  WithRate& operator-=(const WithRate& b) { return *this = *this - b; }
  WithRate& operator*=(const WithRate& b) { return *this = *this * b; }
  WithRate& operator/=(const WithRate& b) { return *this = *this / b; }

  friend WithRate operator-(const WithRate& a) { return {-a.value, -a.rate}; }
  friend WithRate operator+(const WithRate& a, const WithRate& b) {
    return {a.value + b.value, a.rate + b.rate};
  }
  friend WithRate operator-(const WithRate& a, const WithRate& b) {
    return {a.value - b.value, a.rate - b.rate};
  }
  friend WithRate operator*(const WithRate& a, const WithRate& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
  }
  friend WithRate operator/(const WithRate& a, const WithRate& b) {
    const T quotient = a.value / b.value;
    return {quotient, (a.rate - quotient * b.rate) / b.value};
  }
  friend WithRate sqrt(const WithRate& a) {
    using std::sqrt;
    const T root = sqrt(a.value);
    return {root, T(0.5) * a.rate / root};
  }
};

template <class T>
double value_of(const WithRate<T>& x) {
  return value_of(x.value);
}

/// The order of the derivatives that a scalar carries.
template <class T>
inline constexpr int derivative_order = 1;
template <class T>
inline constexpr int derivative_order<WithRate<T>> = 1 + derivative_order<T>;

/// A vector with its rate, and its two parts.
template <class T>
Eigen::Matrix<WithRate<T>, 3, 1> with_rate(const Eigen::Matrix<T, 3, 1>& v,
                                           const Eigen::Matrix<T, 3, 1>& rate) {
  return {{v[0], rate[0]}, {v[1], rate[1]}, {v[2], rate[2]}};
}
template <class T>
Eigen::Matrix<T, 3, 1> value_of_each(const Eigen::Matrix<WithRate<T>, 3, 1>& v) {
  return {v[0].value, v[1].value, v[2].value};
}
template <class T>
Eigen::Matrix<T, 3, 1> rate_of(const Eigen::Matrix<WithRate<T>, 3, 1>& v) {
  return {v[0].rate, v[1].rate, v[2].rate};
}

}  // namespace seacrane

namespace Eigen {

template <class T>
struct NumTraits<seacrane::WithRate<T>> : NumTraits<double> {
  using Real = seacrane::WithRate<T>;
  using NonInteger = seacrane::WithRate<T>;
  using Nested = seacrane::WithRate<T>;
  enum { RequireInitialization = 1, ReadCost = 4, AddCost = 4, MulCost = 8 };
};

}  // namespace Eigen
