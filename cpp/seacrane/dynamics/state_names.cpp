#include "seacrane/dynamics/state_names.hpp"

#include "seacrane/model/model.hpp"

namespace seacrane {

std::string describe_state(const Model& model, int component) {
  static const char* axis[] = {"x", "y", "z"};
  const StateLayout& s = model.layout;
  const int i = component;
  if (i < s.velocity) {
    const int k = i % s.pose_size;
    return std::string(k < 3 ? "position " : "orientation ") + (k < 3 ? axis[k] : std::to_string(k - 3)) +
           " of body '" + model.bodies[idx(i / s.pose_size)].name + "'";
  }
  if (i < s.memory) {
    const int k = (i - s.velocity) % 6;
    return std::string(k < 3 ? "velocity " : "angular velocity ") + axis[k % 3] + " of body '" +
           model.bodies[idx((i - s.velocity) / 6)].name + "'";
  }
  return i < s.work ? describe_memory(model, i - s.memory) : "work integral";
}

std::string describe_memory(const Model& model, int state) {
  const int of_load = state - (model.layout.loads - model.layout.memory);
  if (of_load >= 0) return "state '" + model.load_states[idx(of_load)].name + "'";
  for (std::size_t v = 0; v < model.vessels.size(); ++v) {
    const Vessel& vessel = model.vessels[v];
    const int own = state - (vessel.memory_offset - model.layout.memory);
    if (own < 0 || own >= vessel.memory_states()) continue;
    const std::string of = " of vessel '" + model.description.vessels[v].name + "'";
    const int fluid = vessel.fluid_states();
    if (own >= fluid) return "state " + std::to_string(own - fluid) + " of the fast motion" + of;
    return "memory state " + std::to_string(own) + of;
  }
  for (std::size_t g = 0; g < model.groups.size(); ++g) {
    const int own = state - (model.groups[g].memory_offset - model.layout.memory);
    if (own < 0 || own >= model.groups[g].memory.states()) continue;
    return "memory state " + std::to_string(own) + " of group '" + model.description.groups[g].name + "'";
  }
  return "memory state " + std::to_string(state);
}

}  // namespace seacrane
