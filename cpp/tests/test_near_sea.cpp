#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "count_allocations.hpp"
#include "random_sea.hpp"
#include "seacrane/sea/sea_view.hpp"

using namespace seacrane;
using test::RandomSea;

static const std::vector<FlowStencil> row = {{.name = "row", .count = 9, .reach = 6.0, .width = 3.0}};

TEST_CASE("few components are the sea in 40 seas and regions, whatever was asked before") {
  RandomSea random{std::mt19937_64(31)};
  for (int trial = 0; trial < 40; ++trial) {
    const double depth = trial % 2 ? std::numeric_limits<double>::infinity() : random.number(12.0, 60.0),
                 t = random.number(0.0, 9e3);
    const auto sea = random.long_crested(depth, trial % 3 ? Current() : test::shear());
    REQUIRE(NearSea::of(sea, row));
    const SeaView view(sea, row, NearSea::of(sea, row)), other(sea, row, NearSea::of(sea, row));
    const Vec3d step = 1.1 * random.vector(1.0).normalized(), wide = random.vector(1.0);
    const FlowPoint at{random.vector(200.0).cwiseProduct(Vec3d(1, 1, 0.05)), wide.asDiagonal(), wide, 2.0};
    other.row(0, random.number(0.0, 9e3), {Vec3d(random.number(-99.0, 99.0), 7.0, 0.0)}, step);
    const auto few = view.row(0, t, at, step), same = other.row(0, t, at, step);
    CHECK(std::memcmp(few.data(), same.data(), few.size_bytes()) == 0);
    FlowEvaluator all(sea, {.name = "row", .count = 9, .cut = 1e-12});
    double pull = 0.0;  // square of the deviation of accelerations
    for (std::size_t i = 0; i < 200; ++i)
      pull += 0.5 * std::pow(sea->arrays().amplitude[i] * std::pow(sea->arrays().omega[i], 2), 2);
    for (std::size_t n = 0; n < few.size(); ++n) {
      LocalFlow<double> off = all.row(t, at, step)[n];
      CHECK((few[n].acceleration - off.acceleration).norm() < 1e-6 * std::sqrt(pull));
      LocalFlow<double>::each(few[n], off, [](double a, double& b) { b = std::fabs(a - b); });
      CHECK(off.elevation < 2e-7);  // 1e-7 Hs
      LocalFlow<double>::each(sea->magnitude(), off, [](double all, double& b) { CHECK(b <= 1.1e-6 * all); });
    }
  }
}

TEST_CASE("from region to region the sea has two derivatives, and nothing is allocated") {
  RandomSea random{std::mt19937_64(32)};
  const auto sea = random.long_crested(std::numeric_limits<double>::infinity(), {});
  const auto near = NearSea::of(sea, row);
  const SeaView view(sea, row, near);
  const double middle = 0.5 * near->spacing(), h = middle * NearSea::overlap / 100.0;
  const long before = test::allocation_count();
  double last[3] = {}, most = 0.0,
         jump = 0.0;  // differences of the error: 200 steps over an overlap, and beyond
  for (int i = -150; i < 150; ++i) {
    const Vec3d place = (middle + i * h) * Vec3d(sea->arrays().x[0], sea->arrays().y[0], 0.0);
    const double off =
        view.at_point<double>(0, 40.0, place).elevation - sea->at<double>(40.0, place).elevation;
    const double bend = off - 2.0 * last[0] + last[1];
    if (i > -148) most = std::max(most, std::fabs(bend));
    if (i > -147) jump = std::max(jump, std::fabs(bend - last[2]));
    last[2] = bend, last[1] = last[0], last[0] = off;
  }
  CHECK(test::allocation_count() == before);
  CHECK(jump < 0.1 * most);
  const double astray = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(view.at_point<double>(0, 40.0, Vec3d(astray, 0.0, 0.0)).elevation));
  CHECK_FALSE(NearSea::of(std::make_shared<const SeaField>(random.waves(200, 60.0)), row));  // short-crested
  CHECK_FALSE(near->serves({.name = "long", .reach = 6.1}));
  CHECK_FALSE(near->serves({.name = "wide", .reach = 6.0, .width = 10.0}));
}
