#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "seacrane/math/curve.hpp"

namespace seacrane::test {
namespace {

/// Rate and acceleration of a curve against four-point differences of its value and rate.
void check_derivatives(const Curve& c, double t) {
  const double h = 1e-3;
  const auto slope = [&](auto&& f) {
    return (8.0 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12.0 * h);
  };
  CAPTURE(t);
  CHECK(c.at(t).rate == doctest::Approx(slope([&](double s) { return c.at(s).value; })).epsilon(1e-9));
  CHECK(c.at(t).acceleration == doctest::Approx(slope([&](double s) { return c.at(s).rate; })).epsilon(1e-9));
}

Curve::Piece piece(double start, std::array<double, 6> coefficients) {
  Curve::Piece p;
  p.start = start;
  p.coefficients = coefficients;
  return p;
}

}  // namespace

TEST_CASE("a curve of pieces: polynomial plus cosine, each from its start") {
  Curve::Piece second = piece(2.0, {1.0, -1.0, 0.5, 0.2, -0.1, 0.05});
  second.amplitude = 0.7;
  second.omega = 3.0;
  second.phase = 0.4;
  const Curve c({piece(0.5, {3.0, 2.0, 1.0, 0.0, 0.0, 0.0}), second});
  for (const double t : {0.7, 1.9, 2.5, 4.0}) check_derivatives(c, t);
  CHECK(c.at(1.5).value == doctest::Approx(3.0 + 2.0 + 1.0));
  CHECK(c.at(3.0).value == doctest::Approx(1.0 - 1.0 + 0.5 + 0.2 - 0.1 + 0.05 + 0.7 * std::cos(3.4)));
  SUBCASE("before its first start it is at rest at its first value") {
    CHECK(c.at(-1.0).value == 3.0);
    CHECK(c.at(0.499).rate == 0.0);
    CHECK(c.at(0.499).acceleration == 0.0);
  }
}

TEST_CASE("the default curve and a constant are at rest") {
  CHECK(Curve().at(3.0).value == 0.0);
  CHECK(Curve::constant(2.5).at(-4.0).value == 2.5);
  CHECK(Curve::constant(2.5).at(4.0).rate == 0.0);
  CHECK(Curve::constant(2.5).breakpoints().empty());
}

TEST_CASE("a quintic moves from rest to rest without acceleration at its ends") {
  const Curve c = Curve::quintic(1.0, 5.0, -2.0, 4.0);
  for (const double t : {1.0, 5.0}) {
    CHECK(std::abs(c.at(t).rate) < 1e-13);
    CHECK(std::abs(c.at(t).acceleration) < 1e-13);
    CHECK(std::abs(c.at(t, t).acceleration) < 1e-12);  // from the left
  }
  CHECK(c.at(0.0).value == -2.0);
  CHECK(c.at(9.0).value == 4.0);
  CHECK(c.at(3.0).value == doctest::Approx(1.0));               // half way by symmetry
  CHECK(c.at(3.0).rate == doctest::Approx(1.875 * 6.0 / 4.0));  // largest rate 15/8 d/h
  for (const double t : {1.3, 3.0, 4.7}) check_derivatives(c, t);
  CHECK(c.breakpoints().empty());
  CHECK_THROWS_AS(Curve::quintic(2.0, 2.0, 0.0, 1.0), std::invalid_argument);
}

TEST_CASE("then() switches at the time given and re-expands the later curve about it") {
  const Curve first = Curve::quintic(0.0, 4.0, 0.0, 1.0);
  const Curve later({piece(1.0, {2.0, -1.0, 0.3, 0.1, -0.2, 0.05})});
  const Curve swing = Curve::harmonic(2.0, 1.0, 0.5, 1.7, 0.3);
  for (const Curve& next : {later, swing}) {
    const Curve both = first.then(3.0, next);
    for (const double t : {-1.0, 0.0, 1.0, 2.9}) CHECK(both.at(t).value == first.at(t).value);
    for (const double t : {3.0, 3.5, 8.0}) {
      CHECK(both.at(t).value == doctest::Approx(next.at(t).value).epsilon(1e-13));
      CHECK(both.at(t).rate == doctest::Approx(next.at(t).rate).epsilon(1e-13));
      CHECK(both.at(t).acceleration == doctest::Approx(next.at(t).acceleration).epsilon(1e-13));
    }
  }
  SUBCASE("a later curve that has not started yet is held at its first value") {
    const Curve both = first.then(0.5, later);
    CHECK(both.at(0.7).value == 2.0);
    CHECK(both.at(0.7).rate == 0.0);
    CHECK(both.at(1.5).value == doctest::Approx(later.at(1.5).value));
  }
  SUBCASE("pieces of the first that start after the switch are gone") {
    CHECK(first.then(3.0, later).at(5.0).value == doctest::Approx(later.at(5.0).value));
  }
  SUBCASE("before all its pieces a curve is at rest, also where it is the first of two") {
    const Curve both = Curve::quintic(2.0, 4.0, 3.0, 5.0).then(6.0, Curve::constant(1.0));
    CHECK(both.at(0.0).value == 3.0);
  }
}

TEST_CASE("at a jump the limit from the left is used until the step has passed it") {
  const Curve c = Curve::constant(1.0).then(2.0, Curve::harmonic(2.0, 3.0, 1.0, 2.0, 0.0));
  CHECK(c.at(2.0).value == doctest::Approx(4.0));
  CHECK(c.at(2.0, 2.0).value == 1.0);
  CHECK(c.at(2.0, 2.0).acceleration == 0.0);
  CHECK(c.at(2.0, 2.5).value == doctest::Approx(4.0));
  CHECK(c.at(1.0, 2.0).value == 1.0);
  const Curve late = Curve::harmonic(2.0, 0.0, 1.0, 2.0, 0.0);
  CHECK(late.at(2.0, 2.0).acceleration == 0.0);
  CHECK(late.at(2.0).acceleration == doctest::Approx(-4.0));
}

TEST_CASE("breakpoints are where the value, rate or acceleration jumps, by the derivatives asked for") {
  const Curve jump = Curve::constant(0.0).then(1.0, Curve::constant(1.0));
  const Curve kink({piece(0.0, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}), piece(2.0, {0.0, 1.0, 0.0, 0.0, 0.0, 0.0})});
  const Curve bend({piece(0.0, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}), piece(3.0, {0.0, 0.0, 1.0, 0.0, 0.0, 0.0})});
  const Curve jerk({piece(0.0, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}), piece(4.0, {0.0, 0.0, 0.0, 1.0, 0.0, 0.0})});
  for (int derivatives = 0; derivatives <= 2; ++derivatives) {
    CHECK(jump.breakpoints(derivatives) == std::vector<double>{1.0});
    CHECK(kink.breakpoints(derivatives).size() == (derivatives >= 1 ? 1 : 0));
    CHECK(bend.breakpoints(derivatives).size() == (derivatives >= 2 ? 1 : 0));
    CHECK(jerk.breakpoints(derivatives).empty());
  }
  // A curve that starts with a rate jumps from the rest before it.
  CHECK(Curve({piece(0.5, {0.0, 1.0, 0.0, 0.0, 0.0, 0.0})}).breakpoints() == std::vector<double>{0.5});
}

TEST_CASE("bad pieces are refused by name") {
  CHECK_THROWS_AS(Curve(std::vector<Curve::Piece>{}), std::invalid_argument);
  CHECK_THROWS_AS(Curve({piece(1.0, {}), piece(1.0, {})}), std::invalid_argument);
  CHECK_THROWS_WITH(Curve({piece(0.0, {std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 0})}),
                    "curve: piece 0 holds a value that is not finite");
}

}  // namespace seacrane::test
