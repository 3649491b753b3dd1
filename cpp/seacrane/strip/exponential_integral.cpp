#include "seacrane/strip/exponential_integral.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace seacrane::strip {
namespace {

using Complex = std::complex<double>;

constexpr double series_radius = 2.0;       // the series costs least here, and the logarithm forbids Taylor's
constexpr double asymptotic_radius = 20.0;  // the smallest term of the asymptotic series is 1e-9
constexpr double spacing = 0.5;
constexpr int nodes = static_cast<int>(asymptotic_radius / spacing) + 2;  // on each axis
constexpr int degree = 13;

/// Ei(w) = gamma + ln w + sum w^n / (n n!) (Abramowitz and Stegun 5.1.10).
Complex power_series(Complex w) {
  Complex sum = std::numbers::egamma + std::log(w), power = 1.0;
  const double size = std::abs(w);
  double bound = 1.0;
  for (int n = 1; bound > 1e-17 || n < size; ++n) {
    power *= w / static_cast<double>(n);
    bound *= size / n;
    sum += power / static_cast<double>(n);
  }
  return sum;
}

/// exp(-w) Ei(w) ~ sum n! / w^(n+1), and the jump of E1 across its cut (Abramowitz and Stegun 5.1.51).
Complex asymptotic(Complex w, Complex exp_minus_w) {
  const Complex inverse = 1.0 / w;
  const double size = std::abs(w);
  Complex term = inverse, sum = inverse;
  double bound = 1.0 / size;
  for (int n = 1; n < size && bound > 1e-11; ++n) {
    term *= static_cast<double>(n) * inverse;
    bound *= n / size;
    sum += term;
  }
  return sum + Complex(0.0, std::numbers::pi) * exp_minus_w;
}

/// Taylor coefficients about the nodes of a square grid of the first quadrant, from W' = -W + 1/w.
class TaylorGrid {
 public:
  TaylorGrid() : coefficients_(nodes * nodes) {
    for (int i = 0; i < nodes; ++i) {
      for (int j = 0; j < nodes; ++j) {
        if (i + j > 0) coefficients_[i * nodes + j] = expand(spacing * Complex(i, j));
      }
    }
  }

  Complex operator()(Complex w) const {
    const int i = static_cast<int>(w.real() / spacing + 0.5), j = static_cast<int>(w.imag() / spacing + 0.5);
    const Coefficients& c = coefficients_[i * nodes + j];
    const double dx = w.real() - spacing * i, dy = w.imag() - spacing * j;
    double x = c[degree].real(), y = c[degree].imag();
    for (int n = degree - 1; n >= 0; --n) {
      const double next = x * dx - y * dy + c[n].real();
      y = x * dy + y * dx + c[n].imag();
      x = next;
    }
    return {x, y};
  }

 private:
  using Coefficients = std::array<Complex, degree + 1>;

  static Coefficients expand(Complex w) {
    Coefficients c{};
    c[0] = std::exp(-w) * power_series(w);
    Complex power = 1.0 / w;  // of (-1)^n / w^(n+1)
    for (int n = 0; n < degree; ++n) {
      c[n + 1] = (power - c[n]) / (n + 1.0);
      power /= -w;
    }
    return c;
  }

  std::vector<Coefficients> coefficients_;
};

Complex in_first_quadrant(Complex w, Complex exp_minus_w) {
  static const TaylorGrid grid;
  const double square = std::norm(w);
  if (square < series_radius * series_radius) return exp_minus_w * power_series(w);
  if (square < asymptotic_radius * asymptotic_radius) return grid(w);
  return asymptotic(w, exp_minus_w);
}

}  // namespace

Complex decaying_exponential_integral(Complex w, Complex exp_minus_w) {
  if (w.imag() >= 0.0) return in_first_quadrant(w, exp_minus_w);
  return std::conj(in_first_quadrant(std::conj(w), std::conj(exp_minus_w)));
}

}  // namespace seacrane::strip
