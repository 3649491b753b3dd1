#include "seacrane/sea/dispersion.hpp"

#include <cmath>

namespace seacrane {

double wavenumber(double omega, double depth, double gravity) {
  const double deep = omega * omega / gravity;
  const double alpha = deep * depth;
  // Beyond 20 tanh is one to rounding.
  if (!(alpha < 20.0) || omega == 0.0) return deep;
  // Newton's method on y tanh y = alpha from Eckart's (1951) estimate, within 5 % for every depth: four
  // steps reach rounding, the other two are spare.
  double y = alpha / std::sqrt(std::tanh(alpha));
  for (int i = 0; i < 6; ++i) {
    const double h = std::tanh(y);
    y -= (y * h - alpha) / (h + y * (1.0 - h * h));
  }
  return y / depth;
}

}  // namespace seacrane
