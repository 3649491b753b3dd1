#include <doctest/doctest.h>

#include <complex>

#include "seacrane/integrate/phi_functions.hpp"
#include "test_integrate_problems.hpp"

namespace seacrane::test {
namespace {

using Complex = std::complex<double>;

/// z' = pole z + 1 + 2 t - 3 t^2 for a complex z, beside a quadrature that knows of nothing.
class Filter final : public System {
 public:
  explicit Filter(Complex pole) : pole_(pole) {}
  std::size_t size() const override { return 3; }
  void derivative(double t, const double* y, double* ydot) override {
    const Complex z = pole_ * Complex(y[1], y[2]) + input(t);
    ydot[0] = t * t;
    ydot[1] = z.real();
    ydot[2] = z.imag();
  }
  std::vector<LinearBlock> linear_blocks() const override {
    return {{1, 2, {pole_.real(), -pole_.imag(), pole_.imag(), pole_.real()}}};
  }
  /// A polynomial that solves the equation, and the rest of the start dying away.
  Complex exact(double t, Complex start) const {
    const Complex p2 = 3.0 / pole_, p1 = (2.0 * p2 - 2.0) / pole_, p0 = (p1 - 1.0) / pole_;
    return p0 + p1 * t + p2 * t * t + (start - p0) * std::exp(pole_ * t);
  }

 private:
  static double input(double t) { return 1.0 + 2.0 * t - 3.0 * t * t; }
  Complex pole_;
};

/// By scaling, the Taylor polynomial and squaring.
MatXd exponential(const MatXd& z) {
  const MatXd scaled = z / 1024.0;
  MatXd sum = MatXd::Identity(z.rows(), z.cols()), term = sum;
  for (int k = 1; k < 15; ++k) {
    term = (scaled * term / static_cast<double>(k)).eval();
    sum += term;
  }
  for (int i = 0; i < 10; ++i) sum = (sum * sum).eval();
  return sum;
}

}  // namespace

TEST_CASE("phi functions agree with blocks of a matrix exponential") {
  // exp of (z 1 0 0; 0 0 1 0; 0 0 0 1; 0 0 0 0) holds phi_1, phi_2, phi_3 in its first row of blocks.
  const Eigen::Index n = 4;
  MatXd z(n, n);
  z << -3.0, 1.0, 0.2, 0.0, -1.0, -2.0, 0.0, 0.5, 0.3, 0.0, -8.0, 2.0, 0.0, -0.1, -2.0, -8.0;
  for (const double scale : {1e-6, 0.01, 0.3, 1.0, 5.0}) {
    CAPTURE(scale);
    MatXd large = MatXd::Zero(4 * n, 4 * n);
    large.topLeftCorner(n, n) = scale * z;
    large.topRightCorner(3 * n, 3 * n).setIdentity();
    const MatXd expected = exponential(large);
    PhiFunctions phi(n);
    phi.evaluate(scale * z);
    for (Eigen::Index k = 0; k < 4; ++k) {
      CAPTURE(k);
      CHECK((phi[static_cast<std::size_t>(k)] - expected.block(0, k * n, n, n)).norm() < 1e-13);
    }
  }
}

TEST_CASE("rk4-exact-memory is exact for an input quadratic in time, whatever the step and the pole") {
  for (const Complex pole : {Complex(-0.3, 1.1), Complex(-50.0, 20.0), Complex(-1e4, 0.0)}) {
    CAPTURE(pole.real());
    Filter system(pole);
    const auto integrator = make_integrator(system, nullptr, with_step("rk4-exact-memory", 0.8));
    const double start[3] = {0.0, 2.0, -1.0};
    integrator->init(0.0, start);
    while (integrator->time() < 2.0) {  // the last steps are shorter
      integrator->step(2.0);
      const Complex exact = system.exact(integrator->time(), {2.0, -1.0});
      CHECK(integrator->state()[1] == doctest::Approx(exact.real()).epsilon(1e-12).scale(1.0));
      CHECK(integrator->state()[2] == doctest::Approx(exact.imag()).epsilon(1e-12).scale(1.0));
    }
    CHECK(integrator->counters().steps == 3);
    CHECK(integrator->state()[0] == doctest::Approx(8.0 / 3.0).epsilon(1e-14));
    // The classical method gains nothing of the kind: it blows up beyond h pole = 2.8.
    const auto classical = make_integrator(system, nullptr, with_step("rk4", 0.8));
    classical->init(0.0, start);
    run_to(*classical, 2.0);
    CHECK(std::abs(classical->state()[1] - system.exact(2.0, {2.0, -1.0}).real()) > 1e-4);
  }
}

TEST_CASE("ark-mri steps a fast oscillator apart from slow forces") {
  // x'' = -w^2 x - 2 d w x' + slow forces that also depend on x: the slow step is 16 periods of the fast
  // mode.
  class Driven final : public System {
   public:
    explicit Driven(double frequency) : w_(frequency) {}
    std::size_t size() const override { return 4; }
    void derivative(double t, const double* y, double* ydot) override {
      fast_derivative(t, y, ydot);
      ydot[1] += y[2] + 0.1 * std::cos(y[0]);
      ydot[2] += y[3];
      ydot[3] += -std::sin(y[2]) + 0.1 * y[0];
    }
    std::string missing_fast_part() const override { return ""; }
    void fast_derivative(double, const double* y, double* ydot) override {
      ydot[0] = y[1];
      ydot[1] = -w_ * w_ * y[0] - 1.4 * w_ * y[1];
      ydot[2] = ydot[3] = 0.0;
    }

   private:
    double w_;
  } system(1000.0);
  const double start[4] = {1e-3, 0.0, 0.5, 0.0};
  const auto solution = [&](const IntegratorOptions& options, Counters* counters = nullptr) {
    const auto integrator = make_integrator(system, nullptr, options);
    integrator->init(0.0, start);
    run_to(*integrator, 3.0);
    if (counters) *counters = integrator->counters();
    return std::vector<double>(integrator->state(), integrator->state() + 4);
  };
  const std::vector<double> exact = solution(with_tolerance("dop853", 1e-12));
  IntegratorOptions options = with_tolerance("ark-mri", 1e-10);
  Counters counters;
  const auto error = [&](double h) {
    options.fixed_step = h;
    const std::vector<double> found = solution(options, &counters);
    return std::hypot(found[2] - exact[2], found[3] - exact[3]);
  };
  const double coarse = error(0.1), fine = error(0.05);
  MESSAGE("errors ", coarse, " ", fine, ", evaluations ", counters.evaluations, ", of the fast part ",
          counters.fast_evaluations);
  CHECK(coarse < 1e-4);
  CHECK(fine < coarse / 6.0);
  CHECK(counters.steps == 60);
  CHECK(counters.evaluations == 4 * counters.steps);
  CHECK(counters.fast_evaluations > 20 * counters.evaluations);
}

}  // namespace seacrane::test
