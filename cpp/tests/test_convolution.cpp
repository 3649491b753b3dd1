#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <functional>

#include "count_allocations.hpp"
#include "multibody_scenes.hpp"
#include "seacrane/compile/compile.hpp"
#include "seacrane/hydro/convolution.hpp"
#include "seacrane/run/simulation.hpp"

namespace seacrane::test {
namespace {

/// exp(-a tau) cos(b tau) between heave and pitch (both ways), exp(-a tau) in roll.
constexpr double a = 0.6, b = 1.3;

RetardationFunctions functions(double step, double duration = 40.0) {
  RetardationFunctions out{step, {}};
  for (int i = 0; i <= static_cast<int>(std::lround(duration / step)); ++i) {
    const double tau = step * i;
    Mat6d k = Mat6d::Zero();
    k(2, 4) = k(4, 2) = std::exp(-a * tau) * std::cos(b * tau);
    k(3, 3) = std::exp(-a * tau);
    out.kernel.push_back(k);
  }
  return out;
}

/// int_0^t exp(-z tau) exp(i w (t - tau)) dtau.
std::complex<double> response(std::complex<double> z, double w, double t) {
  const std::complex<double> i(0.0, 1.0);
  return (std::exp(i * w * t) - std::exp(-z * t)) / (z + i * w);
}

/// Speed in heave and acceleration in roll jump at t = 0: cos(w t) and sin(w t) from there on.
constexpr double w = 0.9;

Vec6d twist_at(double t) {
  Vec6d v = Vec6d::Zero();
  v[2] = std::cos(w * t);
  v[3] = std::sin(w * t);
  return v;
}

Vec6d first_rate() {
  Vec6d rate = Vec6d::Zero();
  rate[3] = w;
  return rate;
}

/// Load on pitch due to heave; the kernel is the real part of exp(-(a + i b) tau).
double pitch_load(double t) {
  return 0.25 * (response({a, b}, w, t) + response({a, -b}, w, t) + response({a, b}, -w, t) +
                 response({a, -b}, -w, t))
                    .real();
}

double roll_load(double t) { return response(a, w, t).imag(); }

/// Largest error of the load on pitch and roll within 25 s.
double error_with_step(double step) {
  const Convolution tables(functions(step));
  RunningConvolution memory(tables);
  memory.start(0.0, twist_at(0.0), first_rate());
  double worst = 0.0;
  while (memory.next() < 25.0) {
    const double from = memory.next() - step;
    for (const double part : {0.0, 0.3, 0.77, 1.0}) {
      const double t = from + part * step;
      const Vec6d mu = memory.evaluate(t, twist_at(t));
      worst = std::max(worst, std::abs(mu[4] - pitch_load(t)));
      worst = std::max(worst, std::abs(mu[3] - roll_load(t)));
      CHECK(mu[2] == 0.0);
    }
    memory.sample(twist_at(memory.next()));
  }
  return worst;
}

}  // namespace

TEST_CASE("convolution of harmonic motion with exponentials converges to fourth order") {
  const double coarse = error_with_step(0.2), fine = error_with_step(0.1), finest = error_with_step(0.05);
  CAPTURE(coarse);
  CAPTURE(fine);
  CAPTURE(finest);
  CHECK(std::log2(coarse / fine) > 3.5);
  CHECK(std::log2(fine / finest) > 3.7);
  CHECK(finest < 1e-6);
}

TEST_CASE("the load of a convolution is continuous at its samples") {
  const Convolution tables(functions(0.1));
  RunningConvolution memory(tables);
  memory.start(0.0, twist_at(0.0), first_rate());
  for (int i = 0; i < 600; ++i) {
    const double t = memory.next();
    const Vec6d before = memory.evaluate(t, twist_at(t));
    memory.sample(twist_at(t));
    CHECK((memory.evaluate(t, twist_at(t)) - before).cwiseAbs().maxCoeff() < 1e-13);
  }
}

TEST_CASE("a convolution goes on from its history bit for bit") {
  const Convolution tables(functions(0.1));
  for (const int samples : {0, 1, 2, 57, 900}) {
    RunningConvolution memory(tables), again(tables);
    memory.start(0.5, twist_at(0.0), first_rate());
    for (int i = 0; i < samples; ++i) memory.sample(twist_at(0.1 * i));
    const double t = memory.next() - 0.04;
    again.restore(t, memory.save());
    for (int i = 0; i < 3; ++i) {
      CHECK(again.next() == memory.next());
      CHECK(again.evaluate(t, twist_at(t)) == memory.evaluate(t, twist_at(t)));
      memory.sample(twist_at(t));
      again.sample(twist_at(t));
    }
  }
}

TEST_CASE("a run with a convolution allocates nothing after its start") {
  SceneDescription scene = slider_crank("hull");
  make_vessel(scene, "hull");
  RetardationFunctions kernel = functions(0.05, 2.0);
  for (Mat6d& k : kernel.kernel) k *= 0.1;
  scene.vessels.front().memory = kernel;
  const auto model = compile(scene);
  for (const std::string integrator : {"dopri5", "rk4"}) {
    CAPTURE(integrator);
    RunOptions options;
    options.integrator = integrator;
    options.fixed_step = 0.01;
    for (int i = 0; i <= 300; ++i) options.output_times.push_back(0.01 * i);
    for (const auto& name : channel_names(*model, false)) options.channels.insert(name);
    Simulation run(model, initial_state(*model), options);
    const std::function<bool(double)> keep_going = [](double) { return true; };
    run.advance(0.12, keep_going);
    const long before = allocation_count();
    run.advance(3.0, keep_going);
    CHECK(allocation_count() == before);
    CHECK(run.state().histories.front().intervals >= 59);
  }
}

}  // namespace seacrane::test
