#pragma once

#include <cmath>

#include "seacrane/math/dual.hpp"

namespace seacrane {

inline double exponential(double x) { return std::exp(x); }

template <int N>
Dual<N> exponential(const Dual<N>& x) {
  const double e = std::exp(x.value);
  return x.chain(e, e);
}

}  // namespace seacrane
