#include <doctest/doctest.h>

#include <algorithm>

#include "test_integrate_problems.hpp"

namespace seacrane::test {
namespace {

/// Times at which the event is found over a run.
std::vector<double> events_of(Integrator& integrator, double t_end, const EventFunction& event) {
  std::vector<double> found;
  while (integrator.time() < t_end) {
    integrator.step(t_end);
    if (const auto t = integrator.locate(event)) found.push_back(*t);
  }
  return found;
}

}  // namespace

TEST_CASE("a ball thrown up meets the ground at the right time to 1e-12") {
  // The path is a parabola, which every one-step method and its dense output reproduce.
  for (const IntegratorProperties& method :
       methods([](const auto& m) { return is_own(m) && m.dense_order > 1 && !m.residual_form; })) {
    const std::string name = method.name;
    CAPTURE(name);
    FunctionSystem system(2, [](double, const double* y, double* ydot) {
      ydot[0] = y[1];
      ydot[1] = -9.81;
    });
    const auto integrator = make_integrator(problem(system), with_tolerance(name, 1e-9));
    const double y0[2] = {2.0, 5.0};
    integrator->init(0.0, y0);
    const auto found = events_of(*integrator, 3.0, [](double, const double* y) { return y[0]; });
    REQUIRE(found.size() == 1);
    // The weights of verner65 cancel: +-73 in the step, +-230 inside it.
    const double rounding = name == "verner65" ? 2e-11 : 1e-12;
    CHECK(std::abs(found[0] - (5.0 + std::sqrt(25.0 + 4.0 * 9.81)) / 9.81) < rounding);
  }
}

TEST_CASE("events of a nonlinear solution are found once each, within the tolerance") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    FunctionSystem system = smooth_system();
    SmoothResidual residual;
    IntegratorOptions options = with_tolerance(name, 1e-11);
    options.fixed_step = 0.005;
    const auto integrator = make_integrator(problem(system, &residual), options);
    integrator->init(0.0, smooth_solution(0.0).data());
    const auto found = events_of(*integrator, 9.0, [](double, const double* y) { return y[0]; });
    REQUIRE(found.size() == 3);
    double worst = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      worst = std::max(worst, std::abs(found[i] - (0.5 + static_cast<double>(i)) * std::acos(-1.0)));
    }
    MESSAGE(name, " worst event error ", worst);
    CHECK(worst < (allowance(method) > 1e-4 ? 10.0 * allowance(method) : 1e-7));
  }
}

TEST_CASE("an event is bracketed to rounding, on the side where the sign has changed") {
  FunctionSystem system(1, [](double, const double*, double* ydot) { ydot[0] = 1.0; });
  const auto integrator = make_integrator(problem(system), with_step("dopri5", 1.0));
  const double y0 = 0.0;
  integrator->init(0.0, &y0);
  integrator->step(10.0);
  const double root = 0.3141592653589793;
  SUBCASE("smooth") {
    const auto t = integrator->locate([&](double s, const double*) { return std::tanh(20.0 * (s - root)); });
    REQUIRE(t.has_value());
    CHECK(std::abs(*t - root) < 1e-15);
  }
  SUBCASE("flat, where regula falsi alone crawls") {
    int calls = 0;
    const auto t = integrator->locate([&](double s, const double*) {
      ++calls;
      return std::pow(s - root, 9);
    });
    REQUIRE(t.has_value());
    CHECK(std::abs(*t - root) < 1e-15);
    CHECK(calls < 200);
  }
  SUBCASE("a jump") {
    const auto t = integrator->locate([&](double s, const double*) { return s < root ? -1e-9 : 1e9; });
    REQUIRE(t.has_value());
    CHECK(*t >= root);
    CHECK(*t - root < 1e-15);
  }
  SUBCASE("exactly at the end of the step, and not again in the next") {
    const double end = integrator->time();
    const EventFunction event = [&](double s, const double*) { return s - end; };
    const auto t = integrator->locate(event);
    REQUIRE(t.has_value());
    CHECK(std::abs(*t - end) < 1e-15);
    integrator->step(10.0);
    CHECK_FALSE(integrator->locate(event).has_value());
  }
  SUBCASE("none") {
    CHECK_FALSE(integrator->locate([](double s, const double*) { return s + 1.0; }).has_value());
  }
  SUBCASE("not a number") {
    CHECK_THROWS_AS(integrator->locate([](double s, const double*) { return std::sqrt(s - 0.5); }),
                    IntegrationError);
  }
}

TEST_CASE("an event on the constraint itself is not lost between projected steps") {
  // The lowest point, where the Cartesian pendulum's projection moves across the event.
  Pendulum system(true);
  const auto integrator = make_integrator(problem(system), with_tolerance("dopri5", 1e-4));
  const double start[4] = {1.0, 0.0, 0.0, 0.0};
  integrator->init(0.0, start);
  const auto found = events_of(*integrator, 10.0, [](double, const double* y) { return y[0]; });
  REQUIRE(found.size() == 10);
  for (std::size_t i = 0; i < 10; ++i) {
    CHECK(std::abs(found[i] - (0.5 + static_cast<double>(i))) < 0.02);
  }
}

}  // namespace seacrane::test
