#include "seacrane/run/record_history.hpp"

#include <algorithm>
#include <stdexcept>

namespace seacrane {

std::vector<std::string> state_parts(const Model& model) {
  std::vector<std::string> out;
  for (const BodyModel& body : model.bodies) out.push_back("body '" + body.name + "'");
  out.push_back("poses of " + std::to_string(model.layout.pose_size) + " numbers");
  out.push_back("memory of " + std::to_string(model.layout.work - model.layout.memory) + " states");
  out.push_back("inputs of " + std::to_string(model.slot_count) + " numbers");
  return out;
}

void check_state_parts(const Model& model, const std::vector<std::string>& given) {
  const std::vector<std::string> own = state_parts(model);
  const auto [here, there] = std::mismatch(own.begin(), own.end(), given.begin(), given.end());
  if (here == own.end() && there == given.end()) return;
  const auto text = [](auto at, auto end) { return at == end ? std::string("nothing more") : *at; };
  throw std::invalid_argument("state: is that of another scene: it holds " + text(there, given.end()) +
                              " where this scene has " + text(here, own.end()) +
                              "; give a state of this scene");
}

}  // namespace seacrane
