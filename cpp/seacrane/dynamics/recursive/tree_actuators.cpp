#include "seacrane/dynamics/recursive/tree_actuators.hpp"

#include <optional>

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

TreeActuators::TreeActuators(const Model& model, const BodyTree& tree) {
  for (const auto& list : model.loads.lists) {
    Held<LoadList> left(list->empty());
    for (std::size_t i = 0; i < list->size(); ++i) {
      const CoordinateData* const along = list->coordinate(i);
      const std::optional<Place> place = along ? place_of(*along, tree) : std::nullopt;
      if (place) {
        along_.push_back({&*list, i, place->q, place->u, place->strut, place->sign});
      } else {
        left->take(*list, i);
      }
    }
    if (left->size() > 0) others_.lists.push_back(std::move(left));
  }
}

}  // namespace seacrane
