#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "seacrane/math/pack.hpp"
#include "seacrane/math/random.hpp"
#include "seacrane/math/rotation.hpp"

using namespace seacrane;

namespace {

using P = Pack<2>;
constexpr double kRounding = 4.5e-16;

P random_pack(Random& random, double largest) {
  P out;
  for (int lane = 0; lane < 2; ++lane) out.set(lane, largest * random.vector()[lane]);
  return out;
}

}  // namespace

TEST_CASE("functions of packs are those of the library, lane by lane") {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double largest = std::pow(10.0, i % 7 - 3);
    const P x = random_pack(random, largest), y = random_pack(random, largest);
    const P unit = y / (abs(x) + abs(y));
    for (int lane = 0; lane < 2; ++lane) {
      CHECK(std::abs(sin(x)[lane] - std::sin(x[lane])) <= kRounding);
      CHECK(std::abs(cos(x)[lane] - std::cos(x[lane])) <= kRounding);
      CHECK(atan2(y, x)[lane] == doctest::Approx(std::atan2(y[lane], x[lane])).epsilon(kRounding));
      CHECK(asin(unit)[lane] == doctest::Approx(std::asin(unit[lane])).epsilon(2.0 * kRounding));
      CHECK(sqrt(abs(x))[lane] == std::sqrt(std::abs(x[lane])));
      CHECK(floor(x)[lane] == std::floor(x[lane]));
      CHECK(min(x, y)[lane] == std::min(x[lane], y[lane]));
      CHECK(max(x, y)[lane] == std::max(x[lane], y[lane]));
    }
  }
}

TEST_CASE("arc tangents on the axes of the plane are those of the library") {
  for (const double y : {0.0, -0.0, 1.0, -1.0}) {
    for (const double x : {0.0, -0.0, 2.0, -2.0}) {
      CHECK(std::abs(atan2(P(y), P(x))[1] - std::atan2(y, x)) <= kRounding);
      CHECK(std::signbit(atan2(P(y), P(x))[0]) == std::signbit(std::atan2(y, x)));
    }
  }
}

TEST_CASE("what does not hold in one lane is no number there alone") {
  P x(4.0);
  x.set(1, -1.0);
  const P root = sqrt(valid_where(x > P(0.0), x, [](const auto&) { FAIL("packs do not throw"); }));
  CHECK(root[0] == 2.0);
  CHECK(std::isnan(root[1]));
  CHECK(std::isnan(sin(P(1e7))[0]));  // beyond what the reduction holds for
}

TEST_CASE("angles of rotations on packs are those of each lane") {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Mat3d one = random.rotation(), other = random.rotation();
    Mat3<P> both;
    for (int k = 0; k < 9; ++k) {
      const double lanes[] = {one(k), other(k)};
      both(k) = P::load(lanes);
    }
    const Vec3<P> angles = roll_pitch_yaw<P>(both);
    for (int k = 0; k < 3; ++k) {
      CHECK(std::abs(angles[k][0] - roll_pitch_yaw<double>(one)[k]) < 1e-14);
      CHECK(std::abs(angles[k][1] - roll_pitch_yaw<double>(other)[k]) < 1e-14);
    }
  }
}
