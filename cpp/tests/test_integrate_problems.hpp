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

/// A system without projection and without a Jacobian of its own.
class PlainSystem : public System {
 public:
  bool has_projection() const override { return false; }
  bool project(double, double*, bool) override { return false; }
  bool jacobian(double, const double*, double*) override { return false; }
};

/// The first components are positions and the next as many their rates.
template <std::size_t positions>
class FirstArePositions : public PositionMap {
 public:
  std::size_t position_size() const override { return positions; }
  void move(double h, double* y) override {
    for (std::size_t i = 0; i < positions; ++i) y[i] += h * y[positions + i];
  }
  bool move_jacobian(double, const double*, double*) override { return false; }
};

/// A system given by a function, without projection and without positions.
class FunctionSystem final : public PlainSystem, public FirstArePositions<0> {
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

class PlainResidual : public ResidualSystem {
 public:
  bool jacobian(double, double, const double*, const double*, double*) override { return false; }
};

/// All that a method may ask for, of a system that tells its positions.
template <class Positioned>
Problem problem(Positioned& system, ResidualSystem* residual = nullptr) {
  return {system, &system, residual};
}

/// The smooth system as F(t, y, y') = y' - f(t, y).
class SmoothResidual final : public PlainResidual {
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
class Pendulum final : public PlainSystem, public FirstArePositions<2> {
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

/// The pendulum above in the stabilised index-2 form of Gear, Gupta and Leimkuhler:
/// q' = v - q mu, v' = -q lambda - g, q.q = 1, q.v = 0.
class PendulumResidual final : public PlainResidual {
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
class AnglePendulum final : public PlainSystem, public FirstArePositions<1> {
 public:
  std::size_t size() const override { return 2; }
  void derivative(double, const double* y, double* ydot) override {
    ydot[0] = y[1];
    ydot[1] = -std::sin(y[0]);
  }
};

/// Methods that `wanted` accepts, in the order of the list.
template <class Wanted>
std::vector<IntegratorProperties> methods(Wanted&& wanted) {
  std::vector<IntegratorProperties> found = integrators();
  std::erase_if(found, [&](const IntegratorProperties& method) { return !wanted(method); });
  return found;
}
/// Methods that step the System by formulas of our own, of one step.
inline bool is_own(const IntegratorProperties& method) { return !method.restarts; }
inline bool takes_explicit_form(const IntegratorProperties& method) { return !method.residual_form; }
/// With one order at all steps.
inline bool has_one_order(const IntegratorProperties& method) { return method.lowest_order == method.order; }
inline bool is_adaptive(const IntegratorProperties& method) { return method.is_adaptive(); }

/// What the default fixed steps of the methods of low order leave where others keep to 1e-4.
inline double allowance(const IntegratorProperties& method) {
  if (method.is_adaptive() || method.order > 2) return 1e-4;
  return method.order == 1 ? 2e-2 : 2e-3;
}

inline IntegratorOptions with_tolerance(const std::string& name, double tolerance) {
  IntegratorOptions options;
  options.name = name;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = {tolerance};
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
