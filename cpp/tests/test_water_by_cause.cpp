#include <doctest/doctest.h>

#include <numeric>

#include "multibody_scenes.hpp"
#include "random_sea.hpp"
#include "seacrane/elements/loads/immersed_part.hpp"
#include "seacrane/elements/loads/immersed_span.hpp"

namespace seacrane::test {
namespace {

/// A moving scene with one example in the water, and what the load does there.
template <class Load>
struct Watered {
  SceneDescription scene;
  std::shared_ptr<const Model> model;
  MaximalSystem system;
  std::vector<double> state, rate;
  LoadInput<double> input;
  const Load& load;
  std::vector<BodyLoad<double>> wrenches;
  std::vector<double> load_rates;
  LoadSum<double> sum;

  Watered(std::uint64_t seed, bool waves)
      : scene(described(seed, waves)),
        model(compile(scene, false)),
        system(model),
        state(moving_state(system, seed)),
        rate(evaluated()),
        input(system.terms().load_input(0.7, state.data() + model->layout.memory)),
        load(model->loads.of<Load>().front()),
        wrenches(model->bodies.size() + 1),
        load_rates(8),
        sum{wrenches.data(), load_rates.data()} {
    load.template apply<double>(input, sum);
  }

  static SceneDescription described(std::uint64_t seed, bool waves) {
    Random random(seed);
    SceneDescription out = pair("revolute", random);
    out.loads.of<Load>().push_back(Load::example());
    if (waves) {
      RandomSea sea{std::mt19937_64(seed)};
      out.sea = std::make_shared<const SeaField>(sea.waves(12, 60.0, shear()));
    }
    return out;
  }
  std::vector<double> evaluated() {
    std::vector<double> out(state.size());
    system.derivative(0.7, state.data(), out.data());
    return out;
  }
};

double total(const WaterByCause& water) {
  return std::accumulate(water.powers.begin(), water.powers.end(), 0.0);
}

}  // namespace

TEST_CASE("what the water does to a part by cause is all that it does") {
  for (std::uint64_t seed = 40; seed < 46; ++seed) {
    Watered<ImmersedPart> in(seed, seed % 2 == 0);
    const auto body = idx(in.load.body);
    const Vec6d acceleration = in.system.accelerations()[body];
    WaterByCause found = in.load.by_cause(in.input, acceleration);
    Mat6d mass = Mat6d::Zero();
    std::vector<Mat6d> masses(in.wrenches.size(), mass);
    in.load.add_inertia<double>(in.input, masses.data());
    const Vec3d expected = in.wrenches[body].force - (masses[body] * acceleration).head<3>();
    Vec3d all = Vec3d::Zero();
    for (const Vec3d& force : found.forces) all += force;
    CHECK(masses[body].norm() > 0.0);
    CHECK((all - expected).norm() < 1e-12 * (1.0 + expected.norm()));
    CHECK(total(found) == doctest::Approx(in.sum.power).epsilon(1e-12));
    CHECK(found.power(WaterCause::slam) == -in.load_rates[0]);
    CHECK((std::abs(found.power(WaterCause::waves)) > 1e-3) == (seed % 2 == 0));
    CHECK((found.force(WaterCause::waves).norm() > 1e-3) == (seed % 2 == 0));
  }
}

TEST_CASE("what the water does to a span by cause is all that it does") {
  for (std::uint64_t seed = 50; seed < 56; ++seed) {
    Watered<ImmersedSpan> in(seed, seed % 2 == 0);
    WaterByCause found = in.load.by_cause(in.input);
    CHECK(total(found) == doctest::Approx(in.sum.power).epsilon(1e-12));
    CHECK(std::abs(in.sum.power) > 0.0);
    CHECK((std::abs(found.power(WaterCause::waves)) > 1e-6) == (seed % 2 == 0));
    CHECK(found.power(WaterCause::slam) <= 0.0);
  }
}

}  // namespace seacrane::test
