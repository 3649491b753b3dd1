#include "seacrane/run/restart.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "seacrane/elements/check.hpp"

namespace seacrane {
namespace {

const std::string kStatePart = "state '";
constexpr std::size_t kWorkStates = 2;

void check_parts(const Model& model, const std::vector<std::string>& given) {
  const std::vector<std::string> own = state_parts(model);
  const auto [here, there] = std::mismatch(own.begin(), own.end(), given.begin(), given.end());
  if (here == own.end() && there == given.end()) return;
  const auto text = [](auto at, auto end) { return at == end ? std::string("nothing more") : *at; };
  throw std::invalid_argument("state: is that of another scene: it holds " + text(there, given.end()) +
                              " where this scene has " + text(here, own.end()) +
                              "; give a state of this scene");
}

std::vector<double> rate_of(Stepper& at) {
  std::vector<double> out(at.stepped.size());
  at.stepped.derivative(at.integrator->time(), at.integrator->state(), out.data());
  return out;
}

}  // namespace

State initial_state(const Model& model) {
  State out;
  out.values = model.initial_state;
  out.inputs.assign(idx(model.slot_count), 0.0);
  out.closed = names_of(model.limits, model.closed);
  out.parts = state_parts(model);
  return out;
}

std::vector<std::string> state_parts(const Model& model) {
  std::vector<std::string> out;
  for (const BodyModel& body : model.bodies) out.push_back("body '" + body.name + "'");
  out.push_back("poses of " + std::to_string(model.layout.pose_size) + " numbers");
  out.push_back("memory of " + std::to_string(model.layout.loads - model.layout.memory) + " states");
  for (const LoadState& state : model.load_states) out.push_back(kStatePart + state.name + "'");
  out.push_back("inputs of " + std::to_string(model.slot_count) + " numbers");
  return out;
}

LoadStates load_states(const State& state) {
  LoadStates out;
  for (const std::string& part : state.parts) {
    if (!part.starts_with(kStatePart)) continue;
    out.names.push_back(part.substr(kStatePart.size(), part.size() - kStatePart.size() - 1));
  }
  const std::size_t behind = out.names.size() + kWorkStates;
  out.first = state.values.size() >= behind ? state.values.size() - behind : 0;
  return out;
}

const State& checked_state(const Model& model, const State& state) {
  if (!state.parts.empty()) check_parts(model, state.parts);
  if (state.values.size() != idx(model.layout.size)) {
    throw std::invalid_argument("state: has " + std::to_string(state.values.size()) +
                                " values, the model needs " + std::to_string(model.layout.size));
  }
  for (const double v : state.values) {
    if (!std::isfinite(v)) throw std::invalid_argument("state: holds a value that is not finite");
  }
  return state;
}

ClosedSet closed_limits(const Model& model, const State& state) {
  return state.closed ? set_of(model.limits, *state.closed) : model.closed;
}

StepHistory save_steps(Stepper& at, const std::string& integrator) {
  return {at.stepped.name(), integrator, at.integrator->save(), rate_of(at), std::nullopt};
}

bool load_steps(Stepper& at, const std::string& integrator, const State& start) {
  const StepHistory& history = start.steps;
  if (history.formulation != at.stepped.name() || history.integrator != integrator) return false;
  std::vector<double> state(at.stepped.size()), bodies(start.values.size());
  at.read_bodies(start.time, start.values.data(), state.data());
  at.integrator->init(start.time, state.data());
  if (at.integrator->save().size() != history.values.size()) return false;
  at.integrator->load(history.values);
  at.write_bodies(at.integrator->time(), at.integrator->state(), bodies.data());
  return at.integrator->time() == start.time && bodies == start.values && rate_of(at) == history.rate;
}

}  // namespace seacrane
