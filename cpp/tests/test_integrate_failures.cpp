#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "test_integrate_problems.hpp"

namespace seacrane::test {
namespace {

struct Custom : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// y' = f(t, y) of one unknown in both forms.
class Scalar final : public PlainResidual {
 public:
  using Function = std::function<double(double, double)>;
  explicit Scalar(Function f)
      : f_(std::move(f)),
        explicit_form(1, [this](double t, const double* y, double* ydot) { ydot[0] = f_(t, y[0]); }) {}
  std::size_t size() const override { return 1; }
  void residual(double t, const double* y, const double* ydot, double* r) override {
    r[0] = ydot[0] - f_(t, y[0]);
  }
  std::span<const double> differential() const override { return differential_; }
  void expand(double t, const double* state, double* y, double* ydot) override {
    y[0] = state[0];
    ydot[0] = f_(t, y[0]);
  }
  void contract(double, const double* y, double* state) const override { state[0] = y[0]; }

 private:
  Function f_;
  std::array<double, 1> differential_ = {1.0};

 public:
  FunctionSystem explicit_form;
};

void run_counted(Integrator& integrator, double t_end) {
  for (int i = 0; integrator.time() < t_end; ++i) {
    REQUIRE(i < 100000);
    integrator.step(t_end);
    REQUIRE(std::isfinite(integrator.state()[0]));
  }
}

}  // namespace

TEST_CASE("a solution that blows up ends in an IntegrationError, not in a NaN or a hang") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    Scalar scalar([](double, double y) { return y * y; });
    const auto integrator =
        make_integrator(problem(scalar.explicit_form, &scalar), with_tolerance(name, 1e-6));
    const double y0 = 1.0;
    integrator->init(0.0, &y0);
    try {
      run_counted(*integrator, 2.0);
      FAIL("no error at the pole");
    } catch (const IntegrationError& error) {
      MESSAGE(std::string(error.what()));
      CHECK(error.method() == name);
      CHECK(error.component() == 0);
      if (integrator->is_adaptive()) {
        CHECK(error.time() == doctest::Approx(1.0).epsilon(1e-3));
        CHECK(std::abs(error.step_size()) < 1e-3);
      }
      CHECK(std::string(error.what()).find(name) != std::string::npos);
      CHECK(std::isfinite(integrator->state()[0]));
    }
  }
}

TEST_CASE("a failing solver prints nothing") {
  std::FILE* const caught = std::tmpfile();
  REQUIRE(caught != nullptr);
  std::fflush(nullptr);
  const int kept_out = dup(STDOUT_FILENO);
  const int kept_err = dup(STDERR_FILENO);
  dup2(fileno(caught), STDOUT_FILENO);
  dup2(fileno(caught), STDERR_FILENO);
  int failures = 0;
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    Scalar scalar([](double, double y) { return y * y; });
    const auto integrator =
        make_integrator(problem(scalar.explicit_form, &scalar), with_tolerance(name, 1e-6));
    const double y0 = 1.0;
    integrator->init(0.0, &y0);
    try {
      run_counted(*integrator, 2.0);
    } catch (const IntegrationError&) {
      ++failures;
    }
  }
  std::fflush(nullptr);
  const off_t printed = lseek(fileno(caught), 0, SEEK_END);
  dup2(kept_out, STDOUT_FILENO);
  dup2(kept_err, STDERR_FILENO);
  close(kept_out);
  close(kept_err);
  std::fclose(caught);
  CHECK(failures == static_cast<int>(integrators().size()));
  CHECK(printed == 0);
}

TEST_CASE("an exception of the system reaches the caller, also through C, and the run can go on") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    bool broken = true;
    Scalar scalar([&](double t, double y) {
      if (broken && t > 0.5) throw Custom("the sea is gone");
      return -y;
    });
    const auto integrator =
        make_integrator(problem(scalar.explicit_form, &scalar), with_tolerance(name, 1e-8));
    const double y0 = 1.0;
    integrator->init(0.0, &y0);
    CHECK_THROWS_WITH_AS(run_counted(*integrator, 1.0), "the sea is gone", Custom);
    CHECK(integrator->time() <= 0.5);
    CHECK(integrator->state()[0] ==
          doctest::Approx(std::exp(-integrator->time())).epsilon(std::max(1e-6, 0.1 * allowance(method))));
    double y = 0.0;
    integrator->interpolate(integrator->time(), &y);
    CHECK(y == integrator->state()[0]);
    broken = false;
    run_counted(*integrator, 1.0);
    CHECK(integrator->state()[0] ==
          doctest::Approx(std::exp(-1.0)).epsilon(std::max(1e-6, 0.1 * allowance(method))));
  }
}

TEST_CASE("an exception of the projection reaches the caller and leaves the step undone") {
  class Breaking final : public PlainSystem, public FirstArePositions<0> {
   public:
    std::size_t size() const override { return 1; }
    void derivative(double, const double* y, double* ydot) override { ydot[0] = -y[0]; }
    bool has_projection() const override { return true; }
    bool project(double t, double* y, bool) override {
      if (t > 0.5) {
        y[0] = 99.0;
        throw Custom("no way back");
      }
      return false;
    }
  } system;
  for (const IntegratorProperties& method : methods([](const auto& m) { return !m.residual_form; })) {
    const std::string name = method.name;
    CAPTURE(name);
    const auto integrator = make_integrator(problem(system), with_tolerance(name, 1e-8));
    const double y0 = 1.0;
    integrator->init(0.0, &y0);
    CHECK_THROWS_AS(run_counted(*integrator, 1.0), Custom);
    CHECK(integrator->time() <= 0.5);
    CHECK(integrator->state()[0] ==
          doctest::Approx(std::exp(-integrator->time())).epsilon(std::max(1e-6, 0.1 * allowance(method))));
  }
}

TEST_CASE("a derivative that is not finite beyond a border makes adaptive methods shorten the step") {
  // Square root of a falling height: y = (1 - t/2)^2 until t = 2; a long step looks below zero.
  for (const IntegratorProperties& method : methods(is_adaptive)) {
    const std::string name = method.name;
    CAPTURE(name);
    int outside = 0;
    Scalar scalar([&](double, double y) {
      if (y < 0.0) ++outside;
      return -std::sqrt(y);
    });
    IntegratorOptions options = with_tolerance(name, 1e-6);
    options.initial_step = 1.7;
    options.absolute_tolerance = {1e-3};
    const auto integrator = make_integrator(problem(scalar.explicit_form, &scalar), options);
    const double y0 = 1.0;
    integrator->init(0.0, &y0);
    run_counted(*integrator, 1.5);
    CHECK(integrator->state()[0] == doctest::Approx(0.0625).epsilon(0.05));
    MESSAGE(name, " looked outside ", outside, " times");
  }
}

TEST_CASE("a derivative that is never finite stops every method with its component") {
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    Scalar scalar([](double t, double) { return t < 0.25 ? 1.0 : std::numeric_limits<double>::quiet_NaN(); });
    const auto integrator =
        make_integrator(problem(scalar.explicit_form, &scalar), with_tolerance(name, 1e-6));
    const double y0 = 0.0;
    integrator->init(0.0, &y0);
    try {
      run_counted(*integrator, 1.0);
      FAIL("no error");
    } catch (const IntegrationError& error) {
      MESSAGE(std::string(error.what()));
      CHECK(error.component() == 0);
      CHECK(error.time() <= 0.25);
      CHECK(error.time() > 0.2);
    }
  }
}

TEST_CASE("tolerances far below rounding are refused by the own methods, not met by chance") {
  for (const IntegratorProperties& method :
       methods([](const auto& m) { return is_own(m) && m.is_adaptive(); })) {
    const std::string name = method.name;
    CAPTURE(name);
    FunctionSystem system = smooth_system();
    const auto integrator = make_integrator(problem(system), with_tolerance(name, 1e-30));
    integrator->init(0.0, smooth_solution(0.0).data());
    CHECK_THROWS_AS(integrator->step(1.0), IntegrationError);
    CHECK(integrator->time() == 0.0);
  }
}

TEST_CASE("options and calls that make no sense are refused with a reason") {
  FunctionSystem system = smooth_system();
  SmoothResidual residual;
  IntegratorOptions options;
  options.name = "euler";
  std::string known;
  for (const IntegratorProperties& method : integrators()) {
    known += (known.empty() ? "" : ", ") + std::string(method.name);
  }
  CHECK_THROWS_WITH_AS(make_integrator(problem(system), options),
                       ("unknown integrator \"euler\"; choose one of " + known).c_str(),
                       std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const IntegratorProperties& method : integrators()) {
    const std::string name = method.name;
    CAPTURE(name);
    const auto refused = [&](auto change) {
      IntegratorOptions bad = with_tolerance(name, 1e-6);
      change(bad);
      CHECK_THROWS_AS(make_integrator(problem(system, &residual), bad), std::invalid_argument);
    };
    refused([&](IntegratorOptions& o) { o.relative_tolerance = -1e-6; });
    refused([&](IntegratorOptions& o) { o.relative_tolerance = nan; });
    refused([&](IntegratorOptions& o) { o.absolute_tolerance = {}; });
    refused([&](IntegratorOptions& o) { o.absolute_tolerance = {1e-6, 1e-6}; });
    refused([&](IntegratorOptions& o) { o.absolute_tolerance = {1e-6, 0.0, 1e-6}; });
    refused([&](IntegratorOptions& o) { o.absolute_tolerance = {infinity}; });
    refused([&](IntegratorOptions& o) { o.fixed_step = -0.1; });
    refused([&](IntegratorOptions& o) { o.max_step = nan; });
    refused([&](IntegratorOptions& o) { o.initial_step = infinity; });

    const auto integrator = make_integrator(problem(system, &residual), with_tolerance(name, 1e-6));
    const double bad_state[3] = {1.0, nan, 1.0};
    CHECK_THROWS_AS(integrator->init(0.0, bad_state), std::invalid_argument);
    integrator->init(0.0, smooth_solution(0.0).data());
    CHECK_THROWS_AS(integrator->step(-1.0), std::invalid_argument);
    CHECK_THROWS_AS(integrator->step(nan), std::invalid_argument);
    integrator->step(1.0);
    double y[3];
    CHECK_THROWS_AS(integrator->interpolate(integrator->time() + 0.1, y), std::invalid_argument);
    CHECK_THROWS_AS(integrator->interpolate(-0.1, y), std::invalid_argument);
  }
}

TEST_CASE("a method that needs what the system has not says so") {
  FunctionSystem system = smooth_system();
  SmoothResidual residual;
  for (const IntegratorProperties& method : integrators()) {
    const IntegratorOptions options = with_tolerance(method.name, 1e-6);
    const auto refused = [&](const Problem& problem, const char* missing) {
      const std::string text = "integrator \"" + std::string(method.name) + "\" needs " + missing;
      CHECK_THROWS_WITH_AS(make_integrator(problem, options), text.c_str(), std::invalid_argument);
    };
    if (method.residual_form) refused({system, &system, nullptr}, "the residual form of the system");
    if (method.uses_positions) refused({system, nullptr, &residual}, "a system that tells its positions");
    if (!method.residual_form && !method.uses_positions) CHECK(make_integrator({system}, options));
  }
  IntegratorOptions options = with_tolerance("dopri5", 1e-6);
  options.spectral_radius = 0.5;
  CHECK_THROWS_WITH_AS(
      make_integrator(problem(system), options),
      doctest::Contains(
          "\"dopri5\" has no spectral radius to choose; leave it out, or choose \"generalized-alpha\""),
      std::invalid_argument);
}

}  // namespace seacrane::test
