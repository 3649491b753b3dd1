#include <doctest/doctest.h>

#include "multibody_scenes.hpp"
#include "seacrane/run/simulation.hpp"

namespace seacrane::test {
namespace {

constexpr double kEnd = 30.0;

/// A body between springs whose tables have corners: a kink in the state every fraction of a second.
std::shared_ptr<const Model> bob_between_tables() {
  SceneDescription scene;
  scene.gravity = 0.0;
  scene.bodies = {body_at("bob", 1.0, {0.3, 0.1, 0.0})};
  for (const double side : {-2.0, 2.0}) {
    SpringDescription spring;
    spring.name = side < 0.0 ? "left" : "right";
    spring.first = kGround;
    spring.second = "bob";
    spring.first_point = {side, 0.3 * side, 0.1};
    spring.lengths = {0.5, 1.6, 2.1, 2.5, 5.0};
    spring.forces = {0.0, 4.0, 30.0, 36.0, 200.0};
    scene.loads.of<SpringDamper>().push_back(spring);
  }
  return compile(scene);
}

RunOptions asked_every_step() {
  RunOptions options;
  options.formulation = "recursive";
  options.scaled_tolerance = 1e-5;
  options.ask_every = std::chrono::milliseconds(0);
  return options;
}

std::vector<double> values_at_end(const std::shared_ptr<const Model>& model, const State& start) {
  Simulation run(model, start, asked_every_step());
  CHECK(run.advance(kEnd, [](double) { return true; }));
  return run.state().values;
}

}  // namespace

TEST_CASE("a run stopped between the start of a step taken again and its kink goes on bit for bit") {
  const auto model = bob_between_tables();
  const State start = initial_state(*model);
  std::vector<State> on_the_way;
  Simulation whole(model, start, asked_every_step());
  CHECK(whole.advance(kEnd, [&](double) {
    State now = whole.state();
    if (now.steps.kink) on_the_way.push_back(std::move(now));
    return true;
  }));
  const std::vector<double> end = whole.state().values;
  CHECK(end == values_at_end(model, start));
  REQUIRE(on_the_way.size() > 3);
  int elsewhere = 0;
  for (State& state : on_the_way) {
    CHECK(*state.steps.kink > state.time);
    CHECK(values_at_end(model, state) == end);
    state.steps.kink.reset();
    elsewhere += values_at_end(model, state) != end;
  }
  CHECK(elsewhere > 0);  // the kink is what they need
}

TEST_CASE("a run stopped after any step goes on bit for bit") {
  const auto model = bob_between_tables();
  const State start = initial_state(*model);
  const std::vector<double> end = values_at_end(model, start);
  Simulation whole(model, start, asked_every_step());
  for (int stops = 0; whole.time() < 3.0; ++stops) {
    whole.advance(kEnd, [](double) { return false; });
    if (stops % 5 == 0) CHECK(values_at_end(model, whole.state()) == end);
  }
}

}  // namespace seacrane::test
