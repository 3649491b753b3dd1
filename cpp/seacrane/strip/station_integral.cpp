#include "seacrane/strip/station_integral.hpp"

#include <array>
#include <cmath>

#include "seacrane/strip/complex.hpp"

namespace seacrane::strip {
namespace {

/// Integrals over -1 < s < 1 of P_n(s) exp(-i theta s) = 2 (-i)^n j_n(theta), n = 0, 1, 2
/// (Abramowitz and Stegun 10.1.14), by series where the closed forms of j_n cancel.
std::array<Complex, 3> legendre_transform(double theta) {
  const double t2 = theta * theta;
  double j0, j1, j2;
  if (std::abs(theta) < 0.3) {
    j0 = 1.0 - t2 / 6.0 * (1.0 - t2 / 20.0 * (1.0 - t2 / 42.0 * (1.0 - t2 / 72.0)));
    j1 = theta / 3.0 * (1.0 - t2 / 10.0 * (1.0 - t2 / 28.0 * (1.0 - t2 / 54.0 * (1.0 - t2 / 88.0))));
    j2 = t2 / 15.0 * (1.0 - t2 / 14.0 * (1.0 - t2 / 36.0 * (1.0 - t2 / 66.0 * (1.0 - t2 / 104.0))));
  } else {
    j0 = std::sin(theta) / theta;
    j1 = (j0 - std::cos(theta)) / theta;
    j2 = 3.0 * j1 / theta - j0;
  }
  return {2.0 * j0, Complex(0.0, -2.0 * j1), -2.0 * j2};
}

}  // namespace

Eigen::MatrixX3d moment_weights(const std::vector<double>& x) {
  Eigen::MatrixX3d w = Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(x.size()), 3);
  const double node = std::sqrt(1.0 / 3.0);  // two Gauss points: exact to the third power
  for (Eigen::Index i = 0; i + 1 < w.rows(); ++i) {
    const double middle = 0.5 * (x[i] + x[i + 1]), half = 0.5 * (x[i + 1] - x[i]);
    for (double s : {-node, node}) {
      const double at = middle + half * s;
      const Eigen::RowVector3d power(1.0, at, at * at);
      w.row(i) += 0.5 * half * (1.0 - s) * power;
      w.row(i + 1) += 0.5 * half * (1.0 + s) * power;
    }
  }
  return w;
}

Eigen::MatrixX2cd oscillatory_weights(const std::vector<double>& x, double k) {
  Eigen::MatrixX2cd w = Eigen::MatrixX2cd::Zero(static_cast<Eigen::Index>(x.size()), 2);
  for (Eigen::Index i = 0; i + 1 < w.rows(); ++i) {
    const double middle = 0.5 * (x[i] + x[i + 1]), half = 0.5 * (x[i + 1] - x[i]);
    const auto [p0, p1, p2] = legendre_transform(k * half);
    const Complex factor = 0.5 * half * std::polar(1.0, -k * middle), square = (p0 + 2.0 * p2) / 3.0;
    for (int side : {-1, 1}) {  // x = middle + half s times the hat (1 -+ s) / 2
      const Complex hat = p0 + static_cast<double>(side) * p1;
      const Complex lever = p1 + static_cast<double>(side) * square;
      const Eigen::Index station = side < 0 ? i : i + 1;
      w(station, 0) += factor * hat;
      w(station, 1) += factor * (middle * hat + half * lever);
    }
  }
  return w;
}

}  // namespace seacrane::strip
