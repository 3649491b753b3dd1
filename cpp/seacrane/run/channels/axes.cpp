#include <map>
#include <utility>

#include "seacrane/elements/joints/distance.hpp"
#include "seacrane/elements/loads/actuator.hpp"
#include "seacrane/run/channels/channel.hpp"
#include "seacrane/run/channels/of_loads.hpp"

namespace seacrane {
namespace {

std::vector<std::string> coordinate_names(const Model& m) {
  std::vector<std::string> out;
  for (const RecordedCoordinate& c : m.description.coordinates) {
    out.push_back(c.name.empty() ? c.joint : c.name);
  }
  return out;
}

std::vector<std::string> link_names(const Model& m) {
  std::vector<std::string> out;
  for (const ElementModel& e : m.elements) {
    if (e.kind == Distance::kind) out.push_back(e.name);
  }
  return out;
}

/// Names of all loads, with their kind in front where loads of several kinds have one name.
std::vector<std::string> load_names(const Model& m) {
  std::vector<std::pair<std::string, std::string>> loads;
  std::map<std::string, int> uses;
  for (const auto& list : m.description.loads.lists) {
    for (const std::string& name : list->names()) {
      loads.emplace_back(list->kind.name, name);
      ++uses[name];
    }
  }
  std::vector<std::string> out;
  for (const auto& [kind, name] : loads) out.push_back(uses[name] == 1 ? name : kind + (" " + name));
  return out;
}

}  // namespace

std::vector<std::string> labels_of(const Axis& axis, const Model& model) {
  return axis.of_scene != nullptr ? axis.of_scene(model) : axis.labels;
}

namespace axes {

const Axis xyz{"axis", {"x", "y", "z"}};
const Axis wxyz{"wxyz", {"w", "x", "y", "z"}};
const Axis motion{"motion", {"surge", "sway", "heave", "roll", "pitch", "yaw"}};

const Axis water{"water",
                 {"elevation", "velocity_x", "velocity_y", "velocity_z", "acceleration_x", "acceleration_y",
                  "acceleration_z", "pressure"}};

const Axis body{"body", {}, [](const Model& m) { return names_of_all(m.bodies); }};
const Axis vessel{"vessel", {}, [](const Model& m) { return names_of_all(m.description.vessels); }, true};
const Axis joint{"joint", {}, [](const Model& m) { return names_of_all(m.description.joints); }};
const Axis joint_coordinate{"joint_coordinate", {}, coordinate_names};
const Axis actuator{"actuator", {}, names_of<Actuator>};
const Axis driver{"driver", {}, [](const Model& m) { return names_of_all(m.description.drivers); }};
const Axis link{"link", {}, link_names};
const Axis limit{"limit", {}, [](const Model& m) { return names_of_all(m.limits); }};
const Axis point{"point", {}, [](const Model& m) { return names_of_all(m.description.points); }};
const Axis load{"load", {}, load_names};

}  // namespace axes
}  // namespace seacrane
