#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace seacrane::sea {

/// Integral of f from a to b by panels no wider than `width`, 8 Gauss-Legendre points each: exact for
/// polynomials of degree 15 on every panel.
template <class Function>
double integrate(const Function& f, double a, double b, double width) {
  static constexpr std::array<double, 4> node{0.18343464249564980494, 0.52553240991632898582,
                                              0.79666647741362673959, 0.96028985649753623168};
  static constexpr std::array<double, 4> weight{0.36268378337836198297, 0.31370664587788728734,
                                                0.22238103445337447054, 0.10122853629037625915};
  if (!(b > a)) return 0.0;
  const double panels = std::max(1.0, std::ceil((b - a) / width));
  const double half = 0.5 * (b - a) / panels;
  double sum = 0.0;
  for (double panel = 0.0; panel < panels; ++panel) {
    const double middle = a + (2.0 * panel + 1.0) * half;
    for (std::size_t i = 0; i < node.size(); ++i) {
      sum += weight[i] * (f(middle - half * node[i]) + f(middle + half * node[i]));
    }
  }
  return sum * half;
}

}  // namespace seacrane::sea
