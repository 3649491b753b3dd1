#include "seacrane/dynamics/recursive/tree_actuators.hpp"

#include <optional>
#include <utility>

#include "seacrane/elements/joints/joint_kinds.hpp"

namespace seacrane {
namespace {

struct Place {
  int q, u, strut;
  double sign;
};

/// Where a tree has the coordinate, if it has.
std::optional<Place> place_of(const CoordinateData& c, const BodyTree& tree) {
  static const std::size_t revolute = find_joint_kind("revolute")->index,
                           prismatic = find_joint_kind("prismatic")->index;
  const bool angle = c.kind == CoordinateKind::angle, way = c.kind == CoordinateKind::displacement;
  for (const Cluster& cluster : tree.clusters) {
    if (cluster.element == c.joint.element &&
        ((angle && cluster.kind == revolute) || (way && cluster.kind == prismatic))) {
      return Place{cluster.q, cluster.u, -1, cluster.parent == c.joint.first ? 1.0 : -1.0};
    }
    for (int i = cluster.first_strut; way && i < cluster.first_strut + cluster.struts; ++i) {
      const Strut& strut = tree.struts[idx(i)];
      if (strut.element == c.joint.element) {
        return Place{cluster.q, cluster.u, i, strut.slides_up ? 1.0 : -1.0};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

TreeActuators::TreeActuators(const Model& model, const BodyTree& tree) : others_(*model.loads) {
  auto& left = std::get<std::vector<Actuator>>(others_);
  for (const Actuator& actuator : std::exchange(left, {})) {
    if (const std::optional<Place> place = place_of(actuator.coordinate, tree)) {
      actuated_.push_back({actuator, place->q, place->u, place->strut, place->sign});
    } else {
      left.push_back(actuator);
    }
  }
}

}  // namespace seacrane
