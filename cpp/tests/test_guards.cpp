#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "multibody_scenes.hpp"
#include "seacrane/compile/compile.hpp"
#include "seacrane/dynamics/non_finite.hpp"
#include "seacrane/elements/loads/function_force.hpp"
#include "seacrane/run/simulation.hpp"

namespace seacrane::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// An integrator whose step ends in a NaN.
class Broken final : public Integrator {
 public:
  static constexpr IntegratorProperties properties{
      .name = "broken", .kind = "", .order = 1, .dense_order = 1, .default_step = 1.0, .purpose = ""};
  explicit Broken(std::size_t size) : Integrator(properties, size) {}
  void init(double t0, const double* y0) override { set_state(t0, y0); }
  void step(double t_limit) override {
    time_ = t_limit;
    state_[8] = kNan;
  }
  void interpolate(double, double*) const override {}
  void reset(double t, const double* y) override { set_state(t, y); }
  Counters counters() const override { return {}; }
  double step_in_use() const override { return 1.0; }
  std::vector<double> save() const override { return {}; }
  void load(std::span<const double>) override {}
};

void give_nan(double t, const double*, const double* parameters, double* wrench) {
  wrench[4] = t > parameters[0] ? kNan : 0.0;
}

/// Dry friction with no scale of velocity: it switches where the body stops.
void switch_sign(double, const double* state, const double*, double* wrench) {
  wrench[0] = state[7] > 0.0 ? -1e4 : 1e4;
}

SceneDescription pushed(ForceFunction function) {
  SceneDescription scene;
  scene.bodies.push_back(body_at("box", 1.0, Vec3d::Zero()));
  scene.bodies.back().velocity = Vec3d(1.0, 0.0, 0.0);
  scene.loads.of<FunctionForce>().push_back({"push", "box", function, {0.25}});
  return scene;
}

std::string message_of(const SceneDescription& scene, RunOptions options, double t_end) {
  const auto model = compile(scene);
  Simulation run(model, initial_state(*model), std::move(options));
  try {
    run.advance(t_end, {});
  } catch (const IntegrationError& error) {
    return error.what();
  } catch (const std::domain_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("what is not finite is named: a state, a memory state, a load, a driver") {
  SceneDescription scene = slider_crank("base");
  make_vessel(scene, "base");
  const auto model = compile(scene);
  MaximalSystem system(model);
  std::vector<double> y = model->initial_state;
  CHECK(name_non_finite(system, 0.0, y.data()) == "");

  const StateLayout& s = model->layout;
  const auto with = [&](int component, double value) {
    std::vector<double> changed = y;
    changed[idx(component)] = value;
    return name_non_finite(system, 0.0, changed.data());
  };
  CHECK(with(s.twist(1) + 4, kNan) == "angular velocity y of body 'crank': it is nan");
  CHECK(with(s.pose(3) + 2, INFINITY) == "position z of body 'slider': it is inf");
  CHECK(with(s.memory + 1, kNan) == "memory state 1 of vessel 'base': it is nan");
  CHECK(holds(with(s.memory, 1e308), "hydrodynamics: force ("));

  std::vector<double> slots(idx(model->slot_count), 0.0);
  slots[0] = kNan;
  system.terms().set_inputs(slots);
  CHECK(holds(name_non_finite(system, 0.0, y.data()), "actuator 'drive': force"));
}

TEST_CASE("every integrator stops at a force that is not finite, and names it, its body and the time") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    RunOptions options;
    options.integrator = name;
    options.fixed_step = 0.0625;
    const std::string text = message_of(pushed(give_nan), options, 1.0);
    CHECK(holds(text, name + " stopped at t = 0."));
    CHECK(holds(text, "function force 'push'"));
    CHECK(holds(text, "on body 'box'"));
    CHECK(holds(text, "at t = 0."));
  }
}

TEST_CASE("a state that a step leaves not finite is caught at once") {
  const auto model = compile(pushed(switch_sign));
  Stepper at(model, RunOptions{});
  at.integrator = std::make_unique<Broken>(at.stepped.size());
  Integrator& integrator = *at.integrator;
  integrator.init(0.0, model->initial_state.data());
  require_finite(integrator, at.stepped);
  integrator.step(0.5);
  try {
    require_finite(integrator, at.stepped);
    FAIL("passed");
  } catch (const IntegrationError& error) {
    CHECK(error.component() == 8);
    CHECK(error.step_size() == 0.5);
    try {
      explain(error, at);
    } catch (const IntegrationError& told) {
      CHECK(holds(told.what(), "velocity y of body 'box': it is nan"));
    }
  }
}

TEST_CASE("a force that switches where the body stops ends in an error, not in a run without end") {
  const std::string text = message_of(pushed(switch_sign), RunOptions{}, 1.0);
  CHECK(holds(text, "stands still"));
  CHECK(holds(text, "100000 steps"));
  // A fixed step continues: it was asked for.
  RunOptions fixed;
  fixed.integrator = "rk4";
  fixed.fixed_step = 1e-3;
  CHECK(message_of(pushed(switch_sign), fixed, 0.1) == "");
}

TEST_CASE("steps are counted afresh after a stretch that advanced") {
  StallWatch watch;
  for (long i = 1; i <= 100'000; ++i) watch.step(1e-5 * static_cast<double>(i));
  CHECK_NOTHROW([&] {
    for (long i = 1; i < 100'000; ++i) watch.step(1.0);
  }());
  CHECK_THROWS_AS(watch.step(1.0), std::domain_error);
}

TEST_CASE("the nearest approach of constraints to dependence is kept and named") {
  // Two equal arms: a crank about y, and a link from its tip to a slider along x, which fold at 90 deg.
  const auto folded = [](double angle) {
    SceneDescription scene;
    const Vec3d tip(std::cos(angle), 0.0, std::sin(angle)), end(2.0 * std::cos(angle), 0.0, 0.0);
    scene.bodies.push_back(body_at("crank", 1.0, Vec3d::Zero()));
    scene.bodies.push_back(body_at("slider", 1.0, end));
    join(scene, "revolute", "pin", kGround, "crank", Vec3d::Zero(),
         axes_along(Vec3d::UnitY(), Vec3d::UnitX()));
    join(scene, "prismatic", "guide", kGround, "slider", end, axes_along(Vec3d::UnitX(), Vec3d::UnitY()));
    JointDescription& link = join(scene, "distance", "link", "crank", "slider", tip);
    link.second_frame = frame_on(scene, "slider", end, Mat3d::Identity());
    link.parameters["length"] = 1.0;
    scene.drivers.push_back({"turn", {"pin", "angle"}, Curve::constant(0.0)});
    return compile(scene);
  };
  std::vector<double> found;
  for (const double gap : {1e-2, 1e-3, 1e-4}) {
    const auto model = folded(0.5 * M_PI - gap);
    MaximalSystem system(model);
    RankWatch watch;
    CHECK_FALSE(watch.report().has_value());
    const double condition = system.rank(0.0, model->initial_state.data()).condition;
    REQUIRE(watch.sees({condition}));
    watch.keep(3.0, {condition}, model, model->initial_state.data());
    CHECK_FALSE(watch.sees({1.05 * condition}));
    CHECK(watch.sees({1.0, 0, 0, 1}));  // a combination of rows was left out within a step
    const RankReport report = watch.report().value();
    CHECK(report.time == 3.0);
    CHECK(report.pivot == doctest::Approx(1.0 / condition));
    CHECK(report.element == "link");
    CHECK_FALSE(report.rank_changed);
    found.push_back(report.singular_value);
  }
  // What is left of the link's row with crank and guide held is the cosine of its angle to the slide.
  CHECK(found[0] / found[1] == doctest::Approx(10.0).epsilon(0.005));
  CHECK(found[1] / found[2] == doctest::Approx(10.0).epsilon(0.0005));
}

TEST_CASE("a run whose energy does not close is stopped by its limit only") {
  RunOptions options;
  options.integrator = "semi-implicit-euler";  // of first order: it gains or loses energy here
  options.fixed_step = 0.02;
  for (int i = 0; i <= 100; ++i) options.output_times.push_back(0.1 * i);
  SceneDescription scene;
  scene.bodies.push_back(body_at("rod", 1.0, Vec3d(1.0, 0.0, 0.0)));
  join(scene, "revolute", "pin", kGround, "rod", Vec3d::Zero(), axes_along(Vec3d::UnitY(), Vec3d::UnitX()));
  CHECK(message_of(scene, options, 10.0) == "");
  options.energy_limit = 1e-4;
  CHECK(holds(message_of(scene, options, 10.0), "energy_balance is "));
  options.integrator = "dopri5";
  CHECK(message_of(scene, options, 10.0) == "");
  options.energy_limit = kNan;
  CHECK_THROWS_AS(message_of(scene, options, 10.0), std::invalid_argument);
}

}  // namespace seacrane::test
