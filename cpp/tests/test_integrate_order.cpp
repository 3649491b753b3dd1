#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "test_integrate_problems.hpp"

namespace seacrane::test {
namespace {

double error_at_end(const IntegratorOptions& options, double t_end = 5.0) {
  FunctionSystem system = smooth_system();
  SmoothResidual residual;
  const auto integrator = make_integrator(problem(system, &residual), options);
  integrator->init(0.0, smooth_solution(0.0).data());
  run_to(*integrator, t_end);
  return largest_error(integrator->state(), smooth_solution(t_end));
}

/// As with_step(), with a tight tolerance for what a method of fixed step solves by iteration.
IntegratorOptions fixed(const std::string& name, double h) {
  IntegratorOptions options = with_step(name, h);
  if (name == "generalized-alpha") options.absolute_tolerance = {1e-9};
  return options;
}

/// Largest error of dense output within the first step of length h.
double dense_error(const std::string& name, double h) {
  FunctionSystem system = smooth_system();
  SmoothResidual residual;
  const auto integrator = make_integrator(problem(system, &residual), fixed(name, h));
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

double loglog_slope(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

/// A step at which the error of a method of this order is neither rounding nor beyond its leading term.
double step_for(int order) {
  if (order == 1) return 0.002;
  return order <= 3 ? 0.02 : order <= 5 ? 0.1 : 0.4;
}

}  // namespace

TEST_CASE("the one-step methods have their order on a smooth nonlinear problem") {
  for (const IntegratorProperties& method : methods(is_own)) {
    const std::string name = method.name;
    // On the circle its leading error cancels at long steps (9 to 11 observed), and at short ones the
    // rounding of its large weights takes over (1 to 3): it is measured on the pendulum,
    // test_integrate_projection.cpp.
    if (name == "verner65") continue;
    CAPTURE(name);
    const double order = method.order, step = step_for(method.order);
    const double coarse = error_at_end(fixed(name, step));
    const double middle = error_at_end(fixed(name, 0.5 * step));
    const double fine = error_at_end(fixed(name, 0.25 * step));
    MESSAGE(name, " observed order ", loglog_slope(coarse, middle, 2.0), " ", loglog_slope(middle, fine, 2.0),
            ", error ", fine);
    CHECK(loglog_slope(middle, fine, 2.0) == doctest::Approx(order).epsilon(0.08));
  }
}

TEST_CASE("methods that choose step and order themselves: error against the number of steps") {
  for (const IntegratorProperties& method : methods(std::not_fn(is_own))) {
    const std::string name = method.name;
    CAPTURE(name);
    const auto run = [&](double tolerance) {
      FunctionSystem system = smooth_system();
      SmoothResidual residual;
      const auto integrator = make_integrator(problem(system, &residual), with_tolerance(name, tolerance));
      integrator->init(0.0, smooth_solution(0.0).data());
      run_to(*integrator, 20.0);
      return std::pair(largest_error(integrator->state(), smooth_solution(20.0)),
                       static_cast<double>(integrator->counters().steps));
    };
    const auto [loose, few] = run(1e-6);
    const auto [tight, many] = run(1e-10);
    const double observed = loglog_slope(loose, tight, many / few);
    MESSAGE(name, " observed order ", observed, ", steps ", few, " and ", many);
    CHECK(observed > 0.87 * method.order);
    CHECK(observed < 1.25 * method.order);
  }
}

TEST_CASE("dense output of the one-step methods has its order") {
  // Of those that need no past: generalized-alpha is of order 1 in its first step.
  for (const IntegratorProperties& method :
       methods([](const auto& m) { return is_own(m) && !m.residual_form; })) {
    const std::string name = method.name;
    CAPTURE(name);
    const double order = method.dense_order, step = 0.05 * std::pow(2.0, std::max(order - 4.0, 0.0));
    const double observed = loglog_slope(dense_error(name, step), dense_error(name, 0.5 * step), 2.0);
    MESSAGE(name, " local order of dense output ", observed);
    // The local error of order p falls like the step to the power p + 1.
    CHECK(observed > order + 0.7);
    CHECK(observed < order + 2.5);
  }
}

TEST_CASE("the error of the adaptive methods falls in proportion to the tolerance") {
  for (const IntegratorProperties& method : methods(is_adaptive)) {
    const std::string name = method.name;
    CAPTURE(name);
    const double loose = error_at_end(with_tolerance(name, 1e-4));
    const double tight = error_at_end(with_tolerance(name, 1e-9));
    MESSAGE(name, " error ", loose, " at 1e-4, ", tight, " at 1e-9");
    CHECK(loglog_slope(loose, tight, 1e5) > 0.55);
    CHECK(loglog_slope(loose, tight, 1e5) < 1.35);
    CHECK(loose < 1e-4 * 200.0);
    CHECK(tight < 1e-9 * 500.0);
  }
}

TEST_CASE("dense output of every method stays within a small multiple of the tolerance") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    FunctionSystem system = smooth_system();
    SmoothResidual residual;
    IntegratorOptions options = with_tolerance(name, 1e-7);
    const auto integrator = make_integrator(problem(system, &residual), options);
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
    CHECK(largest < std::max(3e-5, allowance(method) > 1e-4 ? 5.0 * allowance(method) : 0.0));
  }
}

TEST_CASE("semi-implicit Euler is symplectic: the energy of a pendulum wanders but does not drift") {
  // Explicit Euler would gain h v'^2 / 2 a unit of time: 0.5 in this run.
  AnglePendulum system;
  IntegratorOptions options = with_step("semi-implicit-euler", 0.01);
  const auto integrator = make_integrator(problem(system), options);
  const double start[2] = {1.0, 0.0};
  integrator->init(0.0, start);
  const auto energy = [](const double* y) { return 0.5 * y[1] * y[1] - std::cos(y[0]); };
  double worst = 0.0;
  while (integrator->time() < 200.0) {
    integrator->step(200.0);
    worst = std::max(worst, std::abs(energy(integrator->state()) - energy(start)));
  }
  CHECK(worst < 5e-3);
  CHECK(worst > 1e-4);
}

TEST_CASE("semi-implicit Euler moves the position with the new velocity, and keeps q^2 + v^2 - h q v") {
  class Spring final : public PlainSystem, public FirstArePositions<1> {
   public:
    std::size_t size() const override { return 2; }
    void derivative(double, const double* y, double* ydot) override {
      ydot[0] = y[1];
      ydot[1] = -y[0];
    }
  } system;
  const double h = 0.125;
  const auto integrator = make_integrator(problem(system), with_step("semi-implicit-euler", h));
  const double start[2] = {1.0, 0.5};
  integrator->init(0.0, start);
  integrator->step(10.0);
  CHECK(integrator->state()[1] == 0.5 - h * 1.0);
  CHECK(integrator->state()[0] == 1.0 + h * (0.5 - h * 1.0));
  const auto invariant = [&](const double* y) { return y[0] * y[0] + y[1] * y[1] - h * y[0] * y[1]; };
  run_to(*integrator, 1000.0);
  CHECK(std::abs(invariant(integrator->state()) - invariant(start)) < 1e-12);
}

TEST_CASE("generalized-alpha multiplies a fast mode by its spectral radius at every step") {
  // y' = -k y with h k = 1e4. Undamped at radius 1; below, what the start has left falls like the radius.
  static constexpr double rate = 1e4;
  class Residual final : public PlainResidual {
   public:
    std::size_t size() const override { return 1; }
    void residual(double, const double* y, const double* ydot, double* r) override {
      r[0] = ydot[0] / rate + y[0];
    }
    std::span<const double> differential() const override { return differential_; }
    void expand(double, const double* state, double* y, double* ydot) override {
      y[0] = state[0];
      ydot[0] = -rate * state[0];
    }
    void contract(double, const double* y, double* state) const override { state[0] = y[0]; }

   private:
    std::array<double, 1> differential_ = {1.0};
  } residual;
  FunctionSystem system(1, [](double, const double* y, double* ydot) { ydot[0] = -rate * y[0]; });
  IntegratorOptions options = with_step("generalized-alpha", 1.0);
  options.relative_tolerance = 0.0;
  options.absolute_tolerance = {1e-9};
  for (const double radius : {0.3, 0.5, 0.8}) {
    CAPTURE(radius);
    options.spectral_radius = radius;
    const auto integrator = make_integrator(problem(system, &residual), options);
    const double start = 1.0;
    integrator->init(0.0, &start);
    std::vector<double> size;
    for (int i = 0; i < 30; ++i) {
      integrator->step(100.0);
      size.push_back(std::abs(integrator->state()[0]));
    }
    // Two equal roots: n r^n, whose ratio of neighbours tends to r like 1 + 1 / n.
    const double ratio = size[12] / size[11];
    MESSAGE("radius ", radius, " ratio ", ratio, " size ", size[12]);
    CHECK(ratio < radius * 1.25);
    CHECK(ratio > radius * 0.8);
  }
  for (const double radius : {-0.1, 1.5, std::nan("")}) {
    options.spectral_radius = radius;
    CHECK_THROWS_AS(make_integrator(problem(system, &residual), options), std::invalid_argument);
  }
}

TEST_CASE("the methods of one order agree on what they solve: every pair meets dop853 at a tight tolerance") {
  const auto solution = [](const std::string& name) {
    AnglePendulum system;
    const auto integrator = make_integrator(problem(system), with_tolerance(name, 1e-10));
    const double start[2] = {2.5, 0.3};
    integrator->init(0.0, start);
    run_to(*integrator, 10.0);
    return std::vector<double>{integrator->state()[0], integrator->state()[1]};
  };
  const std::vector<double> reference = solution("dop853");
  for (const IntegratorProperties& method :
       methods([](const auto& m) { return is_own(m) && m.is_adaptive() && !m.uses_jacobian; })) {
    const std::string name = method.name;
    CAPTURE(name);
    CHECK(largest_error(solution(name).data(), reference) < 2e-7);
  }
}

}  // namespace seacrane::test
