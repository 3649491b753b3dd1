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

/// What moors a vessel holds it where it is described, which is no part of what bodies are compared by.
std::string difference_of_rest(const Model& one, const Model& other) {
  for (std::size_t v = 0; v < one.vessels.size(); ++v) {
    const Vessel &here = one.vessels[v], &there = other.vessels[v];
    if (here.mean_position == there.mean_position && here.mean_yaw == there.mean_yaw) continue;
    return "where vessel '" + one.description.vessels[v].name + "' is at rest";
  }
  return "";
}

std::string difference_of_scenes(const SceneDescription& one, const SceneDescription& other) {
  if (one.gravity != other.gravity) return "gravity";
  if (one.orientation != other.orientation) return "orientation";
  if (one.baumgarte != other.baumgarte) return "baumgarte";
  if (one.length_scale != other.length_scale) return "length_scale";
  std::string out = difference("joint", one.joints, other.joints);
  if (out.empty()) out = difference("driver", one.drivers, other.drivers);
  for (std::size_t i = 0; i < one.loads.lists.size() && out.empty(); ++i) {
    if (one.loads.lists[i]->names() != other.loads.lists[i]->names()) {
      out = one.loads.lists[i]->difference(*other.loads.lists[i]);
    }
  }
  if (out.empty()) out = difference("vessel", one.vessels, other.vessels);
  if (out.empty()) out = difference("group", one.groups, other.groups);
  if (out.empty()) out = difference("limit", one.limits, other.limits);
  return out;
}

/// Of what is stepped: a hull is the same body in all lanes, and others have only masses of their own.
std::string difference_of_bodies(const Model& one, const Model& other) {
  for (std::size_t b = 0; b < std::min(one.bodies.size(), other.bodies.size()); ++b) {
    const BodyModel &here = one.bodies[b], &there = other.bodies[b];
    const std::string what = "body '" + here.name + "'";
    if (here.name != there.name || (here.vessel < 0) != (there.vessel < 0)) return what;
    if (here.center_of_mass != there.center_of_mass) return what + " (center_of_mass)";
    if (here.vessel >= 0 && (here.mass != there.mass || here.inertia != there.inertia)) {
      return what + " (mass or inertia), which has hydrodynamics";
    }
  }
  const auto weighs = [](const Gravity& a, const Gravity& b) { return a.body == b.body; };
  if (!std::ranges::equal(one.gravity, other.gravity, weighs)) return "the bodies that weigh";
  return one.bodies.size() == other.bodies.size() ? "" : "the bodies that are merged";
}

/// Of what is stepped: as many loads on the same bodies and coordinates, with the same states and inputs.
std::string difference_of_loads(const Model& one, const Model& other) {
  const auto state = [](const LoadState& a, const LoadState& b) { return a.name == b.name; };
  if (!std::ranges::equal(one.load_states, other.load_states, state)) return "the states of loads";
  if (one.slot_count != other.slot_count) return "the inputs of loads";
  if (one.inertial_tensions != other.inertial_tensions) return "the lines whose stretch is quasi-static";
  if (one.loads.lists.size() != other.loads.lists.size()) return "the loads that act";
  for (std::size_t l = 0; l < one.loads.lists.size(); ++l) {
    const LoadList &here = *one.loads.lists[l], &there = *other.loads.lists[l];
    if (&here.kind != &there.kind || here.names != there.names) return "the loads that act";
    for (std::size_t i = 0; i < here.size(); ++i) {
      const CoordinateData *const a = here.coordinate(i), *const b = there.coordinate(i);
      const bool along =
          a != nullptr && b != nullptr && (a->joint.element != b->joint.element || a->kind != b->kind);
      if (here.bodies[i] != there.bodies[i] || (a == nullptr) != (b == nullptr) || along) {
        return std::string("what ") + here.kind.name + " '" + here.names[i] + "' acts on";
      }
    }
  }
  return "";
}

/// A mass within a merged body moves its centre, from which points are counted.
std::string difference_of_geometry(const Model& one, const Model& other) {
  for (std::size_t kind = 0; kind < one.joints.size(); ++kind) {
    for (std::size_t i = 0; i < std::min(one.joints[kind].size(), other.joints[kind].size()); ++i) {
      const JointData &here = one.joints[kind][i], &there = other.joints[kind][i];
      const std::string what =
          "where joint '" + one.elements[idx(here.element)].name + "' stands on its bodies";
      if (here.first != there.first || here.second != there.second || here.first_point != there.first_point ||
          here.second_point != there.second_point || here.first_axes != there.first_axes ||
          here.second_axes != there.second_axes) {
        return what;
      }
    }
    if (one.joints[kind].size() != other.joints[kind].size()) return "the bodies that are merged";
  }
  return "";
}

}  // namespace

std::string difference(const Model& one, const Model& other) {
  std::string out = difference_of_scenes(one.description, other.description);
  if (!out.empty()) return out;
  if (one.merges != other.merges) return "whether bodies are merged";
  out = difference_of_rest(one, other);
  if (!out.empty()) return out;
  if (one.closed != other.closed) return "the limits that hold";
  out = difference_of_bodies(one.stepped(), other.stepped());
  if (out.empty()) out = difference_of_geometry(one.stepped(), other.stepped());
  if (out.empty()) out = difference_of_loads(one.stepped(), other.stepped());
  return out.empty() ? difference_of_waves(one, other) : out;
}

bool loads_differ(const Model& one, const Model& other, const LoadKind& kind) {
  const SceneDescription &here = one.description, &there = other.description;
  if (!difference("body", here.bodies, there.bodies).empty()) return true;
  for (std::size_t i = 0; i < here.loads.lists.size(); ++i) {
    if (&here.loads.lists[i]->kind != &kind) continue;
    return !here.loads.lists[i]->difference(*there.loads.lists[i]).empty();
  }
  return false;
}

}  // namespace seacrane
