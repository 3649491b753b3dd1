#include <doctest/doctest.h>

#include "test_integrate_problems.hpp"

namespace seacrane::test {
namespace {

double error_at_end(const IntegratorOptions& options, double t_end = 5.0) {
  FunctionSystem system = smooth_system();
  SmoothResidual residual;
  const auto integrator = make_integrator(system, &residual, options);
  integrator->init(0.0, smooth_solution(0.0).data());
  run_to(*integrator, t_end);
  return largest_error(integrator->state(), smooth_solution(t_end));
}

/// Largest error of dense output within the first step of length h.
double dense_error(const std::string& name, double h) {
  FunctionSystem system = smooth_system();
  const auto integrator = make_integrator(system, nullptr, with_step(name, h));
  const double t0 = 0.4;
  integrator->init(t0, smooth_solution(t0).data());
  integrator->step(t0 + 10.0);
  REQUIRE(integrator->time() == doctest::Approx(t0 + h).epsilon(1e-12));
  std::vector<double> y(3);
  double largest = 0.0;
  for (int i = 0; i <= 20; ++i) {
    const double t = t0 + (integrator->time() - t0) * i / 20.0;
    integrator->interpolate(t, y.data());
    largest = std::max(largest, largest_error(y.data(), smooth_solution(t)));
  }
  return largest;
}

double slope(double coarse, double fine, double ratio) { return std::log(coarse / fine) / std::log(ratio); }

}  // namespace

TEST_CASE("the one-step methods have their order on a smooth nonlinear problem") {
  for (const auto& [name, order] :
       {std::pair<std::string, double>{"rk4", 4.0}, {"dopri5", 5.0}, {"ark-erk", 5.0}}) {
    CAPTURE(name);
    const double coarse = error_at_end(with_step(name, 0.1));
    const double middle = error_at_end(with_step(name, 0.05));
    const double fine = error_at_end(with_step(name, 0.025));
    MESSAGE(name, " observed order ", slope(coarse, middle, 2.0), " ", slope(middle, fine, 2.0));
    CHECK(slope(middle, fine, 2.0) == doctest::Approx(order).epsilon(0.08));
  }
}

TEST_CASE("dense output of the one-step methods has a local error of order 5 in the step") {
  for (const std::string name : {"rk4", "dopri5", "ark-erk"}) {
    CAPTURE(name);
    const double observed = slope(dense_error(name, 0.05), dense_error(name, 0.025), 2.0);
    MESSAGE(name, " local order of dense output ", observed);
    CHECK(observed > 4.7);
    CHECK(observed < 6.5);
  }
}

TEST_CASE("the error of the adaptive methods falls in proportion to the tolerance") {
  for (const std::string name : {"dopri5", "ark-erk", "cvode-adams", "cvode-bdf", "ida"}) {
    CAPTURE(name);
    const double loose = error_at_end(with_tolerance(name, 1e-4));
    const double tight = error_at_end(with_tolerance(name, 1e-9));
    MESSAGE(name, " error ", loose, " at 1e-4, ", tight, " at 1e-9");
    CHECK(slope(loose, tight, 1e5) > 0.65);
    CHECK(slope(loose, tight, 1e5) < 1.35);
    CHECK(loose < 1e-4 * 200.0);
    CHECK(tight < 1e-9 * 500.0);
  }
}

TEST_CASE("dense output of every method stays within a small multiple of the tolerance") {
  for (const std::string& name : integrator_names()) {
    CAPTURE(name);
    FunctionSystem system = smooth_system();
    SmoothResidual residual;
    IntegratorOptions options = with_tolerance(name, 1e-7);
    const auto integrator = make_integrator(system, &residual, options);
    integrator->init(0.0, smooth_solution(0.0).data());
    std::vector<double> y(3);
    double largest = 0.0;
    while (integrator->time() < 4.0) {
      integrator->step(4.0);
      for (const double s : {0.0, 0.3, 0.8, 1.0}) {
        const double t = integrator->previous_time() + s * (integrator->time() - integrator->previous_time());
        integrator->interpolate(t, y.data());
        largest = std::max(largest, largest_error(y.data(), smooth_solution(t)));
      }
    }
    MESSAGE(name, " worst dense error ", largest);
    CHECK(largest < 3e-5);
  }
}

TEST_CASE("dopri5 and ARKODE with the same pair agree and cost alike") {
  FunctionSystem system = smooth_system();
  const auto own = make_integrator(system, nullptr, with_tolerance("dopri5", 1e-8));
  const auto theirs = make_integrator(system, nullptr, with_tolerance("ark-erk", 1e-8));
  for (Integrator* integrator : {own.get(), theirs.get()}) {
    integrator->init(0.0, smooth_solution(0.0).data());
    run_to(*integrator, 20.0);
  }
  CHECK(largest_error(own->state(), {theirs->state(), theirs->state() + 3}) < 1e-6);
  CHECK(own->counters().steps < 2 * theirs->counters().steps);
  CHECK(theirs->counters().steps < 2 * own->counters().steps);
  MESSAGE("evaluations: dopri5 ", own->counters().evaluations, ", ark-erk ", theirs->counters().evaluations);
}

TEST_CASE("a single step of dopri5 equals ARKODE's to rounding") {
  FunctionSystem system = smooth_system();
  const auto own = make_integrator(system, nullptr, with_step("dopri5", 0.2));
  const auto theirs = make_integrator(system, nullptr, with_step("ark-erk", 0.2));
  for (Integrator* integrator : {own.get(), theirs.get()}) {
    integrator->init(0.0, smooth_solution(0.0).data());
    integrator->step(1.0);
  }
  CHECK(own->time() == doctest::Approx(theirs->time()).epsilon(1e-15));
  CHECK(largest_error(own->state(), {theirs->state(), theirs->state() + 3}) < 4e-15);
}

}  // namespace seacrane::test
