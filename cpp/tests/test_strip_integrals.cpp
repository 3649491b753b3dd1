#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "seacrane/sea/gauss_legendre.hpp"
#include "seacrane/strip/exponential_integral.hpp"
#include "seacrane/strip/station_integral.hpp"

using namespace seacrane;
using std::complex;

namespace {

constexpr complex<double> i_unit{0.0, 1.0};

template <class Function>
complex<double> integral(const Function& f, double a, double b, double width) {
  return {sea::integrate([&](double s) { return f(s).real(); }, a, b, width),
          sea::integrate([&](double s) { return f(s).imag(); }, a, b, width)};
}

/// exp(-w) Ei(w) from its definition, int exp(-t) / (w - t) dt over a ray below the pole, t = exp(u - i pi /
/// 4).
complex<double> by_quadrature(complex<double> w) {
  const auto integrand = [&](double u) {
    const complex<double> t = std::polar(std::exp(u), -0.25 * std::numbers::pi);
    return std::exp(-t) * t / (w - t);
  };
  return integral(integrand, -40.0, 4.5, 0.1) + i_unit * std::numbers::pi * std::exp(-w);
}

double hat(const std::vector<double>& x, std::size_t i, double at) {
  if (i > 0 && at >= x[i - 1] && at <= x[i]) return (at - x[i - 1]) / (x[i] - x[i - 1]);
  if (i + 1 < x.size() && at > x[i] && at <= x[i + 1]) return (x[i + 1] - at) / (x[i + 1] - x[i]);
  return 0.0;
}

}  // namespace

TEST_CASE("the exponential integral of the wave source against its definition, in every region") {
  double worst = 0.0;
  for (double size = 1e-4; size < 200.0; size *= 1.13) {
    for (double turn = 0.0; turn <= 1.0; turn += 0.05) {
      const complex<double> w = std::polar(size, 0.5 * std::numbers::pi * turn);
      const complex<double> right(std::max(w.real(), 0.0), w.imag());
      const auto value = strip::decaying_exponential_integral(right, std::exp(-right), std::log(right));
      const auto below = strip::decaying_exponential_integral(std::conj(right), std::exp(-std::conj(right)),
                                                              std::log(std::conj(right)));
      worst = std::max(worst, std::abs(value - by_quadrature(right)));
      if (right.imag() > 0.0) CHECK(std::abs(below - std::conj(value)) == 0.0);
    }
  }
  CHECK(worst < 1e-8);
}

TEST_CASE("station weights integrate hats, their moments and their waves exactly") {
  const std::vector<double> x{-7.0, -5.5, -1.0, 0.0, 4.0};
  const Eigen::MatrixX3d moments = strip::moment_weights(x);
  for (const double k : {0.0, 1e-6, 0.05, 0.13, 0.14, 1.0, -2.5, 12.0}) {
    const Eigen::MatrixX2cd waves = strip::oscillatory_weights(x, k);
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (int power = 0; power < 3; ++power) {
        complex<double> expected = 0.0;
        for (std::size_t j = 0; j + 1 < x.size(); ++j) {
          const auto f = [&](double at) {
            return hat(x, i, at) * std::pow(at, power) * std::polar(1.0, -k * at);
          };
          expected += integral(f, x[j], x[j + 1], 0.05);
        }
        CAPTURE(k);
        CAPTURE(power);
        const auto row = static_cast<Eigen::Index>(i);
        if (power < 2) CHECK(std::abs(waves(row, power) - expected) < 1e-12 * (1.0 + std::abs(x[0])));
        if (k == 0.0) CHECK(std::abs(moments(row, power) - expected) < 1e-12 * 100.0);
      }
    }
  }
}
