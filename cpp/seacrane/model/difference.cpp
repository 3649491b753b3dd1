#include "seacrane/model/difference.hpp"

#include <algorithm>
#include <variant>
#include <vector>

#include "seacrane/elements/difference.hpp"

namespace seacrane {

static bool same(const StateSpaceBlock& one, const StateSpaceBlock& other) {
  return one.inputs == other.inputs && one.outputs == other.outputs && same(one.a, other.a) &&
         same(one.b, other.b) && same(one.c, other.c) && same(one.d, other.d) &&
         same(one.state_scale, other.state_scale);
}
static bool same(const RetardationFunctions& one, const RetardationFunctions& other) {
  const auto alike = [](const Mat6d& a, const Mat6d& b) { return a == b; };
  return one.step == other.step &&
         std::equal(one.kernel.begin(), one.kernel.end(), other.kernel.begin(), other.kernel.end(), alike);
}
template <class... V>
static bool same(const std::variant<V...>& one, const std::variant<V...>& other) {
  if (one.index() != other.index()) return false;
  return std::visit([&]<class Held>(const Held& held) { return same(held, std::get<Held>(other)); }, one);
}

namespace {

std::string difference_of_waves(const Model& one, const Model& other) {
  const std::vector<WaveLoad>&a = one.stepped().wave_loads, &b = other.stepped().wave_loads;
  if (a.size() != b.size()) return "the vessels that waves load";
  for (std::size_t i = 0; i < a.size(); ++i) {
    const WaveLoadDescription &here = a[i].sources, &there = b[i].sources;
    if (here.body != there.body || a[i].body != b[i].body || a[i].vessel != b[i].vessel) {
      return "the vessels that waves load";
    }
    if (here.has_drift() != there.has_drift()) return "the slow drift of '" + here.body + "'";
    if ((here.table != nullptr) != (there.table != nullptr) ||
        (here.positioned != nullptr) != (there.positioned != nullptr)) {
      return "how waves load '" + here.body + "'";
    }
  }
  return "";
}

std::string difference_of_scenes(const SceneDescription& one, const SceneDescription& other) {
  if (one.gravity != other.gravity) return "gravity";
  if (one.orientation != other.orientation) return "orientation";
  if (one.baumgarte != other.baumgarte) return "baumgarte";
  if (one.length_scale != other.length_scale) return "length_scale";
  std::string out = difference("body", one.bodies, other.bodies);
  if (out.empty()) out = difference("joint", one.joints, other.joints);
  if (out.empty()) out = difference("driver", one.drivers, other.drivers);
  for (std::size_t i = 0; i < one.loads.lists.size() && out.empty(); ++i) {
    out = one.loads.lists[i]->difference(*other.loads.lists[i]);
  }
  if (out.empty()) out = difference("vessel", one.vessels, other.vessels);
  if (out.empty()) out = difference("limit", one.limits, other.limits);
  return out;
}

}  // namespace

std::string difference(const Model& one, const Model& other) {
  const std::string described = difference_of_scenes(one.description, other.description);
  if (!described.empty()) return described;
  if (one.merges != other.merges) return "whether bodies are merged";
  if (one.closed != other.closed) return "the limits that hold";
  return difference_of_waves(one, other);
}

}  // namespace seacrane
