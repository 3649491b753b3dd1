#include <doctest/doctest.h>

#include <cmath>

#include "count_allocations.hpp"
#include "multibody_scenes.hpp"
#include "seacrane/compile/compile.hpp"
#include "seacrane/elements/loads/point_force.hpp"
#include "seacrane/run/simulation.hpp"

namespace seacrane::test {
namespace {

const std::function<bool(double)> going = [](double) { return true; };

RunOptions options_for(const Model& model, const std::string& formulation, double t_end) {
  RunOptions options;
  options.formulation = formulation;
  options.scaled_tolerance = 1e-10;
  for (int i = 0; i <= 100; ++i) options.output_times.push_back(0.01 * t_end * i);
  for (const auto& name : channel_names(model, false)) options.channels.insert(name);
  return options;
}

double last(const Recording& recording, const std::string& channel) {
  for (const RecordedChannel& c : recording.channels()) {
    if (c.channel->name == channel)
      return recording.rows()[(recording.count() - 1) * recording.width() + c.offset];
  }
  return std::nan("");
}

/// A body below its hook; `speed` sideways.
SceneDescription hanging(double speed) {
  SceneDescription scene;
  scene.bodies.push_back(body_at("ball", 3.0, Vec3d(0, 0, -2)));
  scene.bodies.back().velocity = Vec3d(speed, 0, 0);
  scene.joints.push_back({"wire", "distance", kGround, "ball", {}, {}, {{"length", 2.0}}});
  LimitDescription wire;
  wire.name = wire.kind = wire.coordinate.joint = "wire";
  scene.limits.push_back(wire);
  return scene;
}

/// A driven slide that runs into another one at `speed`, on rails along x; their distance is limited.
SceneDescription shunt(double speed, double restitution) {
  SceneDescription scene;
  scene.gravity = 0.0;
  const Mat3d along = axes_along(Vec3d::UnitX(), Vec3d::UnitZ());
  scene.bodies = {body_at("ram", 7.0, Vec3d(0, 0, 0)), body_at("wagon", 3.0, Vec3d(1, 0, 0))};
  scene.bodies[0].velocity = Vec3d(speed, 0, 0);
  scene.joints.push_back(
      {"rail", "prismatic", kGround, "ram", {Vec3d::Zero(), along}, {Vec3d::Zero(), along}});
  scene.joints.push_back(
      {"track", "prismatic", kGround, "wagon", {Vec3d(1, 0, 0), along}, {Vec3d::Zero(), along}});
  scene.joints.push_back({"gap", "free", "ram", "wagon", {Vec3d::Zero(), along}, {Vec3d::Zero(), along}});
  scene.drivers.push_back(
      {"drive", {"rail", "displacement"}, Curve(std::vector<Curve::Piece>{{-1.0, {-speed, speed}}})});
  LimitDescription buffer;
  buffer.name = "buffer";
  buffer.kind = "stop";
  buffer.coordinate = {"gap", "z"};
  buffer.minimum = 0.25;
  buffer.restitution = restitution;
  scene.limits.push_back(buffer);
  return scene;
}

}  // namespace

TEST_CASE("a driven body does work in an impact, and the energy balance knows") {
  const double speed = 2.0, mass = 3.0;
  for (const double e : {0.0, 0.4, 1.0}) {
    CAPTURE(e);
    const auto model = compile(shunt(speed, e));
    Simulation run(model, initial_state(*model), options_for(*model, "redundant", 0.5));
    run.advance(0.5, going);
    REQUIRE(run.events().size() == 1);
    const Event& event = run.events().front();
    CHECK(event.time == doctest::Approx(0.375).epsilon(1e-12));
    CHECK(event.kind == (e > 0.0 ? EventKind::rebound : EventKind::contact));
    CHECK(event.impulse == doctest::Approx((1.0 + e) * mass * speed).epsilon(1e-10));
    // in the frame of the ram the wagon loses this; the drive does the impulse times its speed
    CHECK(event.energy_lost == doctest::Approx(0.5 * mass * speed * speed * (1.0 - e * e)).epsilon(1e-9));
    CHECK(std::abs(last(run.recording(), "energy_balance")) < 1e-9);
  }
}

TEST_CASE("the loop allocates nothing while no limit has an event, open or closed") {
  for (const std::string formulation : {"redundant", "recursive"}) {
    CAPTURE(formulation);
    SceneDescription scene = hanging(1.0);
    LimitDescription floor;
    scene.joints.push_back({"air", "free", kGround, "ball", {}, {}});
    floor.name = "floor";
    floor.kind = "stop";
    floor.coordinate = {"air", "z"};
    floor.minimum = -2.5;
    scene.limits.push_back(floor);
    const auto model = compile(scene);
    Simulation run(model, initial_state(*model), options_for(*model, formulation, 3.0));
    run.advance(0.1, going);
    const long before = allocation_count();
    run.advance(3.0, going);
    CHECK(allocation_count() == before);
    CHECK(run.events().empty());
    CHECK(run.recording().count() == 101);
  }
}

TEST_CASE("models of a set hold its rows only, and the elements of all") {
  const auto taut = compile(hanging(1.0));
  CHECK(taut->closed == 1);
  CHECK(taut->rows() == 1);
  const auto slack = compile_set(*taut, 0);
  CHECK(slack->rows() == 0);
  CHECK(slack->elements.size() == taut->elements.size());
  CHECK(slack->layout.size == taut->layout.size);
  CHECK(compile_set(*slack, 1)->rows() == 1);
  const auto open = compile(shunt(1.0, 0.0));
  CHECK(open->closed == 0);
  const auto closed = compile_set(*open, 1);
  CHECK(closed->rows() == open->rows() + 1);
  CHECK(closed->elements[static_cast<std::size_t>(closed->limits.front().element)].name == "buffer");
}

TEST_CASE("a set of limits that leaves no rows of redundant ones is stepped") {
  SceneDescription scene = hanging(0.0);
  scene.bodies.push_back(body_at("box", 3.0, Vec3d(0.5, 0, -2)));
  scene.joints.push_back({"weld", "weld", "box", "ball", {Vec3d(-0.5, 0, 0), Mat3d::Identity()}, {}});
  scene.joints.push_back({"rod", "distance", "box", "ball", {}, {}, {{"length", 0.5}}});
  scene.loads.of<PointForce>().push_back({"lift", "ball", Vec3d::Zero(), Vec3d(0, 0, 120)});
  const auto model = compile(scene);
  REQUIRE(model->redundant);
  for (const std::string formulation : {"redundant", "recursive"}) {
    CAPTURE(formulation);
    Simulation run(model, initial_state(*model), options_for(*model, formulation, 0.5));
    run.advance(0.5, going);
    REQUIRE(run.events().size() == 1);
    CHECK(run.events().front().kind == EventKind::release);
    CHECK(std::abs(last(run.recording(), "energy_balance")) < 1e-8);
  }
}

TEST_CASE("a state with limits that the scene does not have is refused") {
  const auto model = compile(hanging(1.0));
  State state = initial_state(*model);
  state.closed = std::vector<std::string>{"no such wire"};
  CHECK_THROWS_AS(Simulation(model, state, options_for(*model, "redundant", 1.0)), std::invalid_argument);
}

}  // namespace seacrane::test
