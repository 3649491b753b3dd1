#include "seacrane/strip/exponential_integral.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "seacrane/strip/complex.hpp"

namespace seacrane::strip {
namespace {

constexpr double series_radius = 2.0;       // the series costs least here, and the logarithm forbids Taylor's
constexpr double asymptotic_radius = 20.0;  // the smallest term of the asymptotic series is 1e-9
constexpr double spacing = 0.5;
constexpr int nodes = static_cast<int>(asymptotic_radius / spacing) + 2;  // on each axis
constexpr int degree = 13, degree_far_out = 9;                            // within and beyond |w| = 4

/// Value of c[0] + c[1] x + ... + c[last] x^last, written out because std::complex checks each product for
/// NaN.
template <class Coefficients>
Complex horner(const Coefficients& c, int last, Complex x) {
  double real = std::real(c[last]), imag = std::imag(c[last]);
  for (int n = last - 1; n >= 0; --n) {
    const double next = real * x.real() - imag * x.imag() + std::real(c[n]);
    imag = real * x.imag() + imag * x.real() + std::imag(c[n]);
    real = next;
  }
  return {real, imag};
}

/// Coefficients of Ei(w) - ln w = gamma + sum w^n / (n n!) (Abramowitz and Stegun 5.1.10).
using Series = std::array<double, 90>;
Series series_coefficients() {
  Series c{std::numbers::egamma};
  double factorial = 1.0;
  for (int n = 1; n < static_cast<int>(c.size()); ++n) {
    factorial *= n;
    c[n] = 1.0 / (n * factorial);
  }
  return c;
}

/// Last power that counts at 1e-11, by the square of |w| < 2.
int series_degree(double square) { return square < 0.01 ? 6 : square < 0.25 ? 9 : square < 1.0 ? 13 : 18; }

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
    const Series series = series_coefficients();
    for (int i = 0; i < nodes; ++i) {
      for (int j = 0; j < nodes; ++j) {
        if (i + j > 0) coefficients_[i * nodes + j] = expand(spacing * Complex(i, j), series);
      }
    }
  }

  Complex operator()(Complex w) const {
    const int i = static_cast<int>(w.real() / spacing + 0.5), j = static_cast<int>(w.imag() / spacing + 0.5);
    const int last = std::norm(w) < 16.0 ? degree : degree_far_out;
    return horner(coefficients_[i * nodes + j], last, w - spacing * Complex(i, j));
  }

 private:
  using Coefficients = std::array<Complex, degree + 1>;

  static Coefficients expand(Complex w, const Series& series) {
    Coefficients c{};
    c[0] = std::exp(-w) * (std::log(w) + horner(series, static_cast<int>(series.size()) - 1, w));
    Complex power = 1.0 / w;  // of (-1)^n / w^(n+1)
    for (int n = 0; n < degree; ++n) {
      c[n + 1] = (power - c[n]) / (n + 1.0);
      power /= -w;
    }
    return c;
  }

  std::vector<Coefficients> coefficients_;
};

Complex in_first_quadrant(Complex w, Complex exp_minus_w, Complex log_w) {
  static const TaylorGrid grid;
  static const Series series = series_coefficients();
  const double square = std::norm(w);
  if (square < series_radius * series_radius) {
    return exp_minus_w * (log_w + horner(series, series_degree(square), w));
  }
  if (square < asymptotic_radius * asymptotic_radius) return grid(w);
  return asymptotic(w, exp_minus_w);
}

}  // namespace

Complex decaying_exponential_integral(Complex w, Complex exp_minus_w, Complex log_w) {
  if (w.imag() >= 0.0) return in_first_quadrant(w, exp_minus_w, log_w);
  return std::conj(in_first_quadrant(std::conj(w), std::conj(exp_minus_w), std::conj(log_w)));
}

}  // namespace seacrane::strip
