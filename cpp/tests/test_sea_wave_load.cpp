#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "seacrane/sea/philox.hpp"
#include "seacrane/sea/realisation.hpp"
#include "seacrane/sea/sincos.hpp"
#include "seacrane/sea/wave_load.hpp"

using namespace seacrane;
using std::complex;

namespace {

WaveComponents sea_state(long count = 200) {
  RealisationOptions o;
  o.count = count;
  o.seed = 5;
  o.direction = 0.75 * std::numbers::pi;
  return realise(Spectrum::jonswap(2.0, 8.0), o);
}

/// Random complex numbers of the size of a ship's transfer: nothing smooth to hide an error.
Eigen::MatrixXcd transfer_of(std::size_t count) {
  Eigen::MatrixXcd x(static_cast<Eigen::Index>(count), 6);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      const auto index = static_cast<std::uint64_t>(6 * i + j);
      const double size = j < 3 ? 1e7 : 1e8;
      x(i, j) = std::polar(size * Philox::uniform(9, 0, index), 6.28 * Philox::uniform(9, 1, index));
    }
  }
  return x;
}

std::shared_ptr<const ExactWaveLoad> random_load(long count = 200) {
  const WaveComponents waves = sea_state(count);
  return std::make_shared<const ExactWaveLoad>(waves, transfer_of(waves.size()), WavePoint{12.0, -7.0},
                                               WavePoint{3.0, 4.0});
}

/// Straight from the definition, in extended precision.
WaveChannels by_definition(const WaveComponents& w, const Eigen::MatrixXcd& x, double t) {
  WaveChannels out{};
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double b = w.direction()[i], k = w.wavenumber()[i];
    const auto at = [&](double px, double py) {
      const long double phase = static_cast<long double>(w.omega()[i]) * t + w.phase()[i] -
                                static_cast<long double>(k * (px * std::cos(b) + py * std::sin(b)));
      return complex<long double>(std::cos(phase), std::sin(phase));
    };
    for (Eigen::Index j = 0; j < 6; ++j) {
      const complex<long double> value(x(static_cast<Eigen::Index>(i), j));
      out[static_cast<std::size_t>(j)] +=
          static_cast<double>((static_cast<long double>(w.amplitude()[i]) * value * at(12.0, -7.0)).real());
    }
    out[6] += static_cast<double>(w.amplitude()[i] * at(3.0, 4.0).real());
  }
  return out;
}

}  // namespace

TEST_CASE("sine and cosine are within 3e-16 over all quadrants and magnitudes") {
  double worst = 0.0;
  for (int i = -200000; i <= 200000; ++i) {
    const double x = i * 7.99999137;
    double sine = 0.0, cosine = 0.0;
    sincos_lane<double, std::uint64_t>(x, sine, cosine);
    const auto exact = static_cast<long double>(x);
    worst = std::max({worst, std::fabs(static_cast<double>(sine - std::sin(exact))),
                      std::fabs(static_cast<double>(cosine - std::cos(exact)))});
  }
  CHECK(worst < 3e-16);
  // Near multiples of pi/2 the reduction must not lose the small result.
  for (const int q : {1, 2, 3, 1000, 999999}) {
    double sine = 0.0, cosine = 0.0;
    const double x = q * (0.5 * std::numbers::pi);
    sincos_lane<double, std::uint64_t>(x, sine, cosine);
    const double small = q % 2 == 0 ? sine : cosine;
    const double expected = q % 2 == 0 ? std::sin(x) : std::cos(x);
    CHECK(std::fabs(small - expected) < 1e-9 * std::fabs(expected));
  }
}

TEST_CASE("the exact load equals its definition") {
  for (const long count : {1L, 63L, 64L, 65L, 200L}) {
    const auto load = random_load(count);
    const WaveChannels size = load->bounds()[0];
    const Eigen::MatrixXcd x = transfer_of(load->waves().size());
    for (const double t : {0.0, 0.37, 12.5, 99.9, -40.0, 3600.0}) {
      double out[wave_channels];
      load->evaluate(t, out);
      const WaveChannels expected = by_definition(load->waves(), x, t);
      const double rounding = 4e-16 * (4.0 + 2.5 * std::fabs(t));
      for (std::size_t j = 0; j < wave_channels; ++j)
        CHECK(std::fabs(out[j] - expected[j]) <= rounding * size[j]);
      CHECK(out[6] == doctest::Approx(load->waves().elevation(t, 3.0, 4.0)).epsilon(1e-9));
    }
  }
}

TEST_CASE("beyond the fast reduction the load is still right") {
  const auto load = random_load(20);
  double out[wave_channels];
  const double t = 3e6;
  load->evaluate(t, out);
  CHECK(std::fabs(out[6] - load->waves().elevation(t, 3.0, 4.0)) < 1e-8);
}

TEST_CASE("derivatives in time match central differences") {
  const auto load = random_load();
  const WaveChannels size = load->bounds()[0];
  constexpr double t = 31.4, h = 1e-3;
  double before[wave_channels], after[wave_channels], value[wave_channels], rate[wave_channels],
      acceleration[wave_channels];
  load->evaluate(t - h, before);
  load->evaluate(t + h, after);
  load->evaluate(t, value, rate, acceleration);
  for (std::size_t j = 0; j < wave_channels; ++j) {
    CHECK(std::fabs((after[j] - before[j]) / (2 * h) - rate[j]) < 5e-6 * size[j]);
    CHECK(std::fabs((after[j] - 2 * value[j] + before[j]) / (h * h) - acceleration[j]) < 2e-5 * size[j]);
  }
}

TEST_CASE("the table stays within its stated bound at every bound asked for") {
  const auto load = random_load();
  const WaveChannels size = load->bounds()[0];
  for (const double relative : {1e-3, 1e-6, 1e-9}) {
    const WaveTable table(load, relative);
    WaveTableBlock block = table.make_block();
    WaveChannels worst{};
    for (int i = -2000; i < 20000; ++i) {
      const double t = i * 0.00517;
      double exact[wave_channels], got[wave_channels];
      load->evaluate(t, exact);
      table.evaluate(t, block, got);
      for (std::size_t j = 0; j < wave_channels; ++j)
        worst[j] = std::max(worst[j], std::fabs(got[j] - exact[j]));
    }
    for (std::size_t j = 0; j < wave_channels; ++j) {
      CAPTURE(relative);
      CAPTURE(j);
      CHECK(table.error_bound()[j] <= relative * size[j] * (1.0 + 1e-12));
      CHECK(worst[j] <= table.error_bound()[j] + 1e-13 * size[j]);
      CHECK(worst[j] > 0.001 * table.error_bound()[j]);
    }
  }
}

TEST_CASE("interpolation is exact for polynomials of degree 11, and not for 12") {
  const auto error = [](int degree, double s) {
    const HermiteWeights w(s);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
      const double x = k - 1.0;
      sum += w.value[k] * std::pow(x, degree);
      if (degree > 0) sum += w.rate[k] * degree * std::pow(x, degree - 1);
      if (degree > 1) sum += w.acceleration[k] * degree * (degree - 1) * std::pow(x, degree - 2);
    }
    return sum - std::pow(s, degree);
  };
  for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    for (int degree = 0; degree <= 11; ++degree) CHECK(std::fabs(error(degree, s)) < 1e-12);
  }
  CHECK(error(12, 0.5) == doctest::Approx(-0.177978515625).epsilon(1e-9));
}

TEST_CASE("the bound is sharp for one component") {
  Eigen::MatrixXcd x = Eigen::MatrixXcd::Zero(1, 6);
  x(0, 2) = {3e6, 4e6};
  const auto load = std::make_shared<const ExactWaveLoad>(WaveComponents({0.9}, {2.0}, {0.4}, {0.0}), x);
  const WaveTable table(load, 1e-11);  // knots close enough for the derivative to vary little between them
  WaveTableBlock block = table.make_block();
  double worst = 0.0;
  for (int i = 0; i < 50000; ++i) {
    double exact[wave_channels], got[wave_channels];
    load->evaluate(i * 0.0007, exact);
    table.evaluate(i * 0.0007, block, got);
    worst = std::max(worst, std::fabs(got[2] - exact[2]));
    CHECK(got[0] == 0.0);
  }
  CHECK(worst <= table.error_bound()[2] + 1e-13 * 1e7);
  CHECK(worst > 0.8 * table.error_bound()[2]);
  CHECK(table.error_bound()[2] == doctest::Approx(1e-11 * 1e7).epsilon(1e-12));
}

TEST_CASE("values do not depend on how a run moves through time") {
  const WaveTable table(random_load(), 1e-6);
  WaveTableBlock forward = table.make_block();
  std::vector<double> times, value;
  for (int i = -300; i < 3000; ++i) {
    times.push_back(i * 0.1037);
    double out[wave_channels];
    table.evaluate(times.back(), forward, out);
    value.insert(value.end(), out, out + wave_channels);
  }
  WaveTableBlock jumping = table.make_block();
  const std::size_t n = times.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (i * 1777 + 13) % n;  // forth and back by minutes
    double out[wave_channels];
    table.evaluate(times[k], jumping, out);
    for (std::size_t j = 0; j < wave_channels; ++j) CHECK(out[j] == value[wave_channels * k + j]);
  }
  CHECK(jumping.knots_computed() > forward.knots_computed());
}

TEST_CASE("a forward run computes every knot once, and a rejected step none again") {
  const WaveTable table(random_load());
  WaveTableBlock block = table.make_block();
  double out[wave_channels];
  for (int i = 0; i <= 10000; ++i) table.evaluate(i * 0.01, block, out);
  const auto knots = static_cast<std::int64_t>(std::floor(100.0 / table.step())) + 4;
  CHECK(block.knots_computed() == knots);
  for (double t = 100.0; t > 98.0; t -= 0.05) table.evaluate(t, block, out);
  CHECK(block.knots_computed() == knots);
}

TEST_CASE("at a knot the table is the exact sum, and knots join without a jump") {
  const auto load = random_load();
  const WaveTable table(load);
  WaveTableBlock block = table.make_block();
  const WaveChannels size = load->bounds()[0];
  for (const double k : {0.0, 1.0, 63.0, 64.0, 65.0, -1.0, -64.0, 1000.0}) {
    const double t = k * table.step();
    double exact[wave_channels], below[wave_channels], at[wave_channels];
    load->evaluate(t, exact);
    table.evaluate(t, block, at);
    table.evaluate(std::nextafter(t, -1e9), block, below);
    for (std::size_t j = 0; j < wave_channels; ++j) {
      CHECK(std::fabs(at[j] - exact[j]) < 1e-13 * size[j]);
      CHECK(std::fabs(at[j] - below[j]) < 1e-12 * size[j]);
    }
  }
}

TEST_CASE("bad wave loads are refused with the value and the fix") {
  const WaveComponents waves({0.5, 0.6}, {1.0, 1.0}, {0.0, 0.0}, {0.0, 0.0});
  CHECK_THROWS_WITH_AS(
      ExactWaveLoad(waves, Eigen::MatrixXcd::Zero(3, 6)),
      "wave load: shape of transfer is (3, 6); give one row per wave component and six columns, "
      "(2, 6)",
      std::invalid_argument);
  Eigen::MatrixXcd broken = Eigen::MatrixXcd::Zero(2, 6);
  broken(1, 4) = {0.0, std::numeric_limits<double>::quiet_NaN()};
  CHECK_THROWS_WITH_AS(ExactWaveLoad(waves, broken),
                       "wave load: transfer(1, 4) is (0,nan); give finite force per metre of wave amplitude",
                       std::invalid_argument);
  const double infinite = std::numeric_limits<double>::infinity();
  const Eigen::MatrixXcd none = Eigen::MatrixXcd::Zero(2, 6);
  CHECK_THROWS_AS(ExactWaveLoad(waves, none, {infinite, 0.0}), std::invalid_argument);
  const auto load = std::make_shared<const ExactWaveLoad>(waves, none);
  CHECK_THROWS_AS(WaveTable(load, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(WaveTable(nullptr), std::invalid_argument);
  const WaveTable table(load);
  WaveTableBlock block = table.make_block(), unprepared;
  WaveTableBlock foreign = WaveTable(random_load(2)).make_block();
  double out[wave_channels];
  CHECK_THROWS_AS(table.evaluate(0.0, unprepared, out), std::logic_error);
  CHECK_THROWS_AS(table.evaluate(0.0, foreign, out), std::logic_error);
  CHECK_THROWS_AS(table.evaluate(infinite, block, out), std::invalid_argument);
  CHECK_THROWS_AS(table.evaluate(std::nan(""), block, out), std::invalid_argument);
  table.evaluate(3.0, block, out);
  CHECK(out[2] == 0.0);
}
