#pragma once

#include <cstdio>
#include <memory>
#include <span>

#include "pinocchio_dynamics.hpp"
#include "seacrane/integrate/registration.hpp"

namespace seacrane {
extern const Registration rk4;
std::span<const Registration> explicit_pairs();
} // namespace seacrane

constexpr int seconds = 100; // one output each

using Rows = std::vector<std::array<double, 4>>; // payload's position, roll

struct Accelerations final : seacrane::System {
  PinocchioDynamics &dynamics;
  explicit Accelerations(PinocchioDynamics &d) : dynamics(d) {}
  std::size_t size() const override { return 2 * coordinates; }
  void derivative(double t, const double *y, double *rate) override {
    dynamics(t, y, rate);
  }
  bool has_projection() const override { return false; }
  bool project(double, double *, bool) override { return false; }
  bool jacobian(double, const double *, double *) override { return false; }
};

/// Error scales as in seacrane: 0.1 m, 0.01 rad, and the same per second.
inline std::vector<double> tolerances(double rtol) {
  std::vector<double> out(2 * coordinates, 0.01 * rtol);
  for (int i : {int(surge), int(sway), int(heave), int(main_stroke),
                int(knuckle_stroke)})
    out[i] = out[coordinates + i] = 0.1 * rtol;
  return out;
}

inline std::unique_ptr<seacrane::Integrator> integrator(const std::string &method,
                                                 double setting,
                                                 seacrane::System &system) {
  using namespace seacrane;
  IntegratorOptions options;
  if (method == "rk4") {
    options.fixed_step = setting;
    return rk4.make({system}, options);
  }
  options.relative_tolerance = 0.0;
  options.absolute_tolerance = tolerances(setting);
  for (const Registration &pair : explicit_pairs()) {
    if (method == pair.properties->name)
      return pair.make({system}, options);
  }
  throw std::runtime_error("unknown method " + method);
}

/// A run from rest: rows are filled at every second.
inline seacrane::Counters step(PinocchioDynamics &dynamics,
                               const std::string &name, double setting,
                               Rows &rows) {
  Accelerations system(dynamics);
  const auto method = integrator(name, setting, system);
  std::vector<double> y(2 * coordinates, 0.0);
  rows.resize(seconds + 1);
  method->init(0.0, y.data());
  for (int second = 0; second <= seconds; ++second) {
    while (method->time() < second)
      method->step(seconds);
    method->interpolate(second, y.data());
    const auto p = dynamics.payload(y);
    rows[second] = {p[0], p[1], p[2], y[roll]};
  }
  return method->counters();
}

inline void print(const Rows &rows) {
  for (const auto &row : rows)
    std::printf("%.17g %.17g %.17g %.17g\n", row[0], row[1], row[2], row[3]);
}
