// seacrane's own explicit integrators on Pinocchio's accelerations: the same
// step size control and dense output. Prints the best CPU time, the counters,
// and the payload's position and the roll at every second. pinocchio_run TREE
// METHOD(rk4|dopri5|tsit5|verner65|verner76|dop853) SETTING(step s, or rtol)
// BAUMGARTE(1/s) REPEATS
#include <ctime>
#include <exception>

#include "pinocchio_steps.hpp"

int main(int count, char **arguments) try {
  if (count != 6)
    throw std::runtime_error("needs TREE METHOD SETTING BAUMGARTE REPEATS");
  const TreeData tree(arguments[1]);
  PinocchioDynamics dynamics(tree, std::stod(arguments[4]));
  double best = 1e300;
  Rows rows;
  seacrane::Counters work;
  for (int repeat = 0; repeat < std::stoi(arguments[5]); ++repeat) {
    const std::clock_t begin = std::clock();
    work = step(dynamics, arguments[2], std::stod(arguments[3]), rows);
    best = std::fmin(best, double(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::printf("%.9g %ld %ld %ld\n", best, work.evaluations, work.steps,
              work.rejected_steps);
  print(rows);
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s: %s\n", arguments[0], error.what());
  return 1;
}
