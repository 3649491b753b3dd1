#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "seacrane/compile/compile.hpp"
#include "seacrane/elements/loads/function_force.hpp"
#include "seacrane/run/simulation.hpp"

namespace seacrane::test {

TEST_CASE("a stop asked for in the very last step of an advance is told") {
  SceneDescription scene;
  BodyDescription bob;
  bob.name = "bob";
  bob.mass = 1.0;
  bob.inertia = Mat3d::Identity();
  scene.bodies.push_back(bob);
  // Slow enough that the one step of the advance is also where the caller is asked.
  const ForceFunction slow = [](double, const double*, const double*, double*) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  };
  scene.loads.of<FunctionForce>().push_back({"slow", "bob", slow, {}});
  const auto model = compile(scene);
  RunOptions options;
  options.integrator = "rk4";
  options.fixed_step = 0.01;
  options.output_times = {0.0, 0.01};
  Simulation run(model, initial_state(*model), options);
  CHECK(!run.advance(0.01, [](double) { return false; }));
}

}  // namespace seacrane::test
