#include <doctest/doctest.h>

#include <thread>

#include "multibody_scenes.hpp"
#include "seacrane/compile/compile.hpp"
#include "seacrane/run/simulation.hpp"

namespace seacrane::test {
namespace {

constexpr int kThreads = 4;

SceneDescription convolved_hull() {
  SceneDescription scene = slider_crank("hull");
  make_vessel(scene, "hull");
  RetardationFunctions kernel{0.05, {}};
  for (int i = 0; i < 40; ++i) kernel.kernel.push_back(0.1 * std::exp(-0.1 * i) * Mat6d::Identity());
  scene.vessels.front().memory = kernel;
  return scene;
}

/// Everything a run leaves: its rows, and the state it ends in.
struct ThreadRun {
  std::vector<double> rows, state;
  bool operator==(const ThreadRun&) const = default;
};

ThreadRun run(const std::shared_ptr<const Model>& model, const std::string& formulation,
              const std::string& integrator) {
  RunOptions options;
  options.formulation = formulation;
  options.integrator = integrator;
  options.scaled_tolerance = 1e-4;
  options.fixed_step = 0.01;
  for (int i = 0; i <= 40; ++i) options.output_times.push_back(0.02 * i);
  for (const auto& name : channel_names(*model, false)) options.channels.insert(name);
  Simulation simulation(model, initial_state(*model), options);
  simulation.advance(0.8, [](double) { return true; });
  return {simulation.recording().rows(), simulation.state().values};
}

}  // namespace

TEST_CASE("threads that share one model find what a run alone finds, bit for bit") {
  for (const SceneDescription& scene : {slider_crank(), at_sea(true), at_sea(false), convolved_hull()}) {
    const auto model = compile(scene);
    for (const std::string integrator :
         {"dopri5", "rk4", "rosenbrock", "generalized-alpha", "cvode-bdf", "ida"}) {
      CAPTURE(integrator);
      const bool residual_form = integrator == "ida" || integrator == "generalized-alpha";
      for (const std::string formulation : {"redundant", "recursive"}) {
        if (residual_form && formulation == "recursive") continue;
        CAPTURE(formulation);
        std::vector<ThreadRun> found(kThreads);
        std::vector<std::thread> threads;
        for (ThreadRun& out : found) {
          threads.emplace_back([&] { out = run(model, formulation, integrator); });
        }
        for (std::thread& thread : threads) thread.join();
        const ThreadRun alone = run(model, formulation, integrator);
        CHECK(alone.rows.size() > 41);
        for (const ThreadRun& out : found) CHECK(out == alone);
      }
    }
  }
}

TEST_CASE("threads may compile one description at the same time") {
  const SceneDescription scene = at_sea(false);
  std::vector<std::vector<double>> found(kThreads);
  std::vector<std::thread> threads;
  for (auto& out : found) threads.emplace_back([&] { out = compile(scene)->initial_state; });
  for (std::thread& thread : threads) thread.join();
  for (const auto& out : found) CHECK(out == compile(scene)->initial_state);
}

}  // namespace seacrane::test
