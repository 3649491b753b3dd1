#pragma once

#include <memory>
#include <stdexcept>
#include <utility>

#include "bindings.hpp"
#include "seacrane/run/simulation.hpp"
#include "turns.hpp"
#include "vector_state.hpp"
#include "without_gil.hpp"

/// A simulation that threads may share: one at a time is inside. A run in progress lets the others in every
/// 20 ms, between two steps.
class SharedSimulation {
 public:
  SharedSimulation(std::shared_ptr<const seacrane::Model> model, const seacrane::State& start,
                   seacrane::RunOptions options)
      : simulation_(std::move(model), start, std::move(options)) {}

  bool advance(double t_end, const py::object& progress) {
    return while_advancing([&](seacrane::Simulation& simulation) {
      const WithoutGil released;
      clear_vector_state();
      return simulation.advance(t_end, [&](double time) {
        if (WithoutGil::should_return()) return false;
        return between_steps([&] { return ask_python(time, progress); });
      });
    });
  }

  /// Calls f(simulation), in whose course it may be advanced.
  template <class Function>
  bool while_advancing(const Function& function) {
    const Turn turn(turns_);
    if (advancing_) {
      throw std::domain_error(
          "run: is advanced already, by another thread or by whom it calls; give each thread a run of its "
          "own");
    }
    const Advancing mark(advancing_);
    return function(simulation_);
  }

  /// Lets others in, calls f(), and waits for its turn.
  template <class Function>
  bool between_steps(const Function& function) {
    const Turns::Pause pause(turns_);
    return function();
  }

  static bool ask_python(double time, const py::object& progress);

  template <class Function>
  auto alone(const Function& function) {
    const Turn turn(turns_);
    return function(simulation_);
  }

  void enter() { turns_.take(); }
  void leave() { turns_.give(); }

 private:
  struct Turn {
    explicit Turn(Turns& all) : turns(all) { turns.take(); }
    ~Turn() { turns.give(); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    Turns& turns;
  };
  struct Advancing {
    explicit Advancing(bool& mark) : flag(mark) { flag = true; }
    ~Advancing() { flag = false; }
    Advancing(const Advancing&) = delete;
    Advancing& operator=(const Advancing&) = delete;
    bool& flag;
  };

  Turns turns_;
  bool advancing_ = false;
  seacrane::Simulation simulation_;
};
