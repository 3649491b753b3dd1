// Explicit Runge-Kutta methods on Pinocchio's accelerations. Prints the best
// CPU time, the counters, and the payload's position and the roll at every
// second. pinocchio_run TREE METHOD(rk4|dopri5|tsit5|verner65|verner76)
// SETTING(step s, or rtol) BAUMGARTE(1/s) REPEATS
#include <cstdio>
#include <ctime>
#include <exception>

#include "explicit_pair.hpp"
#include "pinocchio_dynamics.hpp"
#include "seacrane/integrate/tableaus/dormand_prince54.hpp"
#include "seacrane/integrate/tableaus/tsitouras54.hpp"
#include "seacrane/integrate/tableaus/verner65.hpp"
#include "seacrane/integrate/tableaus/verner76.hpp"

namespace {

namespace tableaus = seacrane::tableaus;
constexpr int seconds = 100; // one output each

/// Error scales as in seacrane: 0.1 m, 0.01 rad, and the same per second.
std::vector<double> error_scales() {
  std::vector<double> scale(2 * coordinates, 0.01);
  for (int i : {int(surge), int(sway), int(heave), int(main_stroke),
                int(knuckle_stroke)}) {
    scale[i] = scale[coordinates + i] = 0.1;
  }
  return scale;
}

struct Run {
  PinocchioDynamics &dynamics;
  double setting;
  Work work;
  std::vector<std::array<double, 4>> rows;

  template <class Advance> double march(Advance &&advance) {
    std::vector<double> y(2 * coordinates, 0.0);
    const std::clock_t begin = std::clock();
    for (int second = 0; second <= seconds; ++second) {
      if (second > 0)
        advance(y, double(second - 1), double(second));
      const auto p = dynamics.payload(y);
      rows.push_back({p[0], p[1], p[2], y[roll]});
    }
    return double(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  template <class Tableau> double pair() {
    ExplicitPair<Tableau> stepper(error_scales(), setting);
    return march([&](auto &y, double t, double t1) {
      stepper.advance(dynamics, y, t, t1, work);
    });
  }

  double run(const std::string &method) {
    if (method == "rk4") {
      return march([&](auto &y, double t, double t1) {
        rk4(dynamics, y, t, t1, setting, work);
      });
    }
    if (method == "dopri5")
      return pair<tableaus::DormandPrince54>();
    if (method == "tsit5")
      return pair<tableaus::Tsitouras54>();
    if (method == "verner65")
      return pair<tableaus::Verner65>();
    if (method == "verner76")
      return pair<tableaus::Verner76>();
    throw std::runtime_error("unknown method " + method);
  }
};

} // namespace

int main(int count, char **arguments) try {
  if (count != 6)
    throw std::runtime_error("needs TREE METHOD SETTING BAUMGARTE REPEATS");
  const TreeData tree(arguments[1]);
  PinocchioDynamics dynamics(tree, std::stod(arguments[4]));
  double best = 1e300;
  Run run{dynamics, std::stod(arguments[3]), {}, {}};
  for (int repeat = 0; repeat < std::stoi(arguments[5]); ++repeat) {
    run.work = {};
    run.rows.clear();
    best = std::fmin(best, run.run(arguments[2]));
  }
  std::printf("%.9g %ld %ld %ld\n", best, run.work.evaluations, run.work.steps,
              run.work.rejected);
  for (const auto &row : run.rows)
    std::printf("%.17g %.17g %.17g %.17g\n", row[0], row[1], row[2], row[3]);
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s: %s\n", arguments[0], error.what());
  return 1;
}
