#include <doctest/doctest.h>

#include <memory>

#include "multibody_scenes.hpp"
#include "random_sea.hpp"
#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/loads/immersed_part.hpp"

namespace seacrane::test {
namespace {

ImmersedPartDescription example(const std::string& shape) {
  ImmersedPartDescription d = ImmersedPart::example();
  d.shape = shape;
  if (shape == "cylinder" || shape == "disc") d.size = {7.0, 8.0, 8.0};
  if (shape == "sphere") d.size = {8.0, 8.0, 8.0};
  if (shape == "table") d.volumes = {0.0, 90.0, 200.0, 420.0, 480.0, 500.0};
  return d;
}

/// A row of strips whose first points differ by rounding, and a part by itself before it and after it. They
/// lie higher and higher by `rise` each.
SceneDescription with_rows(const std::string& shape = "box", double height = 0.4, double rise = -0.01) {
  Random random(31);
  SceneDescription scene = pair("revolute", random);
  ImmersedPartDescription alone = example(shape);
  alone.name = "alone";
  auto& parts = scene.loads.of<ImmersedPart>();
  parts.push_back(alone);
  for (int i = 0; i < 7; ++i) {
    ImmersedPartDescription strip = example(shape);
    strip.name = "strip " + std::to_string(i);
    strip.row = "row";
    strip.place = i;
    strip.count = 7.0;
    strip.step = Vec3d(11.7 / 7.0, 0.31 / 7.0, rise);
    strip.point = Vec3d(0.3, -0.2, height) + (i - 3.0) * strip.step;
    parts.push_back(strip);
  }
  alone.name = "other";
  parts.push_back(alone);
  return scene;
}

void check_alike(const Vec6d& one, const Vec6d& other) {
  CHECK((one - other).norm() <= 1e-9 * (1.0 + other.norm()));
}

}  // namespace

TEST_CASE("strips of a row agree on its first point to the last bit, and share; parts by themselves do not") {
  const auto model = compile(with_rows(), false);
  const auto& parts = model->loads.of<ImmersedPart>();
  REQUIRE(parts.size() == 9);
  for (std::size_t i = 2; i < 8; ++i) {
    CHECK(parts[i].first_point == parts[1].first_point);
    CHECK(parts[i].shares(parts[1]));
  }
  CHECK_FALSE(parts[1].shares(parts[0]));
  CHECK_FALSE(parts[8].shares(parts[0]));
  CHECK_FALSE(parts[8].shares(parts[7]));
}

/// All of a list at once and one by one; the powers of all.
double check_sharing(SceneDescription scene, bool waves) {
  RandomSea random{std::mt19937_64(32)};
  if (waves) scene.sea = std::make_shared<const SeaField>(random.waves(40, 60.0, shear()));
  Terms terms(compile(scene, false));
  const Model& model = terms.model();
  std::vector<double> y = model.initial_state;
  for (int b = 0; b < model.body_count(); ++b) {
    view<6>(&y[idx(model.layout.twist(b))]) << 0.6, -0.4, 0.8, 0.05, -0.03, 0.02;
  }
  terms.read(0.4, y.data());
  const LoadInput<double> in = terms.load_input(0.4, y.data() + model.layout.memory);
  const std::size_t bodies = idx(model.body_count()) + 1, states = model.load_states.size();
  std::vector<BodyLoad<double>> wrench(bodies), sum(bodies);
  std::vector<Mat6d> mass(bodies, Mat6d::Zero()), mass_sum = mass;
  std::vector<double> rates(states), rate_sum(states);
  LoadSum<double> at_once{wrench.data(), rates.data()}, one_by_one{sum.data(), rate_sum.data()};
  for (const auto& list : model.loads.lists) {
    list->apply(in, at_once);
    list->add_inertia(in, mass.data());
  }
  for (const ImmersedPart& part : model.loads.of<ImmersedPart>()) {
    part.apply(in, one_by_one);
    part.add_inertia(in, mass_sum.data());
  }
  CHECK(at_once.power == doctest::Approx(one_by_one.power).epsilon(1e-9));
  CHECK(at_once.absolute_power == doctest::Approx(one_by_one.absolute_power).epsilon(1e-9));
  for (std::size_t b = 0; b < bodies; ++b) {
    check_alike((Vec6d() << wrench[b].force, wrench[b].moment).finished(),
                (Vec6d() << sum[b].force, sum[b].moment).finished());
    CHECK((mass[b] - mass_sum[b]).norm() <= 1e-9 * (1.0 + mass_sum[b].norm()));
  }
  for (std::size_t i = 0; i < states; ++i) CHECK(rates[i] == doctest::Approx(rate_sum[i]).epsilon(1e-9));
  return at_once.absolute_power;
}

TEST_CASE("what loads share changes nothing: dry, in the surface and sunk, side by side") {
  for (const std::string shape : {"box", "cylinder", "disc", "sphere", "table"}) {
    CAPTURE(shape);
    double power = 0.0;
    for (double height = -20.0; height <= 20.0; height += 2.5) {
      CAPTURE(height);
      for (const bool waves : {false, true}) {
        power += check_sharing(with_rows(shape, height, 2.9), waves);
        power += check_sharing(with_rows(shape, height), waves);
      }
    }
    CHECK(power > 1.0);
  }
}

}  // namespace seacrane::test
