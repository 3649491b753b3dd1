// seacrane's own explicit integrators on Pinocchio's accelerations: the same
// step size control and dense output. Prints the best CPU time, the counters,
// and the payload's position and the roll at every second. pinocchio_run TREE
// METHOD(rk4|dopri5|tsit5|verner65|verner76|dop853) SETTING(step s, or rtol)
// BAUMGARTE(1/s) REPEATS
#include <cstdio>
#include <ctime>
#include <exception>
#include <memory>
#include <span>

#include "pinocchio_dynamics.hpp"
#include "seacrane/integrate/registration.hpp"

namespace seacrane {
extern const Registration rk4;
std::span<const Registration> explicit_pairs();
} // namespace seacrane

namespace {

constexpr int seconds = 100; // one output each

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
std::vector<double> tolerances(double rtol) {
  std::vector<double> out(2 * coordinates, 0.01 * rtol);
  for (int i : {int(surge), int(sway), int(heave), int(main_stroke),
                int(knuckle_stroke)})
    out[i] = out[coordinates + i] = 0.1 * rtol;
  return out;
}

std::unique_ptr<seacrane::Integrator> integrator(const std::string &method,
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

} // namespace

int main(int count, char **arguments) try {
  if (count != 6)
    throw std::runtime_error("needs TREE METHOD SETTING BAUMGARTE REPEATS");
  const TreeData tree(arguments[1]);
  PinocchioDynamics dynamics(tree, std::stod(arguments[4]));
  Accelerations system(dynamics);
  double best = 1e300;
  std::vector<std::array<double, 4>> rows(seconds + 1);
  seacrane::Counters work;
  for (int repeat = 0; repeat < std::stoi(arguments[5]); ++repeat) {
    const auto method =
        integrator(arguments[2], std::stod(arguments[3]), system);
    std::vector<double> y(2 * coordinates, 0.0);
    const std::clock_t begin = std::clock();
    method->init(0.0, y.data());
    for (int second = 0; second <= seconds; ++second) {
      while (method->time() < second)
        method->step(seconds);
      method->interpolate(second, y.data());
      const auto p = dynamics.payload(y);
      rows[second] = {p[0], p[1], p[2], y[roll]};
    }
    best = std::fmin(best, double(std::clock() - begin) / CLOCKS_PER_SEC);
    work = method->counters();
  }
  std::printf("%.9g %ld %ld %ld\n", best, work.evaluations, work.steps,
              work.rejected_steps);
  for (const auto &row : rows)
    std::printf("%.17g %.17g %.17g %.17g\n", row[0], row[1], row[2], row[3]);
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s: %s\n", arguments[0], error.what());
  return 1;
}
