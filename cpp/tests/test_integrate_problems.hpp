#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "seacrane/integrate/registry.hpp"

namespace seacrane::test {

/// What methods that split the system need, of any system: a part of f counts as fast, and the first
/// component as linear with a coefficient that is none of its own. The orders hold for every split.
class SplitSystem : public System {
 public:
  std::string missing_fast_part() const override { return ""; }
  void fast_derivative(double t, const double* y, double* ydot) override {
    derivative(t, y, ydot);
    for (std::size_t i = 0; i < size(); ++i) ydot[i] *= 0.4;
  }
  std::vector<LinearBlock> linear_blocks() const override { return {{0, 1, {-0.7}}}; }
};

/// A system given by a function, without projection.
class FunctionSystem final : public SplitSystem {
 public:
  using Function = std::function<void(double, const double*, double*)>;
  FunctionSystem(std::size_t size, Function f) : size_(size), f_(std::move(f)) {}
  std::size_t size() const override { return size_; }
  void derivative(double t, const double* y, double* ydot) override { f_(t, y, ydot); }

 private:
  std::size_t size_;
  Function f_;
};

/// u' = -v (u^2 + v^2), v' = u (u^2 + v^2), w' = w^2 cos t: smooth, nonlinear, solution known.
inline FunctionSystem smooth_system() {
  return {3, [](double t, const double* y, double* ydot) {
            const double r2 = y[0] * y[0] + y[1] * y[1];
            ydot[0] = -y[1] * r2;
            ydot[1] = y[0] * r2;
            ydot[2] = y[2] * y[2] * std::cos(t);
          }};
}
inline std::vector<double> smooth_solution(double t) {
  return {std::cos(t), std::sin(t), 1.0 / (2.0 - std::sin(t))};
}

/// The smooth system as F(t, y, y') = y' - f(t, y).
class SmoothResidual final : public ResidualSystem {
 public:
  std::size_t size() const override { return 3; }
  void residual(double t, const double* y, const double* ydot, double* r) override {
    system_.derivative(t, y, r);
    for (std::size_t i = 0; i < 3; ++i) r[i] = ydot[i] - r[i];
  }
  std::span<const double> differential() const override { return differential_; }
  void expand(double t, const double* state, double* y, double* ydot) override {
    std::copy_n(state, 3, y);
    system_.derivative(t, y, ydot);
  }
  void contract(double, const double* y, double* state) const override { std::copy_n(y, 3, state); }

 private:
  FunctionSystem system_ = smooth_system();
  std::array<double, 3> differential_ = {1.0, 1.0, 1.0};
};

/// Gravity for which a unit pendulum let go from the horizontal has a period of 2 s: T = 4 K(sin 45 deg) /
/// sqrt(g).
inline double pendulum_gravity() {
  const double quarter = std::comp_ellint_1(std::sqrt(0.5));
  return 4.0 * quarter * quarter;
}

/// Pendulum of unit mass on the unit circle in Cartesian coordinates (x, y, x', y'), index 1, with
/// projection on position and velocity level when asked for.
class Pendulum final : public SplitSystem {
 public:
  explicit Pendulum(bool projects) : projects_(projects) {}
  std::size_t size() const override { return 4; }
  void derivative(double t, const double* y, double* ydot) override {
    evaluated_time = t;
    std::copy_n(y, 4, evaluated_state.data());
    const double tension = (y[2] * y[2] + y[3] * y[3] - gravity * y[1]) / (y[0] * y[0] + y[1] * y[1]);
    ydot[0] = y[2];
    ydot[1] = y[3];
    ydot[2] = -tension * y[0];
    ydot[3] = -tension * y[1] - gravity;
  }
  bool has_projection() const override { return projects_; }
  std::size_t position_size() const override { return 2; }
  void move(double h, double* y) override {
    y[0] += h * y[2];
    y[1] += h * y[3];
  }
  bool project(double t, double* y, bool evaluated_here) override {
    if (evaluated_here && (t != evaluated_time || !std::equal(y, y + 4, evaluated_state.data()))) {
      ++false_claims;
    }
    const double r = std::hypot(y[0], y[1]);
    y[0] /= r;
    y[1] /= r;
    const double outward = y[0] * y[2] + y[1] * y[3];
    y[2] -= outward * y[0];
    y[3] -= outward * y[1];
    return std::abs(r - 1.0) > 1e-15 || std::abs(outward) > 1e-15;
  }
  static double drift(const double* y) {
    return std::max(std::abs(y[0] * y[0] + y[1] * y[1] - 1.0), std::abs(y[0] * y[2] + y[1] * y[3]));
  }

  const double gravity = pendulum_gravity();
  int false_claims = 0;
  double evaluated_time = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 4> evaluated_state{};

 private:
  bool projects_;
};

/// The same pendulum in the stabilised index-2 form of Gear, Gupta and Leimkuhler:
/// q' = v - q mu, v' = -q lambda - g, q.q = 1, q.v = 0.
class PendulumResidual final : public ResidualSystem {
 public:
  std::size_t size() const override { return 6; }
  void residual(double, const double* y, const double* ydot, double* r) override {
    r[0] = ydot[0] - y[2] + y[0] * y[5];
    r[1] = ydot[1] - y[3] + y[1] * y[5];
    r[2] = ydot[2] + y[0] * y[4];
    r[3] = ydot[3] + y[1] * y[4] + gravity_;
    r[4] = y[0] * y[2] + y[1] * y[3];
    r[5] = 0.5 * (y[0] * y[0] + y[1] * y[1] - 1.0);
  }
  std::span<const double> differential() const override { return differential_; }
  void expand(double t, const double* state, double* y, double* ydot) override {
    std::copy_n(state, 4, y);
    Pendulum(false).derivative(t, state, ydot);
    y[4] = (y[2] * y[2] + y[3] * y[3] - gravity_ * y[1]) / (y[0] * y[0] + y[1] * y[1]);
    y[5] = ydot[4] = ydot[5] = 0.0;
  }
  void contract(double, const double* y, double* state) const override { std::copy_n(y, 4, state); }

 private:
  double gravity_ = pendulum_gravity();
  std::array<double, 6> differential_ = {1.0, 1.0, 1.0, 1.0, 0.0, 0.0};
};

/// Unit pendulum in its angle, a position: q' = v, v' = -sin q; the system tells positions from velocities.
class AnglePendulum final : public SplitSystem {
 public:
  std::size_t size() const override { return 2; }
  void derivative(double, const double* y, double* ydot) override {
    ydot[0] = y[1];
    ydot[1] = -std::sin(y[0]);
  }
  std::size_t position_size() const override { return 1; }
  void move(double h, double* y) override { y[0] += h * y[1]; }
};

/// Names of the methods with a fixed step, of those with step size control of our own, and of both.
inline const std::vector<std::string> fixed_step_methods = {
    "semi-implicit-euler",     "rk4", "rk4-exact-memory", "rk-low-storage", "generalized-alpha",
    "generalized-alpha-index2"};
inline const std::vector<std::string> adaptive_step_methods = {
    "heun21", "bs32", "rk43", "dopri5", "tsit5", "verner65", "verner76", "dop853", "rosenbrock"};
inline std::vector<std::string> own_methods() {
  std::vector<std::string> names = fixed_step_methods;
  names.insert(names.end(), adaptive_step_methods.begin(), adaptive_step_methods.end());
  return names;
}
inline const std::vector<std::string> sundials_methods = {"ark-erk",     "ark-dirk",  "ark-imex", "ark-mri",
                                                          "cvode-adams", "cvode-bdf", "ida"};
inline std::vector<std::string> adaptive_methods() {
  std::vector<std::string> names = adaptive_step_methods;
  for (const std::string& name : sundials_methods) {
    if (name != "ark-mri") names.push_back(name);
  }
  return names;
}

/// What the default fixed steps of the methods of low order leave where others keep to 1e-4.
inline double allowance(const std::string& name) {
  if (name == "semi-implicit-euler") return 2e-2;
  return name.starts_with("generalized-alpha") ? 2e-3 : 1e-4;
}

inline IntegratorOptions with_tolerance(const std::string& name, double tolerance) {
  IntegratorOptions options;
  options.name = name;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = {tolerance};
  if (name == "ark-mri") options.fixed_step = 0.01;  // of the slow part, which knows no tolerance
  return options;
}

/// Options that make every method take steps of h: tolerances so loose that no step is refused.
inline IntegratorOptions with_step(const std::string& name, double h) {
  IntegratorOptions options = with_tolerance(name, 0.5);
  options.absolute_tolerance = {1e6};
  options.fixed_step = options.max_step = options.initial_step = h;
  return options;
}

inline void run_to(Integrator& integrator, double t_end) {
  while (integrator.time() < t_end) integrator.step(t_end);
}

inline double largest_error(const double* y, const std::vector<double>& exact) {
  double largest = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) largest = std::max(largest, std::abs(y[i] - exact[i]));
  return largest;
}

}  // namespace seacrane::test
