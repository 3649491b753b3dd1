#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "seacrane/sea/philox.hpp"
#include "seacrane/sea/realisation.hpp"

using namespace seacrane;

namespace {

RealisationOptions options_of(std::uint64_t seed) {
  RealisationOptions o;
  o.seed = seed;
  o.direction = 0.75 * std::numbers::pi;
  return o;
}

std::string message(const RealisationOptions& o) {
  try {
    realise(Spectrum::jonswap(2.0, 8.0), o);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Philox4x32-10 gives the published known answers") {
  // kat_vectors of the authors' Random123 library.
  constexpr std::uint32_t ones = 0xffffffffu;
  CHECK(Philox::bits({0, 0, 0, 0}, {0, 0}) ==
        Philox::Counter{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u});
  CHECK(Philox::bits({ones, ones, ones, ones}, {ones, ones}) ==
        Philox::Counter{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu});
  CHECK(Philox::bits({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}) ==
        Philox::Counter{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u});
}

TEST_CASE("uniform numbers lie inside (0, 1), differ by seed, stream and index, and are uniform") {
  double mean = 0.0, square = 0.0;
  std::set<double> seen;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double u = Philox::uniform(7, 1, static_cast<std::uint64_t>(i));
    CHECK((u > 0.0 && u < 1.0));
    mean += u / n;
    square += u * u / n;
    seen.insert(u);
  }
  CHECK(seen.size() == n);
  // Four standard deviations of the sample moments.
  CHECK(std::fabs(mean - 0.5) < 4.0 * std::sqrt(1.0 / 12.0 / n));
  CHECK(std::fabs(square - 1.0 / 3.0) < 4.0 * std::sqrt(4.0 / 45.0 / n));
  const double u = Philox::uniform(7, 1, 3);
  CHECK(u != Philox::uniform(8, 1, 3));
  CHECK(u != Philox::uniform(7 + (std::uint64_t{1} << 32), 1, 3));
  CHECK(u != Philox::uniform(7, 2, 3));
  CHECK(u == Philox::uniform(7, 1, 3));
}

TEST_CASE("the paper's sea: 200 components, hs within 1 %, one frequency in each bin") {
  const WaveComponents waves = realise(Spectrum::jonswap(2.0, 8.0), options_of(1));
  REQUIRE(waves.size() == 200);
  CHECK(std::fabs(waves.realised_hs() - 2.0) < 0.02);
  CHECK(waves.realised_hs() == doctest::Approx(4.0 * std::sqrt(waves.moment(0))).epsilon(1e-15));
  const double width = 2.2 / 200.0;
  double jitter = 0.0;
  for (std::size_t i = 0; i < 200; ++i) {
    const double place = (waves.omega()[i] - 0.3) / width - static_cast<double>(i);
    CHECK((place > 0.0 && place < 1.0));
    jitter += place / 200.0;
    CHECK(waves.wavenumber()[i] == doctest::Approx(std::pow(waves.omega()[i], 2) / 9.80665).epsilon(1e-15));
  }
  CHECK(std::fabs(jitter - 0.5) < 4.0 * std::sqrt(1.0 / 12.0 / 200.0));
}

TEST_CASE("hs stays within 1 % for every peak period with the default range") {
  for (const double gamma : {1.0, 3.3, 5.0}) {
    for (const double tp : {2.0, 4.0, 6.0, 8.0, 12.0, 20.0, 30.0}) {
      CAPTURE(gamma);
      CAPTURE(tp);
      const double hs = realise(Spectrum::jonswap(2.0, tp, gamma), options_of(3)).realised_hs();
      CHECK(hs < 2.0 * (1.0 + 1e-12));
      CHECK(hs > 2.0 * 0.99);
    }
  }
}

TEST_CASE("a narrower range leaves out exactly the energy outside it") {
  RealisationOptions o = options_of(3);
  o.omega_min = 0.6;
  o.omega_max = 1.2;
  const Spectrum s = Spectrum::jonswap(2.0, 8.0);
  CHECK(realise(s, o).moment(0) == doctest::Approx(s.energy(0.6, 1.2)).epsilon(1e-12));
}

TEST_CASE("the same seed gives the same waves, another seed others") {
  const Spectrum s = Spectrum::jonswap(2.0, 8.0);
  const WaveComponents a = realise(s, options_of(42)), b = realise(s, options_of(42)),
                       c = realise(s, options_of(43));
  CHECK(a.omega() == b.omega());
  CHECK(a.phase() == b.phase());
  CHECK(a.amplitude() == c.amplitude());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a.omega()[i] != c.omega()[i]);
    CHECK(a.phase()[i] != c.phase()[i]);
  }
}

TEST_CASE("jittered components do not repeat; equal spacing without jitter does") {
  const WaveComponents waves = realise(Spectrum::jonswap(2.0, 8.0), options_of(1));
  double worst = -1.0;
  for (double lag = 20.0; lag <= 1000.0; lag += 0.05) worst = std::max(worst, waves.autocorrelation(lag));
  CHECK(worst < 0.8);
  const RepeatPeriod jittered = waves.repeat_period(3600.0);
  CHECK_FALSE(jittered.found);
  CHECK(jittered.time == 3600.0);

  std::vector<double> omega, amplitude;
  for (int i = 1; i <= 20; ++i) {
    omega.push_back(0.1 * i);
    amplitude.push_back(0.2);
  }
  const std::vector<double> zero(20, 0.0);
  const RepeatPeriod regular = WaveComponents(omega, amplitude, zero, zero).repeat_period(600.0);
  CHECK(regular.found);
  // 0.99 is reached a little before the full period.
  CHECK(regular.time < 20.0 * std::numbers::pi);
  CHECK(regular.time > 20.0 * std::numbers::pi - 0.2);
  const RepeatPeriod one = WaveComponents({0.5}, {1.0}, {0.3}, {0.0}).repeat_period();
  CHECK(one.found);
  CHECK(one.time == doctest::Approx((2.0 * std::numbers::pi - std::acos(0.99)) / 0.5).epsilon(1e-5));
}

TEST_CASE("a regular wave travels to its direction") {
  // To port (+y): the crest passes y = 0 at t = 0 and y = lambda / 4 a quarter period later.
  const double omega = 0.8, half_pi = 0.5 * std::numbers::pi;
  const WaveComponents wave({omega}, {1.5}, {0.0}, {half_pi});
  const double quarter = half_pi / wave.wavenumber()[0];
  CHECK(wave.elevation(0.0, 0.0, 0.0) == doctest::Approx(1.5));
  CHECK(wave.elevation(half_pi / omega, 0.0, quarter) == doctest::Approx(1.5));
  CHECK(std::fabs(wave.elevation(half_pi / omega, 0.0, 0.0)) < 1e-12);
  CHECK(wave.elevation(0.0, 57.0, 0.0) == doctest::Approx(1.5));
  CHECK(wave.mean_period() == doctest::Approx(2.0 * std::numbers::pi / omega).epsilon(1e-14));
}

TEST_CASE("uniform placement: multiples of one width, each with the energy of the bin about it") {
  RealisationOptions o = options_of(1);
  o.placement = FrequencyPlacement::uniform;
  o.count = 220;
  const Spectrum s = Spectrum::jonswap(2.0, 8.0);
  const WaveComponents waves = realise(s, o);
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const double centre = 0.01 * static_cast<double>(30 + i);
    CHECK(waves.omega()[i] == doctest::Approx(centre).epsilon(1e-12));
    CHECK(0.5 * std::pow(waves.amplitude()[i], 2) ==
          doctest::Approx(s.energy(centre - 0.005, centre + 0.005)).epsilon(1e-9));
  }
  o.omega_min = 0.0;  // the first bin lies about one width, not about zero
  CHECK(realise(s, o).omega()[0] == doctest::Approx(2.5 / 220.0).epsilon(1e-12));
}

TEST_CASE("wave systems draw from random streams of their own") {
  RealisationOptions o = options_of(7);
  const Spectrum s = Spectrum::jonswap(2.0, 8.0);
  const WaveComponents first = realise(s, o);
  o.system = 2;
  const WaveComponents third = realise(s, o);
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first.phase()[i] == 2.0 * std::numbers::pi * Philox::uniform(7, 1, i));
    CHECK(third.phase()[i] == 2.0 * std::numbers::pi * Philox::uniform(7, 7, i));
    CHECK(third.omega()[i] != first.omega()[i]);
  }
}

TEST_CASE("bad realisation options are named with their value and the fix") {
  RealisationOptions o = options_of(1);
  o.count = 0;
  CHECK(message(o).find("wave realisation: count is 0; give 1 to") == 0);
  o = options_of(1);
  o.omega_min = 2.5;
  o.omega_max = 0.3;
  CHECK(message(o).find("maximum_omega is 0.3; give a finite frequency in rad/s above minimum_omega") !=
        std::string::npos);
  o = options_of(1);
  o.omega_min = std::numeric_limits<double>::quiet_NaN();
  CHECK(message(o).find("minimum_omega is nan") != std::string::npos);
  o = options_of(1);
  o.direction = std::numeric_limits<double>::infinity();
  CHECK(message(o).find("direction is inf") != std::string::npos);
  o = options_of(1);
  o.depth = -30.0;
  CHECK(message(o).find("depth is -30; give a depth above zero") != std::string::npos);
  CHECK_THROWS_AS(WaveComponents({}, {}, {}, {}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(WaveComponents({1.0, 0.0}, {1.0, 1.0}, {0.0, 0.0}, {0.0, 0.0}),
                       "wave components: omega[1] is 0; give a frequency above zero in rad/s",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(WaveComponents({1.0}, {1.0, 1.0}, {0.0}, {0.0}),
                       "wave components: length of amplitude is 2; give one value per frequency (1)",
                       std::invalid_argument);
}
