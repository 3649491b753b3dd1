#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "test_integrate_problems.hpp"

namespace seacrane::test {
namespace {

std::unique_ptr<Integrator> started(const IntegratorOptions& options, FunctionSystem& system,
                                    ResidualSystem& residual) {
  auto integrator = make_integrator(problem(system, &residual), options);
  integrator->init(0.0, smooth_solution(0.0).data());
  return integrator;
}

bool same_bits(const double* a, const double* b, std::size_t size) {
  return std::memcmp(a, b, size * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("hard stops are landed on exactly by every method") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    FunctionSystem system = smooth_system();
    SmoothResidual residual;
    const auto integrator = started(with_tolerance(name, 1e-7), system, residual);
    for (const double stop : {0.1, 0.1 + 1e-15, 0.3, 1.0 / 3.0, 1.0, 1.0 + 1e-9, 2.7, 4.0}) {
      for (int i = 0; integrator->time() < stop; ++i) {
        REQUIRE(i < 10000);
        integrator->step(stop);
        REQUIRE(integrator->time() <= stop);
        REQUIRE(integrator->previous_time() < integrator->time());
      }
      CHECK(integrator->time() == stop);
      CHECK(largest_error(integrator->state(), smooth_solution(stop)) < allowance(method));
      std::vector<double> y(3);
      integrator->interpolate(stop, y.data());
      CHECK(largest_error(y.data(), smooth_solution(stop)) < allowance(method));
    }
    const long steps = integrator->counters().steps;
    integrator->step(4.0);
    CHECK(integrator->counters().steps == steps);
  }
}

TEST_CASE("a hard stop does not spoil the step size of the own methods") {
  FunctionSystem system = smooth_system();
  SmoothResidual residual;
  IntegratorOptions options = with_tolerance("dopri5", 1e-6);
  const auto free = started(options, system, residual);
  run_to(*free, 20.0);
  const auto stopped = started(options, system, residual);
  for (int i = 1; i <= 20; ++i) {
    run_to(*stopped, i - 1e-7);
    run_to(*stopped, i);
  }
  // Each of the 40 stops may cost a step or two of its own, not a climb back from 1e-7 s.
  CHECK(stopped->counters().steps < free->counters().steps + 80);
  CHECK(stopped->counters().rejected_steps <= free->counters().rejected_steps + 20);
}

TEST_CASE("limited_step leaves no sliver and stretches nothing") {
  CHECK(limited_step(0.1, 1.0) == 0.1);
  CHECK(limited_step(0.1, 0.1) == 0.1);
  CHECK(limited_step(0.1, 0.04) == 0.04);
  CHECK(limited_step(0.1, 0.105) == 0.0525);
  CHECK(limited_step(0.1, 0.1 + 1e-12) == 0.1 + 1e-12);
}

TEST_CASE("rk4 takes the steps it is told, and its default otherwise") {
  FunctionSystem system = smooth_system();
  SmoothResidual residual;
  IntegratorOptions options = with_tolerance("rk4", 1e-6);
  options.fixed_step = 0.1;
  const auto integrator = started(options, system, residual);
  run_to(*integrator, 10.0);
  CHECK(integrator->counters().steps == 100);
  CHECK_FALSE(integrator->is_adaptive());
  options.fixed_step = 0.0;
  const auto standard = started(options, system, residual);
  run_to(*standard, 1.0);
  CHECK(standard->counters().steps == 50);
}

TEST_CASE("no adaptive method steps beyond max_step") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    FunctionSystem system = smooth_system();
    SmoothResidual residual;
    IntegratorOptions options = with_tolerance(name, 1e-3);
    options.max_step = 0.01;
    const auto integrator = started(options, system, residual);
    while (integrator->time() < 0.5) {
      integrator->step(0.5);
      CHECK(integrator->time() - integrator->previous_time() < 0.01 * (1.0 + 1e-9));
    }
  }
}

TEST_CASE("reset goes on from another state, with nothing left of the old") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    FunctionSystem system = smooth_system();
    SmoothResidual residual;
    const auto integrator = started(with_tolerance(name, 1e-8), system, residual);
    run_to(*integrator, 1.0);
    const Counters before = integrator->counters();
    const std::vector<double> other = smooth_solution(0.3);
    integrator->reset(0.3, other.data());
    CHECK(integrator->time() == 0.3);
    CHECK(integrator->previous_time() == 0.3);
    CHECK(same_bits(integrator->state(), other.data(), 3));
    run_to(*integrator, 2.0);
    CHECK(largest_error(integrator->state(), smooth_solution(2.0)) <
          std::max(1e-5, allowance(method) > 1e-4 ? allowance(method) : 0.0));
    CHECK(integrator->counters().restarts == before.restarts + 1);
    CHECK(integrator->counters().steps > before.steps);
    CHECK(integrator->counters().evaluations > before.evaluations);
  }
}

TEST_CASE("the own methods continue bit for bit from what they saved") {
  for (const IntegratorProperties& method : methods(is_own)) {
    const std::string name = method.name;
    for (const bool projects : {false, true}) {
      CAPTURE(name);
      CAPTURE(projects);
      Pendulum system(projects);
      PendulumResidual residual;
      const auto integrator = make_integrator(problem(system, &residual), with_tolerance(name, 1e-5));
      const double start[4] = {1.0, 0.0, 0.0, 0.0};
      integrator->init(0.0, start);
      run_to(*integrator, 1.3);
      const std::vector<double> saved = integrator->save();
      Pendulum other_system(projects);
      const auto other = make_integrator(problem(other_system, &residual), with_tolerance(name, 1e-5));
      other->init(7.0, start);
      other->load(saved);
      for (int i = 0; i < 50; ++i) {
        integrator->step(100.0);
        other->step(100.0);
        REQUIRE(integrator->time() == other->time());
        REQUIRE(same_bits(integrator->state(), other->state(), 4));
        double a[4], b[4];
        const double t = 0.3 * integrator->previous_time() + 0.7 * integrator->time();
        integrator->interpolate(t, a);
        other->interpolate(t, b);
        REQUIRE(same_bits(a, b, 4));
      }
      CHECK_THROWS_AS(other->load(std::vector<double>(3)), std::invalid_argument);
    }
  }
}

TEST_CASE("the SUNDIALS methods restart from what they saved") {
  for (const IntegratorProperties& method : methods(std::not_fn(is_own))) {
    const std::string name = method.name;
    CAPTURE(name);
    FunctionSystem system = smooth_system();
    SmoothResidual residual;
    const auto integrator = started(with_tolerance(name, 1e-8), system, residual);
    run_to(*integrator, 1.0);
    const std::vector<double> saved = integrator->save();
    const auto other = started(with_tolerance(name, 1e-8), system, residual);
    other->load(saved);
    CHECK(other->time() == 1.0);
    run_to(*other, 3.0);
    CHECK(largest_error(other->state(), smooth_solution(3.0)) < 1e-5);
    CHECK_THROWS_AS(other->load(std::vector<double>(3)), std::invalid_argument);
  }
}

TEST_CASE("a component of infinite tolerance does not steer the step size") {
  for (const IntegratorProperties& method : methods(is_adaptive)) {
    const std::string name = method.name;
    CAPTURE(name);
    // The second component is a quadrature with a fast wiggle that alone would force tiny steps.
    const auto rhs = [](double t, const double* y, double* ydot) {
      ydot[0] = -0.1 * y[0];
      ydot[1] = 1e3 * std::cos(300.0 * t);
    };
    FunctionSystem system(2, rhs);
    class Residual final : public PlainResidual {
     public:
      std::size_t size() const override { return 2; }
      void residual(double t, const double* y, const double* ydot, double* r) override {
        r[0] = ydot[0] + 0.1 * y[0];
        r[1] = ydot[1] - 1e3 * std::cos(300.0 * t);
      }
      std::span<const double> differential() const override { return differential_; }
      void expand(double t, const double* state, double* y, double* ydot) override {
        std::copy_n(state, 2, y);
        residual(t, y, std::array<double, 2>{}.data(), ydot);
        ydot[0] = -ydot[0];
        ydot[1] = -ydot[1];
      }
      void contract(double, const double* y, double* state) const override { std::copy_n(y, 2, state); }

     private:
      std::array<double, 2> differential_ = {1.0, 1.0};
    } residual;
    IntegratorOptions options = with_tolerance(name, 1e-6);
    options.absolute_tolerance = {1e-6, std::numeric_limits<double>::infinity()};
    const auto integrator = make_integrator(problem(system, &residual), options);
    const double y0[2] = {1.0, 0.0};
    integrator->init(0.0, y0);
    run_to(*integrator, 10.0);
    MESSAGE(name, " steps ", integrator->counters().steps);
    CHECK(integrator->state()[0] == doctest::Approx(std::exp(-1.0)).epsilon(1e-4));
    CHECK(integrator->counters().steps < (integrator->order() == 2 ? 1000 : 300));
  }
}

}  // namespace seacrane::test
