#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "seacrane/sea/wave_kinematics.hpp"

using namespace seacrane;

TEST_CASE("a regular wave moves the water as the closed form says, at every depth") {
  constexpr double w = 0.9, a = 0.6, b = 2.1, t = 4.3, x = 7.0, y = -12.0, z = -3.0;
  for (const double depth : {8.0, 40.0, 5000.0}) {
    CAPTURE(depth);
    const WaveComponents wave({w}, {a}, {0.4}, {b}, depth);
    const double k = wave.wavenumber()[0];
    const double angle = w * t - k * (x * std::cos(b) + y * std::sin(b)) + 0.4;
    // Ratios by exponentials that stay finite: cosh and sinh themselves overflow at 5000 m.
    const double e = std::exp(-2.0 * k * (z + depth)), f = std::exp(-2.0 * k * depth);
    const double along = std::exp(k * z) * (1.0 + e) / (1.0 - f),
                 up = std::exp(k * z) * (1.0 - e) / (1.0 - f);
    const WaveParticle p = kinematics(wave, t, x, y, z, Stretching::none);
    CHECK(p.submerged);
    CHECK(p.velocity[0] == doctest::Approx(a * w * along * std::cos(b) * std::cos(angle)).epsilon(1e-12));
    CHECK(p.velocity[1] == doctest::Approx(a * w * along * std::sin(b) * std::cos(angle)).epsilon(1e-12));
    CHECK(p.velocity[2] == doctest::Approx(-a * w * up * std::sin(angle)).epsilon(1e-12));
    CHECK(p.acceleration[2] == doctest::Approx(-a * w * w * up * std::cos(angle)).epsilon(1e-12));
    // Bernoulli, linearised: pressure over density is omega / k times the velocity along the wave.
    const double speed = p.velocity[0] * std::cos(b) + p.velocity[1] * std::sin(b);
    CHECK(p.pressure_per_density == doctest::Approx(speed * w / k).epsilon(1e-12));
  }
}

TEST_CASE("points in air have no water, points below the sea floor are refused") {
  const WaveComponents wave({0.7}, {1.0}, {0.0}, {0.0}, 20.0);
  const WaveParticle air = kinematics(wave, 0.0, 0.0, 0.0, 1.001);
  CHECK_FALSE(air.submerged);
  CHECK(air.elevation == doctest::Approx(1.0));
  CHECK(air.velocity[0] == 0.0);
  const WaveParticle crest = kinematics(wave, 0.0, 0.0, 0.0, 1.0);
  CHECK(crest.submerged);
  CHECK(crest.pressure_per_density == doctest::Approx(9.80665).epsilon(1e-14));
  CHECK_THROWS_AS(kinematics(wave, 0.0, 0.0, 0.0, -20.1), std::invalid_argument);
  CHECK_THROWS_AS(kinematics(wave, 0.0, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN()),
                  std::invalid_argument);
}
