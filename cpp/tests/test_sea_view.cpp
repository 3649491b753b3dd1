#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <random>

#include "random_sea.hpp"
#include "seacrane/sea/flow_evaluator.hpp"
#include "seacrane/sea/sea_field.hpp"
#include "seacrane/sea/sea_view.hpp"

using namespace seacrane;
using test::RandomSea;
using test::shear;
using test::variables;

TEST_CASE("slopes are those of differences, with stretching, filter, profile and a moving point") {
  RandomSea random{std::mt19937_64(17)};
  const auto sea = std::make_shared<const SeaField>(random.waves(25, 22.0, shear()));
  const SeaView view(sea, {{"point", 1, 1e-14}});
  const Vec3d place(4.0, -3.0, -2.7);
  // A point whose place depends on two numbers.
  const Vec3d first(0.2, 0.7, -0.4), second(-0.5, 0.1, 0.9);
  Vec3<Dual<2>> point;
  for (int i = 0; i < 3; ++i) {
    point[i] = Dual<2>(place[i]);
    point[i].slope = {first[i], second[i]};
  }
  const LocalFlow<Dual<2>> flow = view.at_point<Dual<2>>(0, 8.0, point);
  const LocalFlow<Dual<2>> same = sea->at<Dual<2>>(8.0, point);
  constexpr double h = 1e-5;
  for (std::size_t n = 0; n < 2; ++n) {
    const Vec3d along = n == 0 ? first : second;
    const LocalFlow<double> up = sea->at<double>(8.0, place + h * along),
                            down = sea->at<double>(8.0, place - h * along);
    LocalFlow<double> slope = up;
    LocalFlow<double>::each(down, slope, [](double a, double& b) { b = (b - a) / (2.0 * h); });
    LocalFlow<double>::each(flow, slope, [&](const Dual<2>& a, double& b) {
      CHECK(a.slope[n] == doctest::Approx(b).epsilon(1e-7).scale(1e-2));
    });
  }
  LocalFlow<Dual<2>> off = same;
  LocalFlow<Dual<2>>::each(flow, off, [](const Dual<2>& a, Dual<2>& b) {
    CHECK(a.value == doctest::Approx(b.value).epsilon(1e-12));
    for (std::size_t n = 0; n < 2; ++n) CHECK(a.slope[n] == doctest::Approx(b.slope[n]).epsilon(1e-11));
  });
}

TEST_CASE("a view gives the flow at the point of a stencil, and its slopes") {
  RandomSea random{std::mt19937_64(18)};
  const auto sea = std::make_shared<const SeaField>(random.waves(25, 60.0));
  const SeaView view(sea, {{"other", 4}, {"part", 1, 1e-9}});
  const Vec3d place(4.0, -3.0, -2.7);
  const Mat3d extents = Mat3d::Identity() * 3.0;
  const Vec3d turning(0.2, -0.1, 0.4), step = Vec3d::Zero();
  const LocalFlow<double> flow = view.in_row<double>(1, 0, 8.0, {place, extents, turning, 2.0}, step);
  const LocalFlow<Dual<3>> slopes = view.in_row<Dual<3>>(
      1, 0, 8.0,
      {variables(place), extents.cast<Dual<3>>().eval(), turning.cast<Dual<3>>().eval(), Dual<3>(2.0)},
      step.cast<Dual<3>>().eval());
  LocalFlow<double> off = flow;
  LocalFlow<double>::each(slopes, off, [](const Dual<3>& a, double& b) { b = std::fabs(a.value - b); });
  LocalFlow<double>::each(sea->magnitude(), off, [](double size, double& b) { CHECK(b <= 2e-9 * size); });
  CHECK(slopes.pressure.slope[2] == doctest::Approx(-flow.acceleration.z()).epsilon(0.2));
}

TEST_CASE("a stencil meets as many times the waves as it says, and the current once") {
  constexpr double factor = 1.6;
  const auto times = [](double more) {
    return std::make_shared<const SeaField>(RandomSea{std::mt19937_64(21)}.waves(25, 60.0, shear(), more));
  };
  const auto sea = times(1.0), higher = times(factor);
  const SeaView view(sea, {{.name = "part", .cut = 1e-9, .waves = factor}}),
      other(higher, {{"part", 1, 1e-9}});
  CHECK(view.crest(0) == doctest::Approx(other.crest(0)).epsilon(1e-14));
  const FlowPoint at{Vec3d(4.0, -3.0, -2.7), Mat3d::Identity() * 3.0, Vec3d(0.2, -0.1, 0.4), 2.0};
  const auto check = [](const LocalFlow<double>& one, LocalFlow<double> two) {
    LocalFlow<double>::each(one, two,
                            [](double a, double& b) { CHECK(a == doctest::Approx(b).epsilon(1e-11)); });
  };
  const Vec3d none = Vec3d::Zero();
  check(view.in_row<double>(0, 0, 8.0, at, none), other.in_row<double>(0, 0, 8.0, at, none));
  const auto slopes = view.at_point<Dual<3>>(0, 8.0, variables(at.position)),
             same = other.at_point<Dual<3>>(0, 8.0, variables(at.position));
  LocalFlow<Dual<3>> off = same;
  LocalFlow<Dual<3>>::each(slopes, off, [](const Dual<3>& a, const Dual<3>& b) {
    CHECK(a.value == doctest::Approx(b.value).epsilon(1e-11));
    for (std::size_t n = 0; n < 3; ++n) CHECK(a.slope[n] == doctest::Approx(b.slope[n]).epsilon(1e-11));
  });
}

TEST_CASE("without a field the water is still") {
  FlowEvaluator evaluator(nullptr, {"part", 3});
  for (const LocalFlow<double>& flow : evaluator.line(5.0, Vec3d::Zero(), Vec3d::UnitX())) {
    CHECK(flow.elevation == 0.0);
    CHECK(flow.velocity.isZero(0.0));
  }
  const SeaView view(nullptr, {{"part", 1}});
  CHECK(std::isinf(view.depth()));
  CHECK(view.at_point<double>(0, 1.0, Vec3d::Zero()).pressure == 0.0);
}
