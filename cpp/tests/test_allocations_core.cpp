#include <doctest/doctest.h>

#include "count_allocations.hpp"
#include "multibody_scenes.hpp"
#include "seacrane/compile/compile.hpp"
#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/energy.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/elements/loads/line.hpp"
#include "seacrane/run/simulation.hpp"

namespace seacrane::test {
namespace {

std::vector<SceneDescription> scenes() {
  SceneDescription floating = slider_crank("hull");
  make_vessel(floating, "hull");
  SceneDescription light = slider_crank();  // evaluated by dense LU
  for (auto& b : light.bodies) {
    if (b.name != "rod") continue;
    b.mass *= 1e-8;
    b.inertia *= 1e-8;
  }
  SceneDescription euler = slider_crank();
  euler.orientation = Orientation::euler_xyz;
  SceneDescription hoisted = slider_crank();
  Line::Description line = Line::example();
  line.bodies = {kGround, hoisted.bodies[0].name, hoisted.bodies[1].name};
  line.brake_capacity = 1e3;  // holds: a bound that is reached is an event, which allocates
  hoisted.loads.of<Line>().push_back(line);
  return {slider_crank(),    floating,      light,       euler,  at_sea(true),
          at_sea(true, 0.7), at_sea(false), two_hulls(), hoisted};
}

/// Also loops whose rows depend on each other: few, which an eigendecomposition solves, and so many that rows
/// are left out.
std::vector<SceneDescription> scenes_with_loops() {
  std::vector<SceneDescription> out = scenes();
  out.push_back(parallelogram(3));
  out.push_back(parallelogram(4));
  return out;
}

}  // namespace

TEST_CASE("evaluations and projections of the recursive form allocate nothing") {
  for (const SceneDescription& scene : scenes_with_loops()) {
    const auto terms = std::make_shared<Terms>(compile(scene));
    RecursiveSystem system(terms);
    CHECK(system.tree().loop_rows > 0);
    std::vector<double> bodies = terms->model().initial_state, y(system.size()), rate(y.size());
    system.read_bodies(0.0, bodies.data(), y.data());
    system.derivative(0.0, y.data(), rate.data());
    system.project(0.0, y.data(), true);
    const long before = allocation_count();
    long projected = 0;
    for (int i = 0; i < 200; ++i) {
      const double t = 0.01 * i;
      system.derivative(t, y.data(), rate.data());
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += 0.01 * rate[k];
      projected += system.project(t + 0.01, y.data(), false) ? 1 : 0;
      system.positions().move(0.0, y.data());
      system.write_bodies(t, y.data(), bodies.data());
      system.read_bodies(t, bodies.data(), y.data());
    }
    CHECK(allocation_count() == before);
    CHECK(projected > 0);
  }
}

TEST_CASE("evaluations and projections allocate nothing") {
  for (const SceneDescription& scene : scenes()) {
    MaximalSystem system(compile(scene));
    std::vector<double> y = system.model().initial_state, rate(y.size());
    system.derivative(0.0, y.data(), rate.data());
    system.project(0.0, y.data(), true);
    const long before = allocation_count();
    for (int i = 0; i < 200; ++i) {
      const double t = 0.01 * i;
      system.derivative(t, y.data(), rate.data());
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += 0.01 * rate[k];
      system.project(t + 0.01, y.data(), false);
      constraint_residual(system.terms(), t, y.data());
      mechanical_energy_at(system.terms(), t, y.data());
    }
    CHECK(allocation_count() == before);
  }
}

TEST_CASE("the run loop allocates nothing after its start: steps, outputs and the end of a curve") {
  for (const SceneDescription& scene : scenes()) {
    for (const std::string integrator :
         {"dopri5", "rk4", "dop853", "semi-implicit-euler", "rosenbrock", "generalized-alpha",
          "recursive dopri5", "recursive rk4", "recursive semi-implicit-euler", "recursive rosenbrock",
          "dopri5-stiff", "recursive dopri5-stiff"}) {
      CAPTURE(integrator);
      const auto model = compile(scene);
      RunOptions options;
      const std::size_t space = integrator.find(' ');
      options.formulation = space == std::string::npos ? "redundant" : integrator.substr(0, space);
      options.integrator = space == std::string::npos ? integrator : integrator.substr(space + 1);
      options.fixed_step = 0.01;
      for (int i = 0; i <= 300; ++i) options.output_times.push_back(0.01 * i);
      for (const auto& name : channel_names(*model, false)) {
        options.channels.insert(name);
        options.extremes.insert(name);
      }
      Simulation run(model, initial_state(*model), options);
      const std::function<bool(double)> keep_going = [](double) { return true; };
      run.advance(0.05, keep_going);
      const long before = allocation_count();
      run.advance(3.0, keep_going);
      CHECK(allocation_count() == before);
      CHECK(run.recording().count() == 301);
      CHECK((run.statistics().dense_solves > 0) == (model->bodies[1].mass < 1e-6));
    }
  }
}

}  // namespace seacrane::test
