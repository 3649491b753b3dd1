#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "seacrane/math/lane_functions.hpp"

namespace seacrane::sea {

/// sine[i], cosine[i] of angle[i], none of them above `largest` in size.
inline void sincos_each(const double* angle, std::size_t count, double largest, double* sine,
                        double* cosine) {
  if (largest <= sincos_limit) {
    for (std::size_t i = 0; i < count; ++i) sincos_lane<double, std::uint64_t>(angle[i], sine[i], cosine[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      sine[i] = std::sin(angle[i]);
      cosine[i] = std::cos(angle[i]);
    }
  }
}

/// sine[i], cosine[i] of omega[i] * t.
inline void sincos_of(const double* omega, std::size_t count, double largest_omega, double t, double* sine,
                      double* cosine) {
  if (largest_omega * std::fabs(t) <= sincos_limit) {
    for (std::size_t i = 0; i < count; ++i)
      sincos_lane<double, std::uint64_t>(omega[i] * t, sine[i], cosine[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      sine[i] = std::sin(omega[i] * t);
      cosine[i] = std::cos(omega[i] * t);
    }
  }
}

}  // namespace seacrane::sea
