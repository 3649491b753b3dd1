#include <doctest/doctest.h>

#include "test_integrate_problems.hpp"

namespace seacrane::test {
namespace {

constexpr double start[4] = {1.0, 0.0, 0.0, 0.0};

struct Outcome {
  double error;  // after 15 whole periods, against the start
  double drift;  // worst constraint residual of state() after any step
  Counters counters;
};

Outcome swing(const IntegratorOptions& options, bool projects) {
  Pendulum system(projects);
  PendulumResidual residual;
  const auto integrator = make_integrator(problem(system, &residual), options);
  integrator->init(0.0, start);
  double drift = 0.0;
  while (integrator->time() < 30.0) {
    integrator->step(30.0);
    drift = std::max(drift, Pendulum::drift(integrator->state()));
  }
  CHECK(system.false_claims == 0);
  const Outcome outcome = {largest_error(integrator->state(), {start, start + 4}), drift,
                           integrator->counters()};
  MESSAGE(options.name, std::string(projects ? " projected" : " free"), ": error ", outcome.error, ", drift ",
          outcome.drift, ", steps ", outcome.counters.steps, ", evaluations ", outcome.counters.evaluations);
  return outcome;
}

}  // namespace

TEST_CASE("projection keeps the pendulum on its circle and its period right") {
  for (const IntegratorProperties& method :
       methods([](const auto& m) { return m.is_adaptive() && !m.residual_form && m.order <= 5; })) {
    const std::string name = method.name;
    CAPTURE(name);
    const Outcome with = swing(with_tolerance(name, 1e-6), true);
    const Outcome without = swing(with_tolerance(name, 1e-6), false);
    CHECK(with.drift < 1e-14);
    CHECK(without.drift > 1e-7);
    CHECK(with.error < 2.0 * without.error);
    CHECK(with.error < 0.02);
    // Of other pairs the error of the formula is as large as that of the drift.
    if (name == "dopri5" || name == "tsit5") CHECK(with.error < 0.2 * without.error);
    CHECK(with.counters.projections >= with.counters.steps);
    CHECK(without.counters.projections == 0);
  }
}

TEST_CASE("projection keeps the order of every one-step method") {
  // At a time where nothing is special; over whole periods some errors cancel.
  const auto solution = [](const IntegratorOptions& options) {
    Pendulum system(true);
    PendulumResidual residual;
    const auto integrator = make_integrator(problem(system, &residual), options);
    integrator->init(0.0, start);
    run_to(*integrator, 1.7);
    return std::vector<double>(integrator->state(), integrator->state() + 4);
  };
  const std::vector<double> exact = solution(with_tolerance("dop853", 1e-13));
  constexpr double steps[] = {0.001, 0.005, 0.005, 0.01, 0.02, 0.04, 0.08, 0.08};  // by order
  for (const IntegratorProperties& method : methods(is_own)) {
    const std::string name = method.name;
    CAPTURE(name);
    const double order = method.order, step = steps[method.order - 1];
    const auto error = [&](double h) {
      IntegratorOptions options = with_step(name, h);
      if (method.uses_jacobian && !method.is_adaptive()) {
        options.relative_tolerance = 0.0;
        options.absolute_tolerance = {1e-9};
      }
      return largest_error(solution(options).data(), exact);
    };
    const double observed = std::log2(error(step) / error(0.5 * step));
    MESSAGE(name, " observed order ", observed, ", error ", error(0.5 * step));
    CHECK(observed > order - 0.4);
    CHECK(observed < order + 1.6);
  }
}

TEST_CASE("projection of the rk4 solution keeps order 4") {
  const double coarse = swing(with_step("rk4", 0.02), true).error;
  const double fine = swing(with_step("rk4", 0.01), true).error;
  CHECK(std::log2(coarse / fine) > 3.7);
  CHECK(swing(with_step("rk4", 0.01), true).drift < 1e-14);
}

TEST_CASE("projection of the dopri5 solution keeps order 5") {
  const double coarse = swing(with_step("dopri5", 0.04), true).error;
  const double fine = swing(with_step("dopri5", 0.02), true).error;
  CHECK(std::log2(coarse / fine) > 4.6);
}

TEST_CASE("a kept derivative costs one evaluation a step less, and a large correction evaluates again") {
  // Tolerances of 0.5 and 1e6 let every correction pass as small; tight ones none of a coarse step.
  const Counters kept = swing(with_step("rk4", 0.02), true).counters;
  CHECK(kept.evaluations == 4 * kept.steps + 1);
  IntegratorOptions strict = with_tolerance("rk4", 1e-13);
  strict.fixed_step = 0.02;
  const Counters refreshed = swing(strict, true).counters;
  CHECK(refreshed.evaluations > 4.9 * refreshed.steps);
}

TEST_CASE("IDA solves the stabilised index-2 pendulum, projected for output or not") {
  for (const bool projects : {false, true}) {
    const Outcome loose = swing(with_tolerance("ida", 1e-6), projects);
    const Outcome tight = swing(with_tolerance("ida", 1e-9), projects);
    CHECK(tight.error < 1e-4);
    CHECK(tight.error < 0.05 * loose.error);
    CHECK(tight.drift < (projects ? 1e-14 : 1e-7));
    CHECK(tight.counters.jacobians > 0);
    CHECK(tight.counters.newton_iterations >= tight.counters.steps);
  }
}

TEST_CASE("an algebraic component leaves the error norm of IDA whatever its size") {
  Pendulum system(true);
  PendulumResidual residual;
  IntegratorOptions options = with_tolerance("ida", 1e-6);
  options.absolute_tolerance = {1e-6, 1e-6, 1e-6, 1e-6};
  const auto integrator = make_integrator(problem(system, &residual), options);
  integrator->init(0.0, start);
  run_to(*integrator, 2.0);
  CHECK(largest_error(integrator->state(), {start, start + 4}) < 1e-2);
  options.absolute_tolerance = {1e-6, 1e-6, 1e-6};
  CHECK_THROWS_AS(make_integrator(problem(system, &residual), options), std::invalid_argument);
}

TEST_CASE("dense output starts at the projected state of the step before") {
  for (const IntegratorProperties& method :
       methods([](const auto& m) { return has_one_order(m) && !m.residual_form && m.order > 1; })) {
    const std::string name = method.name;
    CAPTURE(name);
    Pendulum system(true);
    const auto integrator = make_integrator(problem(system), with_tolerance(name, 1e-5));
    integrator->init(0.0, start);
    double y[4];
    for (int i = 0; i < 20; ++i) {
      integrator->step(10.0);
      integrator->interpolate(integrator->previous_time(), y);
      CHECK(largest_error(y, {integrator->previous_state(), integrator->previous_state() + 4}) < 1e-14);
      integrator->interpolate(integrator->time(), y);
      CHECK(largest_error(y, {integrator->state(), integrator->state() + 4}) < 1e-4);
    }
  }
}

}  // namespace seacrane::test
