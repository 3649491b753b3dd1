#include <doctest/doctest.h>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/energy.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/dynamics/state_names.hpp"
#include "seacrane/elements/loads/line.hpp"

namespace seacrane::test {
namespace {

/// At random velocities and states.
std::vector<double> disturbed(MaximalSystem& system) {
  std::vector<double> y = moving_state(system, 31);
  Random random(32);
  const StateLayout& s = system.model().layout;
  for (int i = s.loads; i < s.work; ++i) y[idx(i)] += 0.1 * random.number();
  return y;
}

std::vector<double> moved_along(const std::vector<double>& y, const std::vector<double>& rate, double t) {
  std::vector<double> out = y;
  for (std::size_t i = 0; i < y.size(); ++i) out[i] += t * rate[i];
  return out;
}

SceneDescription hoisted() {
  Random random(33);
  SceneDescription scene = pair("revolute", random);
  scene.loads.of<Line>().push_back(Line::example());
  return scene;
}

}  // namespace

TEST_CASE("energy changes by the recorded power: every kind of load") {
  Random random(30);
  for (std::size_t kind = 0; kind < load_kinds().size(); ++kind) {
    CAPTURE(std::string(load_kinds()[kind]->name));
    SceneDescription scene = pair("revolute", random);
    scene.loads.lists[kind]->add_example();
    MaximalSystem system(compile(scene, false));
    const std::vector<double> y = disturbed(system);
    std::vector<double> rate(y.size());
    system.derivative(0.7, y.data(), rate.data());
    const double power = rate[idx(system.model().layout.work)];
    const double energy_rate = slope(
        [&](double t) {
          return mechanical_energy_at(system.terms(), 0.7 + t, moved_along(y, rate, t).data());
        },
        1e-4);
    CHECK(energy_rate == doctest::Approx(power).epsilon(1e-8));
    CHECK(rate[idx(system.model().layout.work + 1)] >= std::abs(power));
  }
}

TEST_CASE("states of loads stand behind the fluid's, with their names, starts and scales") {
  SceneDescription scene = hoisted();
  make_vessel(scene, "third");
  const auto model = compile(scene, false);
  const StateLayout& s = model->layout;
  CHECK(s.loads == s.memory + 2);
  CHECK(s.work == s.loads + 3);
  REQUIRE(model->load_states.size() == 3);
  CHECK(model->load_states[0].name == "load.length");
  CHECK(model->load_states[1].name == "load.rate");
  CHECK(model->load_states[2].name == "load.brake");
  CHECK(model->initial_state[idx(s.loads)] == 3.0);
  CHECK(model->initial_state[idx(s.loads + 1)] == 0.0);
  CHECK(model->scale[idx(s.loads)] == model->translation_scale);
  CHECK(describe_state(*model, s.loads + 1) == "state 'load.rate'");
  CHECK(describe_state(*model, s.memory + 1) == "memory state 1 of vessel 'third'");
}

TEST_CASE("both formulations give the states of loads the same rates") {
  const auto model = compile(hoisted(), false);
  MaximalSystem redundant(model);
  RecursiveSystem recursive(std::make_shared<Terms>(model));
  std::vector<double> y = disturbed(redundant);
  std::vector<double> rate(y.size()), z(recursive.size()), z_rate(z.size());
  redundant.derivative(0.7, y.data(), rate.data());
  recursive.read_bodies(0.7, y.data(), z.data());
  recursive.derivative(0.7, z.data(), z_rate.data());
  for (std::size_t i = 1; i <= 4; ++i) {
    CHECK(z_rate[z.size() - i] == doctest::Approx(rate[y.size() - i]).epsilon(1e-12));
  }
}

TEST_CASE("a load between bodies that move as one keeps its states going") {
  Random random(34);
  SceneDescription scene = pair("weld", random);
  Line::Description line = Line::example();
  line.bodies = {"first", "second", "first"};
  scene.loads.of<Line>().push_back(line);
  const auto model = compile(scene, true);
  REQUIRE(model->merged);
  CHECK(model->merged->body_count() < model->body_count());
  MaximalSystem merged(model->merged);
  std::vector<double> y = model->merged->initial_state, rate(y.size());
  const int length = model->merged->layout.loads;
  y[idx(length + 1)] = 0.1;
  merged.derivative(1.0, y.data(), rate.data());
  CHECK(rate[idx(length)] == 0.1);
}

}  // namespace seacrane::test
