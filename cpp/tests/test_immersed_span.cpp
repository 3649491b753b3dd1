#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "multibody_scenes.hpp"
#include "seacrane/elements/loads/immersed_span.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane::test {
namespace {

/// A sea like JONSWAP's of 8 s: `count` waves between 0.3 and 2.4 rad/s.
WaveComponents waves(std::size_t count, double depth, const Current& current = {}) {
  std::vector<double> omega, amplitude, phase, direction;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = 0.3 + 2.1 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    omega.push_back(w);
    const double density = std::pow(w, -5.0) * std::exp(-1.25 * std::pow(0.785 / w, 4.0));
    amplitude.push_back(std::sqrt(density / static_cast<double>(count)));
    phase.push_back(2.0 * static_cast<double>(i * i));
    direction.push_back(0.4 + 0.01 * static_cast<double>(i));
  }
  return {omega, amplitude, phase, direction, depth, standard_gravity, current};
}

double largest(const Vec3d& v) { return v.cwiseAbs().maxCoeff(); }

}  // namespace

TEST_CASE("spans that meet at a point ask for its flow once") {
  Random random(5);
  SceneDescription scene = pair("revolute", random);
  ImmersedSpan::Description one = ImmersedSpan::example(), other = one;
  other.name = "other";
  other.second = "third";
  scene.loads.of<ImmersedSpan>() = {one, other};
  CHECK(compile(scene, false)->stencils.size() == 3);
  other.first_point.x() += 0.1;
  scene.loads.of<ImmersedSpan>() = {one, other};
  CHECK(compile(scene, false)->stencils.size() == 4);
}

TEST_CASE("far below, a point without its surface is the flow within twice its bound, and in the current") {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const Current profile({0.0, 300.0}, {0.8, 0.2}, {0.1, 0.4});
  for (const double depth : {1500.0, inf}) {
    for (const double cut : {1e-5, 1e-4, 1e-3}) {
      const auto sea = std::make_shared<const SeaField>(waves(120, depth, profile));
      const SeaView view(sea, {{"deep", 1, cut, false}});
      const double calm = sea->calm_below(cut);
      CHECK(calm <= -300.0 - sea->crest());
      CHECK(calm > -1300.0);
      const LocalFlow<double> size = sea->magnitude();
      for (int i = 0; i < 40; ++i) {
        const double t = 13.0 * i;
        const Vec3d place(3.0 * i, -5.0 * i, calm - 0.01 - 2.0 * i);
        const LocalFlow<double> found = view.at_point<double>(0, t, place), exact = sea->at<double>(t, place);
        CHECK(found.elevation == 0.0);
        CHECK(largest(found.velocity - exact.velocity) < 2.0 * cut * largest(size.velocity));
        CHECK(largest(found.acceleration - exact.acceleration) < 2.0 * cut * largest(size.acceleration));
        CHECK(std::fabs(found.pressure - exact.pressure) < 2.0 * cut * size.pressure);
      }
      const double still = std::min(calm, sea->still_below(cut));
      CHECK(still > -1500.0);
      const Vec3d below(4.0, 7.0, still - 0.01);
      const LocalFlow<double> waves = sea->at<double>(3.0, below);
      const auto current = profile.at<double>(below.z());
      const Vec3d carried(current.x, current.y, 0.0);
      CHECK(view.at_point<double>(0, 3.0, below).velocity == carried);
      CHECK(largest(waves.velocity - carried) < 0.01 * cut * largest(size.velocity));
      CHECK(largest(waves.acceleration) < 0.01 * cut * largest(size.acceleration));
      const Vec3d above(0.0, 0.0, calm + 0.01);
      CHECK(view.at_point<double>(0, 3.0, above).elevation ==
            doctest::Approx(sea->at<double>(3.0, above).elevation));
    }
  }
}

TEST_CASE("without stretching, a point under all troughs needs no surface") {
  const auto sea = std::make_shared<const SeaField>(waves(60, 200.0), Stretching::none);
  CHECK(sea->calm_below(1e-5) == -sea->crest());
}

}  // namespace seacrane::test
