#include <doctest/doctest.h>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/gear_gupta_leimkuhler.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane::test {
namespace {

/// The equations of a system without their exact Jacobian.
class ByDifferences final : public ResidualSystem {
 public:
  explicit ByDifferences(ResidualSystem& system) : system_(system) {}
  std::size_t size() const override { return system_.size(); }
  void residual(double t, const double* y, const double* ydot, double* r) override {
    system_.residual(t, y, ydot, r);
  }
  std::span<const double> differential() const override { return system_.differential(); }
  void expand(double t, const double* ode_state, double* y, double* ydot) override {
    system_.expand(t, ode_state, y, ydot);
  }
  void contract(double t, const double* y, double* ode_state) const override {
    system_.contract(t, y, ode_state);
  }
  bool jacobian(double, double, const double*, const double*, double*) override { return false; }

 private:
  ResidualSystem& system_;
};

class StepsByDifferences final : public System {
 public:
  explicit StepsByDifferences(System& system) : system_(system) {}
  std::size_t size() const override { return system_.size(); }
  void derivative(double t, const double* y, double* ydot) override { system_.derivative(t, y, ydot); }
  bool project(double t, double* y, bool evaluated_here) override {
    return system_.project(t, y, evaluated_here);
  }
  bool has_projection() const override { return system_.has_projection(); }
  bool jacobian(double, const double*, double*) override { return false; }

 private:
  System& system_;
};

struct Run {
  VecXd state;
  Counters counters;
};

Run run(const SceneDescription& scene, const std::string& name, bool exact) {
  MaximalSystem bodies(compile(scene));
  GearGuptaLeimkuhler residual(bodies);
  ByDifferences other(residual);
  IntegratorOptions options;
  options.name = name;
  if (name != "ida") options.fixed_step = 0.005;
  const auto integrator = make_integrator(
      {bodies, &bodies.positions(), exact ? static_cast<ResidualSystem*>(&residual) : &other}, options);
  integrator->init(0.0, moving_state(bodies, 9).data());
  while (integrator->time() < 0.5) integrator->step(0.5);
  return {Eigen::Map<const VecXd>(integrator->state(), bodies.model().layout.size), integrator->counters()};
}

Run run_recursive(const SceneDescription& scene, const std::string& name, bool exact) {
  const auto terms = std::make_shared<Terms>(compile(scene));
  MaximalSystem maximal(terms);
  RecursiveSystem system(terms);
  StepsByDifferences other(system);
  IntegratorOptions options;
  options.name = name;
  const auto integrator = make_integrator({exact ? static_cast<System&>(system) : other}, options);
  std::vector<double> y(system.size());
  system.read_bodies(0.0, moving_state(maximal, 9).data(), y.data());
  integrator->init(0.0, y.data());
  while (integrator->time() < 0.5) integrator->step(0.5);
  return {Eigen::Map<const VecXd>(integrator->state(), static_cast<Eigen::Index>(y.size())),
          integrator->counters()};
}

void compare(const Run& exact, const Run& other) {
  MESSAGE("evaluations ", exact.counters.evaluations, " for ", other.counters.evaluations, ", Jacobians ",
          exact.counters.jacobians, " for ", other.counters.jacobians, ", Newton ",
          exact.counters.newton_iterations, " for ", other.counters.newton_iterations, ", steps ",
          exact.counters.steps, " for ", other.counters.steps, ", apart ",
          (exact.state - other.state).cwiseAbs().maxCoeff());
  CHECK(exact.counters.jacobians > 0);
  // 0.09 to 0.76 of them, as often as Newton's matrix is made.
  CHECK(exact.counters.evaluations < 0.8 * static_cast<double>(other.counters.evaluations));
  CHECK(exact.counters.newton_iterations <= 1.02 * static_cast<double>(other.counters.newton_iterations));
  CHECK((exact.state - other.state).cwiseAbs().maxCoeff() < 3e-6);
}

}  // namespace

TEST_CASE("implicit methods take the exact Jacobian of the recursive form in place of differences") {
  for (const SceneDescription& scene : {slider_crank("hull"), at_sea(true), at_sea(true, 0.7)}) {
    for (const IntegratorProperties& method : integrators()) {
      if (!method.uses_jacobian || method.residual_form) continue;
      const std::string name = method.name;
      CAPTURE(name);
      compare(run_recursive(scene, name, true), run_recursive(scene, name, false));
    }
  }
}

TEST_CASE("methods on the residual form take its exact Jacobian in place of differences") {
  SceneDescription euler = slider_crank("hull");
  make_vessel(euler, "hull");
  euler.orientation = Orientation::euler_xyz;
  for (const SceneDescription& scene : {slider_crank(), at_sea(true, 0.7), euler}) {
    for (const IntegratorProperties& method : integrators()) {
      if (!method.residual_form) continue;
      const std::string name = method.name;
      CAPTURE(name);
      compare(run(scene, name, true), run(scene, name, false));
    }
  }
}

}  // namespace seacrane::test
