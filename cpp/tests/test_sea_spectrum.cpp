#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "seacrane/sea/current.hpp"
#include "seacrane/sea/spectrum.hpp"

using seacrane::Spectrum;

namespace {

/// Composite Simpson rule: independent of the library's quadrature.
template <class Function>
double simpson(const Function& f, double a, double b, int panels) {
  const double h = (b - a) / (2 * panels);
  double sum = f(a) + f(b);
  for (int i = 1; i < 2 * panels; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(a + i * h);
  return sum * h / 3.0;
}

std::string message(double hs, double tp, double gamma) {
  try {
    Spectrum::jonswap(hs, tp, gamma);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the integral of a spectrum is hs^2 / 16") {
  for (const double gamma : {1.0, 3.3, 7.0}) {
    const Spectrum s = Spectrum::jonswap(2.0, 8.0, gamma);
    const double wp = s.peak_omega(), end = 40.0 * wp;
    // Split at the peak; the rest beyond 40 peak frequencies is below 0.25 / 40^4 of the whole.
    const double sum =
        simpson(s, 1e-3, wp, 4000) + simpson(s, wp, 3 * wp, 8000) + simpson(s, 3 * wp, end, 20000);
    CHECK(sum ==
          doctest::Approx(0.25 - s.energy(end, std::numeric_limits<double>::infinity())).epsilon(1e-10));
    CHECK(s.energy(0.0, std::numeric_limits<double>::infinity()) == doctest::Approx(0.25).epsilon(1e-13));
    CHECK(s.moment(0) == doctest::Approx(0.25).epsilon(1e-13));
  }
}

TEST_CASE("energies of adjacent bands add up and match a band's integral") {
  const Spectrum s = Spectrum::jonswap(3.0, 10.0);
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) sum += s.energy(0.002 * i, 0.002 * (i + 1));
  CHECK(sum == doctest::Approx(s.energy(0.0, 2.0)).epsilon(1e-13));
  CHECK(s.energy(0.9, 1.1) == doctest::Approx(simpson(s, 0.9, 1.1, 500)).epsilon(1e-12));
}

TEST_CASE("Pierson-Moskowitz agrees with its closed form in hs and tp") {
  const Spectrum s = Spectrum::pierson_moskowitz(2.5, 9.0);
  const double wp = 2.0 * std::numbers::pi / 9.0;
  for (const double w : {0.4, 0.7, 1.0, 2.0}) {
    const double expected =
        5.0 / 16.0 * 2.5 * 2.5 * std::pow(wp, 4) * std::pow(w, -5) * std::exp(-1.25 * std::pow(wp / w, 4));
    CHECK(s(w) == doctest::Approx(expected).epsilon(1e-13));
  }
  CHECK(s(0.0) == 0.0);
  CHECK(s(-1.0) == 0.0);
  CHECK(s(1e-200) == 0.0);
}

TEST_CASE("JONSWAP raises the peak by gamma and leaves the tail's shape alone") {
  const Spectrum j = Spectrum::jonswap(2.0, 8.0, 3.3), p = Spectrum::pierson_moskowitz(2.0, 8.0);
  const double peak = j(j.peak_omega()) / p(p.peak_omega()), tail = j(2.2) / p(2.2);
  CHECK(peak / tail == doctest::Approx(3.3).epsilon(1e-12));
  CHECK(j.steepness() == doctest::Approx(2.0 * 2.0 * std::numbers::pi / (9.80665 * 64.0)).epsilon(1e-15));
}

TEST_CASE("bands of every kind of spectrum match Simpson's rule and add up to hs^2 / 16") {
  const double end = std::numeric_limits<double>::infinity();
  for (const Spectrum& s : {Spectrum::torsethaugen(4.0, 8.0), Spectrum::torsethaugen(2.0, 15.0),
                            Spectrum::ochi_hubble({3.0, 2.0}, {14.0, 6.0}, {3.0, 1.3}),
                            Spectrum::tabulated({0.3, 0.6, 0.9, 2.4}, {0.0, 2.0, 0.7, 0.1})}) {
    CAPTURE(s.name());
    CHECK(s.energy(0.61, 0.69) == doctest::Approx(simpson(s, 0.61, 0.69, 2000)).epsilon(1e-9));
    CHECK(s.energy(1.0, 2.3) == doctest::Approx(simpson(s, 1.0, 2.3, 4000)).epsilon(1e-9));
    double sum = s.energy(3.0, end);
    for (int i = 0; i < 10000; ++i) sum += s.energy(3e-4 * i, 3e-4 * (i + 1));
    CHECK(sum == doctest::Approx(s.hs() * s.hs() / 16.0).epsilon(1e-11));
    double parts = 0.0;
    for (const Spectrum& part : s.parts()) parts += part.moment(0);
    CHECK(parts == doctest::Approx(s.moment(0)).epsilon(1e-14));
  }
}

TEST_CASE("bad spectrum parameters are named with their value and the fix") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(message(nan, 8.0, 3.3).find("JONSWAP spectrum: hs is nan; give") == 0);
  CHECK(message(0.0, 8.0, 3.3).find("leave the sea out") != std::string::npos);
  CHECK(message(2.0, -8.0, 3.3).find("tp is -8; give a finite value above zero in s") != std::string::npos);
  CHECK(message(2.0, 8.0, 0.5).find("gamma is 0.5; give a peak enhancement of 1") != std::string::npos);
  const Spectrum s = Spectrum::jonswap(2.0, 8.0);
  CHECK_THROWS_AS(s.moment(4), std::invalid_argument);
  CHECK_THROWS_AS(s.energy(2.0, 1.0), std::invalid_argument);
  CHECK_THROWS_AS(s.energy(nan, 1.0), std::invalid_argument);
}

TEST_CASE("the dispersion relation holds from shallow to deep water") {
  constexpr double g = 9.80665;
  for (const double depth : {0.5, 5.0, 30.0, 300.0, 5000.0}) {
    for (const double w : {1e-3, 0.05, 0.3, 0.8, 2.5, 10.0}) {
      const double k = seacrane::wavenumber(w, depth, g);
      CHECK(g * k * std::tanh(k * depth) == doctest::Approx(w * w).epsilon(1e-14));
    }
  }
  CHECK(seacrane::wavenumber(0.8, std::numeric_limits<double>::infinity(), g) == 0.8 * 0.8 / g);
}
