// A batch of trees on a pool of threads, as of pinocchio_run. Prints the best
// wall and CPU time of stepping all of them, then the rows of each.
// pinocchio_batch THREADS METHOD SETTING BAUMGARTE REPEATS TREE...
#include <atomic>
#include <chrono>
#include <ctime>
#include <exception>
#include <thread>

#include "pinocchio_steps.hpp"

int main(int count, char **arguments) try {
  if (count < 7)
    throw std::runtime_error(
        "needs THREADS METHOD SETTING BAUMGARTE REPEATS TREE...");
  using Clock = std::chrono::steady_clock;
  const std::string method = arguments[2];
  const double setting = std::stod(arguments[3]);
  std::vector<std::unique_ptr<PinocchioDynamics>> batch;
  for (int i = 6; i < count; ++i)
    batch.push_back(std::make_unique<PinocchioDynamics>(
        TreeData(arguments[i]), std::stod(arguments[4])));
  std::vector<Rows> rows(batch.size());
  double wall = 1e300, cpu = 1e300;
  for (int repeat = 0; repeat < std::stoi(arguments[5]); ++repeat) {
    const auto begin = Clock::now();
    const std::clock_t spent = std::clock();
    std::atomic<std::size_t> next = 0;
    {
      std::vector<std::jthread> pool;
      for (int i = 0; i < std::stoi(arguments[1]); ++i)
        pool.emplace_back([&] {
          for (std::size_t at = next++; at < batch.size(); at = next++)
            step(*batch[at], method, setting, rows[at]);
        });
    }
    cpu = std::fmin(cpu, double(std::clock() - spent) / CLOCKS_PER_SEC);
    wall = std::fmin(
        wall, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  std::printf("%.9g %.9g\n", wall, cpu);
  for (const Rows &one : rows)
    print(one);
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s: %s\n", arguments[0], error.what());
  return 1;
}
