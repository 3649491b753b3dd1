#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "count_allocations.hpp"
#include "random_sea.hpp"
#include "seacrane/sea/flow_evaluator.hpp"
#include "seacrane/sea/sea_field.hpp"
#include "seacrane/sea/wave_kinematics.hpp"

using namespace seacrane;
using test::RandomSea;
using test::shear;
using test::variables;

namespace {

constexpr double deep = std::numeric_limits<double>::infinity();

/// Largest ratio of |one - other| to `bound`, over all numbers; where the bound is zero, both are alike.
double worst(const LocalFlow<double>& one, const LocalFlow<double>& other, const LocalFlow<double>& bound) {
  double out = 0.0;
  LocalFlow<double> off = other;
  LocalFlow<double>::each(one, off, [](double a, double& b) { b = std::fabs(a - b); });
  LocalFlow<double>::each(bound, off, [&](double limit, double& b) {
    if (b > 0.0) out = std::max(out, b / limit);
  });
  return out;
}

}  // namespace

TEST_CASE("wave numbers and kinematics of shallow water, and wave numbers on a current") {
  // Numbers computed apart from this code, with g = 9.80665.
  const double period[4] = {6.0, 8.0, 12.0, 16.0};
  const double shallow[4] = {0.11417253, 0.07078053, 0.04124785, 0.02959777};
  const double endless[4] = {0.11182440, 0.06290122, 0.02795610, 0.01572531};
  for (int i = 0; i < 4; ++i) {
    const double w = 2.0 * std::numbers::pi / period[i];
    CHECK(WaveComponents({w}, {1.0}, {0.0}, {0.0}, 20.0).wavenumber()[0] ==
          doctest::Approx(shallow[i]).epsilon(2e-7));
    CHECK(WaveComponents({w}, {1.0}, {0.0}, {0.0}).wavenumber()[0] ==
          doctest::Approx(endless[i]).epsilon(4e-7));
  }
  const double w12 = 2.0 * std::numbers::pi / 12.0, w8 = 2.0 * std::numbers::pi / 8.0;
  const SeaField sea(WaveComponents({w12}, {1.0}, {0.0}, {0.0}, 20.0), Stretching::none);
  const LocalFlow<double> crest = sea.at<double>(0.0, Vec3d(0.0, 0.0, -10.0));
  const LocalFlow<double> quarter = sea.at<double>(9.0, Vec3d(0.0, 0.0, -10.0));
  CHECK(crest.velocity.x() == doctest::Approx(0.617051).epsilon(1e-6));
  CHECK(crest.pressure == doctest::Approx(7.832828).epsilon(1e-7));
  CHECK(quarter.velocity.z() == doctest::Approx(0.241005).epsilon(2e-6));
  const Current along({0.0}, {1.0}, {0.0}), against({0.0}, {-1.0}, {0.0});
  CHECK(along.wavenumber(w8, 1.0, 0.0, deep, 9.80665) == doctest::Approx(0.054478).epsilon(1e-5));
  CHECK(against.wavenumber(w8, 1.0, 0.0, deep, 9.80665) == doctest::Approx(0.075592).epsilon(1e-5));
  CHECK(against.wavenumber(w8, 0.0, 1.0, deep, 9.80665) == doctest::Approx(0.06290122).epsilon(4e-7));
}

TEST_CASE("a current stops waves beyond a quarter of g over the frequency, and they are refused") {
  // Deep water: (w - k U)^2 = g k has real roots for w |U| <= g / 4 alone.
  for (const double speed : {0.5, 1.0, 2.0}) {
    const Current against({0.0}, {-speed}, {0.0});
    const double last = standard_gravity / (4.0 * speed);
    CHECK_FALSE(std::isnan(against.wavenumber(0.999 * last, 1.0, 0.0, deep, standard_gravity)));
    CHECK(std::isnan(against.wavenumber(1.001 * last, 1.0, 0.0, deep, standard_gravity)));
    CHECK_THROWS_WITH_AS(WaveComponents({1.001 * last}, {1.0}, {0.0}, {0.0}, deep, standard_gravity, against),
                         doctest::Contains("stops this wave"), std::invalid_argument);
  }
}

TEST_CASE("a profile carries waves as the integral of Skop and of Stewart and Joy says") {
  const Current profile = shear();
  for (const double depth : {12.0, 40.0, deep}) {
    for (const double k : {0.01, 0.08, 0.5}) {
      CAPTURE(depth);
      CAPTURE(k);
      const double bottom = std::isinf(depth) ? 30.0 / k : depth;
      constexpr int steps = 200'000;
      double sum = 0.0;
      for (int i = 0; i < steps; ++i) {
        const double z = -bottom * (i + 0.5) / steps;
        const double weight = std::isinf(depth)
                                  ? 2.0 * k * std::exp(2.0 * k * z)
                                  : 2.0 * k * std::cosh(2.0 * k * (depth + z)) / std::sinh(2.0 * k * depth);
        const auto u = profile.at<double>(z);
        sum += weight * (0.8 * u.x + 0.6 * u.y) * bottom / steps;
      }
      CHECK(profile.carrying(k, 0.8, 0.6, depth) == doctest::Approx(sum).epsilon(1e-6));
    }
  }
  const Current uniform({0.0, 20.0}, {0.7, 0.7}, {0.0, 0.0});
  CHECK(uniform.carrying(0.1, 1.0, 0.0, 15.0) == 0.7);
}

TEST_CASE("the field without stretching is harmonic, and moves without divergence or rotation") {
  RandomSea random{std::mt19937_64(3)};
  for (const double depth : {15.0, 60.0, deep}) {
    const Current uniform({0.0}, {0.5}, {-0.3});
    const SeaField sea(random.waves(40, depth, uniform), Stretching::none);
    for (int trial = 0; trial < 5; ++trial) {
      const Vec3d place(random.number(-80.0, 80.0), random.number(-80.0, 80.0), random.number(-14.0, -0.1));
      const LocalFlow<Dual<3>> flow = sea.at<Dual<3>>(random.number(0.0, 3e3), variables(place));
      double divergence = 0.0, of_acceleration = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        divergence += flow.velocity[static_cast<int>(i)].slope[i];
        of_acceleration += flow.acceleration[static_cast<int>(i)].slope[i];
        // Euler: the gradient of the pressure is the water's acceleration, so that its divergence is minus
        // the Laplacian of the pressure.
        CHECK(flow.pressure.slope[i] ==
              doctest::Approx(-flow.acceleration[static_cast<int>(i)].value).epsilon(1e-12));
        for (std::size_t j = 0; j < i; ++j) {
          CHECK(std::fabs(flow.velocity[static_cast<int>(i)].slope[j] -
                          flow.velocity[static_cast<int>(j)].slope[i]) < 1e-12);
        }
      }
      CHECK(std::fabs(divergence) < 1e-12);
      CHECK(std::fabs(of_acceleration) < 1e-12);
    }
  }
}

TEST_CASE("at the still water the water rises with the surface, along a current with what it carries") {
  RandomSea random{std::mt19937_64(5)};
  const Current uniform({0.0}, {0.8}, {0.2});
  for (const double depth : {20.0, deep}) {
    for (const Current& current : {Current(), uniform}) {
      const SeaField sea(random.waves(30, depth, current), Stretching::none);
      const LocalFlow<double> flow = sea.at<double>(77.0, Vec3d(3.0, -8.0, 0.0));
      const auto u = current.at<double>(0.0);
      const double rise = flow.elevation_rate + u.x * flow.slope[0] + u.y * flow.slope[1];
      CHECK(flow.velocity.z() == doctest::Approx(rise).epsilon(1e-12));
    }
  }
}

TEST_CASE("a towed point meets waves at omega - k U cos b") {
  constexpr double w = 0.7, b = 0.9, speed = 2.3;
  const WaveComponents wave({w}, {1.0}, {0.4}, {b}, 50.0);
  const SeaField sea(wave);
  const double met = w - wave.wavenumber()[0] * speed * std::cos(b);
  for (const double t : {0.0, 3.0, 100.0}) {
    CHECK(sea.at<double>(t, Vec3d(speed * t, 0.0, -1.0)).elevation ==
          doctest::Approx(std::cos(met * t + 0.4)).epsilon(1e-12));
  }
  // On a current of the same speed, a point that drifts with it meets the frequency of the water.
  const WaveComponents carried({w}, {1.0}, {0.4}, {b}, 50.0, standard_gravity,
                               Current({0.0}, {speed}, {0.0}));
  const double own = carried.intrinsic()[0], k = carried.wavenumber()[0];
  CHECK(own * own == doctest::Approx(standard_gravity * k * std::tanh(50.0 * k)).epsilon(1e-12));
  CHECK(SeaField(carried).at<double>(9.0, Vec3d(speed * 9.0, 0.0, -1.0)).elevation ==
        doctest::Approx(std::cos(own * 9.0 + 0.4)).epsilon(1e-12));
}

TEST_CASE("the stretched pressure vanishes at the surface, and the field is that of the plain sums") {
  RandomSea random{std::mt19937_64(7)};
  for (const double depth : {18.0, deep}) {
    const WaveComponents waves = random.waves(35, depth, shear());
    for (const Stretching stretching : {Stretching::wheeler, Stretching::none}) {
      const SeaField sea(waves, stretching);
      for (int trial = 0; trial < 6; ++trial) {
        const double t = random.number(0.0, 500.0), x = random.number(-50.0, 50.0);
        const double eta = waves.elevation(t, x, 4.0), z = trial == 0 ? eta : -2.5 * trial;
        const LocalFlow<double> flow = sea.at<double>(t, Vec3d(x, 4.0, z));
        if (stretching == Stretching::wheeler && trial == 0) {
          CHECK(std::fabs(flow.pressure - standard_gravity * z) < 1e-12);
        }
        const WaveParticle plain = kinematics(waves, t, x, 4.0, std::min(z, eta), stretching);
        CHECK(std::fabs(flow.elevation - plain.elevation) < 1e-13);
        CHECK(std::fabs(flow.pressure - plain.pressure_per_density) < 1e-12);
        for (int i = 0; i < 3; ++i) {
          CHECK(std::fabs(flow.velocity[i] - plain.velocity[idx(i)]) < 1e-12);
          CHECK(std::fabs(flow.acceleration[i] - plain.acceleration[idx(i)]) < 1e-12);
        }
      }
    }
  }
}

TEST_CASE("lines and clouds are the plain sums within their stated bound") {
  RandomSea random{std::mt19937_64(11)};
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const double depth = trial % 3 == 0 ? 25.0 : trial % 3 == 1 ? 300.0 : deep;
    const Current current = trial % 4 == 0 ? shear() : Current();
    const auto stretching = trial % 2 == 0 ? Stretching::wheeler : Stretching::none;
    const std::size_t count = 1 + static_cast<std::size_t>(trial) % 23;
    const double cut = trial % 5 == 0 ? 1e-9 : 1e-5;
    const auto sea = std::make_shared<const SeaField>(
        random.waves(1 + static_cast<std::size_t>(random.number(0.0, 60.0)), depth, current), stretching);
    FlowEvaluator evaluator(sea, {"line", count, cut});
    const double t = random.number(0.0, 2e4);
    Vec3d step = random.vector(24.0 / static_cast<double>(count));
    if (trial % 7 == 0) step.head<2>().setZero();
    if (trial % 7 == 1) step.z() = 0.0;
    const Vec3d first(random.number(-200.0, 200.0), random.number(-200.0, 200.0),
                      -12.0 - 0.5 * static_cast<double>(count - 1) * step.z() + random.number(-3.0, 15.0));
    const bool whole = trial % 6 != 0;
    const LocalFlow<double> bound = evaluator.error_bound(t, 450.0, 450.0);
    const auto line = evaluator.line(t, first, step, whole);
    Mat3d extents = Mat3d::Zero();
    if (whole) extents.col(0) = step;
    std::vector<FlowPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
      points.push_back({first + static_cast<double>(i) * step, extents});
      if (depth < 300.0 && points.back().position.z() < -depth) continue;
      CHECK(worst(line[i], sea->at<double>(t, points.back().position, extents), bound) <= 1.0);
    }
    for (FlowPoint& point : points) point.extents += Mat3d::Random();
    const auto cloud = evaluator.cloud(t, points);
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(worst(cloud[i], sea->at<double>(t, points[i].position, points[i].extents), bound) <= 1.0);
    }
  }
}

TEST_CASE("rounding alone is left where nothing is cut") {
  RandomSea random{std::mt19937_64(12)};
  const auto sea = std::make_shared<const SeaField>(random.waves(200, deep), Stretching::none);
  FlowEvaluator evaluator(sea, {"line", 20, 1e-14});
  const Vec3d first(4.0, 2.0, -1.0), step(0.6, 0.1, -0.4);
  const auto line = evaluator.line(50.0, first, step);
  Mat3d extents = Mat3d::Zero();
  extents.col(0) = step;
  const LocalFlow<double> size = sea->magnitude();
  for (std::size_t i = 0; i < 20; ++i) {
    const LocalFlow<double> plain = sea->at<double>(50.0, first + static_cast<double>(i) * step, extents);
    CHECK(worst(line[i], plain, size) < 1e-13);
  }
}

TEST_CASE("what was evaluated before, elsewhere or at another time, changes no bit") {
  RandomSea random{std::mt19937_64(13)};
  const auto sea = std::make_shared<const SeaField>(random.waves(77, 30.0, shear()));
  FlowEvaluator one(sea, {"one", 9}), other(sea, {"other", 9});
  const Vec3d first(1.0, 2.0, -3.0), step(0.3, -0.2, 0.6);
  std::vector<FlowPoint> points(9);
  for (FlowPoint& point : points) point.position = random.vector(8.0) - Vec3d(0.0, 0.0, 9.0);
  const auto fresh = one.line(123.4, first, step);
  const std::vector<LocalFlow<double>> line(fresh.begin(), fresh.end());
  other.cloud(3.0, points);
  other.line(9999.0, Vec3d(0.0, 0.0, -20.0), Vec3d(2.0, 0.0, -0.5));
  const auto again = other.line(123.4, first, step);
  for (std::size_t i = 0; i < line.size(); ++i) {
    CHECK(std::memcmp(&line[i], &again[i], sizeof line[i]) == 0);
  }
  const auto shuffled = one.cloud(5.0, points);
  const std::vector<LocalFlow<double>> cloud(shuffled.begin(), shuffled.end());
  std::swap(points[0], points[8]);
  const auto swapped = other.cloud(5.0, points);
  CHECK(std::memcmp(&cloud[0], &swapped[8], sizeof cloud[0]) == 0);
}

TEST_CASE("the force of the undisturbed wave on a box, as a filtered sum and as pressures on its faces") {
  // 12 x 6 x 4 m, its top 2 m deep, long side along a wave of 8 s and 1 m in deep water.
  constexpr double rho = 1025.0, length = 12.0, breadth = 6.0, height = 4.0, expected = 138'615.297;
  const double w = 2.0 * std::numbers::pi / 8.0;
  const auto sea =
      std::make_shared<const SeaField>(WaveComponents({w}, {1.0}, {0.3}, {0.0}), Stretching::none);
  Mat3d extents = Mat3d::Zero();
  extents.col(0).x() = length;
  extents.col(1).y() = breadth;
  // Mean over the height by Gauss's rule of three points.
  const double reach = 0.5 * height * std::sqrt(0.6), weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  FlowEvaluator evaluator(sea, {"box", 3});
  std::vector<FlowPoint> points(3);
  for (int i = 0; i < 3; ++i) points[idx(i)] = {Vec3d(0.0, 0.0, -4.0 + (i - 1) * reach), extents};
  const auto force = [&](double t) {
    const auto flow = evaluator.cloud(t, points);
    Vec3d mean = Vec3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) mean += weight[i] * flow[i].acceleration;
    return Vec3d(rho * length * breadth * height * mean);
  };
  const double quarter = 2.0;
  CHECK(std::hypot(force(0.0).z(), force(quarter).z()) == doctest::Approx(expected).epsilon(1e-8));
  CHECK(std::hypot(force(0.0).x(), force(quarter).x()) == doctest::Approx(expected).epsilon(1e-8));
  FlowEvaluator whole(sea, {"box", 1});
  const Vec3d at_once = whole.row(1.1, {Vec3d(0.0, 0.0, -4.0), extents, Vec3d::Zero(), height}, Vec3d::Zero())
                            .front()
                            .acceleration;
  CHECK((rho * length * breadth * height * at_once - force(1.1)).norm() < 1e-8 * expected);

  // Pressures alone: top and bottom in strips along the wave, ends in strips over the height.
  const auto pressures = [&](double t) {
    constexpr int strips = 400;
    Vec3d sum = Vec3d::Zero();
    for (int i = 0; i < strips; ++i) {
      const double share = (i + 0.5) / strips - 0.5, x = share * length, z = -4.0 + share * height;
      const auto at = [&](double px, double pz) { return sea->at<double>(t, Vec3d(px, 0.0, pz)).pressure; };
      sum.z() += (at(x, -6.0) - at(x, -2.0)) * length * breadth / strips;
      sum.x() += (at(-0.5 * length, z) - at(0.5 * length, z)) * height * breadth / strips;
    }
    return Vec3d(rho * sum);
  };
  for (const double t : {0.0, 1.1, quarter}) {
    CHECK((pressures(t) - force(t)).norm() < 2e-6 * expected);
  }
}

TEST_CASE("over a height the flow is its mean over what of it is wet") {
  RandomSea random{std::mt19937_64(20)};
  for (const double depth : {deep, 15.0}) {
    for (const Stretching stretching : {Stretching::none, Stretching::wheeler}) {
      const auto sea = std::make_shared<const SeaField>(random.waves(12, depth), stretching);
      FlowEvaluator evaluator(sea, {"part", 1, 1e-14});
      for (const double z : {-6.0, -0.8, 0.6}) {
        CAPTURE(z);
        constexpr double height = 3.0;
        const Vec3d place(4.0, -3.0, z);
        const LocalFlow<double> flow =
            evaluator.row(8.0, {place, Mat3d::Zero(), Vec3d::Zero(), height}, Vec3d::Zero()).front();
        const double bottom = z - 0.5 * height, top = std::min(z + 0.5 * height, flow.elevation);
        LocalFlow<double> mean;
        constexpr int steps = 400;
        for (int i = 0; i < steps; ++i) {
          const double at = bottom + (top - bottom) * (i + 0.5) / steps;
          const LocalFlow<double> one = sea->at<double>(8.0, Vec3d(4.0, -3.0, at));
          LocalFlow<double>::each(one, mean, [](double from, double& to) { to += from / steps; });
        }
        // Where a part is near the still water, levels above it count as that: what stretching "none" says.
        const double close = stretching == Stretching::none && top > 0.0 ? 0.2 : 1e-3;
        CHECK(worst(flow, mean, sea->magnitude()) < close);
        LocalFlow<double> again =
            evaluator.row(8.0, {place, Mat3d::Zero(), Vec3d::Zero(), height}, Vec3d::Zero()).front();
        CHECK(worst(flow, again, LocalFlow<double>()) == 0.0);
        const LocalFlow<double> plain = sea->at<double>(8.0, place, Mat3d::Zero(), height);
        CHECK(worst(flow, plain, sea->magnitude()) < 1e-12);
      }
    }
  }
}

TEST_CASE("the surface over an element that turns changes by its turning too") {
  RandomSea random{std::mt19937_64(21)};
  const auto sea = std::make_shared<const SeaField>(random.waves(30, 40.0));
  FlowEvaluator evaluator(sea, {"part", 1, 1e-14});
  const Vec3d place(4.0, -3.0, -1.0), turning(0.3, -0.5, 0.8);
  const Mat3d extents = Eigen::AngleAxisd(0.7, Vec3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix() *
                        Vec3d(6.0, 3.0, 2.0).asDiagonal();
  const auto turned = [&](double angle) -> Mat3d {
    return Eigen::AngleAxisd(angle * turning.norm(), turning.normalized()).toRotationMatrix() * extents;
  };
  constexpr double h = 1e-4;
  const auto elevation = [&](double s) { return sea->at<double>(8.0 + s, place, turned(s)).elevation; };
  const double rate = (elevation(h) - elevation(-h)) / (2.0 * h);
  CHECK(evaluator.row(8.0, {place, extents, turning, 0.0}, Vec3d::Zero()).front().elevation_rate ==
        doctest::Approx(rate).epsilon(1e-6));
  CHECK(sea->at<double>(8.0, place, extents, 0.0, turning).elevation_rate ==
        doctest::Approx(rate).epsilon(1e-6));
  CHECK(std::fabs(evaluator.row(8.0, {place, extents}, Vec3d::Zero()).front().elevation_rate - rate) >
        1e-3 * std::fabs(rate));
}

TEST_CASE("a row of elements is that of each by itself, and is kept") {
  RandomSea random{std::mt19937_64(22)};
  const auto sea = std::make_shared<const SeaField>(random.waves(60, 30.0, shear()), Stretching::wheeler);
  FlowEvaluator evaluator(sea, {"row", 7, 1e-14});
  const FlowPoint first{Vec3d(2.0, 1.0, -2.0), Vec3d(3.0, 2.0, 1.0).asDiagonal(), Vec3d(0.1, -0.3, 0.2), 1.5};
  const Vec3d step(1.1, -0.4, 0.35);
  const auto row = evaluator.row(8.0, first, step);
  const std::vector<LocalFlow<double>> kept(row.begin(), row.end());
  for (std::size_t n = 0; n < row.size(); ++n) {
    CAPTURE(n);
    const Vec3d at = first.position + static_cast<double>(n) * step;
    const auto alone = sea->at<double>(8.0, at, first.extents, first.height, first.turning);
    CHECK(worst(row[n], alone, sea->magnitude()) < 1e-12);
  }
  evaluator.row(9.0, first, step);
  const auto again = evaluator.row(8.0, first, step);
  for (std::size_t n = 0; n < kept.size(); ++n) CHECK(worst(again[n], kept[n], LocalFlow<double>()) == 0.0);
}

TEST_CASE(
    "random rows are the plain sums of each element, from in air to deep, of small steps and of large ones") {
  RandomSea random{std::mt19937_64(23)};
  for (int trial = 0; trial < 80; ++trial) {
    CAPTURE(trial);
    const double depth = trial % 3 == 0 ? 25.0 : trial % 3 == 1 ? 60.0 : deep;
    const auto stretching = trial % 4 == 0 ? Stretching::none : Stretching::wheeler;
    const auto sea = std::make_shared<const SeaField>(
        random.waves(1 + static_cast<std::size_t>(random.number(0.0, 60.0)), depth), stretching);
    const std::size_t count = 1 + static_cast<std::size_t>(trial) % 20;
    FlowEvaluator evaluator(sea, {"row", count, 1e-14});
    const double size = std::pow(10.0, random.number(-2.0, 0.5)), height = random.number(0.0, 4.0);
    const FlowPoint first{Vec3d(4.0, -2.0, random.number(-9.0, 3.0)), Mat3d::Random(), random.vector(0.2),
                          trial % 5 == 0 ? 0.0 : height};
    Vec3d step = random.vector(size);
    step.z() = trial % 2 == 0 ? 0.1 * step.z() : std::clamp(step.z(), -0.5, 0.5);
    const auto row = evaluator.row(8.0, first, step);
    for (std::size_t n = 0; n < count; ++n) {
      CAPTURE(n);
      const Vec3d at = first.position + static_cast<double>(n) * step;
      const auto alone = sea->at<double>(8.0, at, first.extents, first.height, first.turning);
      CHECK(worst(row[n], alone, sea->magnitude()) < 1e-11);
    }
  }
}

TEST_CASE("an element feels its mean over the wave, and no wave shorter than itself") {
  const double k = 0.4, w = std::sqrt(standard_gravity * k);
  const auto sea = std::make_shared<const SeaField>(WaveComponents({w}, {1.0}, {0.0}, {0.0}));
  Mat3d extents = Mat3d::Zero();
  for (const double length : {1.0, 6.0, 15.0, 16.0}) {
    CAPTURE(length);
    extents.col(2) = Vec3d(length, 0.0, 0.0);
    double mean = 0.0;
    constexpr int steps = 20'000;
    for (int i = 0; i < steps; ++i) mean += std::cos(k * length * ((i + 0.5) / steps - 0.5)) / steps;
    const double felt = sea->filter<double>(0, extents);
    CHECK(felt == doctest::Approx(k * length < 2.0 * std::numbers::pi ? mean : 0.0).epsilon(1e-7));
    extents.col(2) = Vec3d(0.0, length, 0.0);  // along the crest
    CHECK(sea->filter<double>(0, extents) == 1.0);
  }
}

TEST_CASE("stencils allocate nothing when they are evaluated") {
  RandomSea random{std::mt19937_64(19)};
  const auto sea = std::make_shared<const SeaField>(random.waves(200, 40.0, shear()));
  FlowEvaluator evaluator(sea, {"line", 20}), row(sea, {"row", 20});
  const std::vector<FlowPoint> points(20, FlowPoint{Vec3d(1.0, 2.0, -3.0), Mat3d::Identity()});
  const long before = test::allocation_count();
  for (int i = 0; i < 10; ++i) {
    evaluator.line(0.1 * i, Vec3d(0.0, 0.0, -1.0), Vec3d(0.5, 0.0, -0.3));
    evaluator.cloud(0.1 * i, points);
    row.row(0.1 * i, {Vec3d(0.0, 0.0, -1.0), Mat3d::Identity(), Vec3d(0.1, 0.2, 0.3), 1.0},
            Vec3d(0.5, 0.0, -0.3));
  }
  CHECK(test::allocation_count() == before);
}

TEST_CASE("a load below the sea floor is told by name; one that sinks in a little is at the floor") {
  const auto sea = std::make_shared<const SeaField>(WaveComponents({0.7}, {1.0}, {0.0}, {0.0}, 20.0));
  FlowEvaluator evaluator(sea, {"part 'frame'", 2});
  CHECK_THROWS_WITH_AS(evaluator.line(0.0, Vec3d(0.0, 0.0, -10.0), Vec3d(0.0, 0.0, -11.0)),
                       doctest::Contains("part 'frame': is at z = -21 m, below the sea floor at z = -20 m"),
                       std::domain_error);
  const auto resting = evaluator.line(0.0, Vec3d(0.0, 0.0, -20.1), Vec3d(1.0, 0.0, 0.0));
  CHECK(resting[0].velocity.z() == 0.0);
}
