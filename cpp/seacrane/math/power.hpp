#pragma once

#include <cmath>

#include "seacrane/math/dual.hpp"

namespace seacrane {

/// A positive number to a constant exponent.
inline double power(double a, double exponent) { return std::pow(a, exponent); }
template <int N>
Dual<N> power(const Dual<N>& a, double exponent) {
  const double value = std::pow(a.value, exponent);
  return a.chain(value, exponent * value / a.value);
}

}  // namespace seacrane
