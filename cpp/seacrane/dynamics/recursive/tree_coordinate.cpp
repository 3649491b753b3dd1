#include "seacrane/dynamics/recursive/tree_coordinate.hpp"

#include "seacrane/elements/joints/joint_kinds.hpp"

namespace seacrane {

std::optional<TreeCoordinate> find_coordinate(const CoordinateData& coordinate, const BodyTree& tree) {
  static const std::size_t revolute = find_joint_kind("revolute")->index,
                           prismatic = find_joint_kind("prismatic")->index;
  const int element = coordinate.joint.element;
  const bool angle = coordinate.kind == CoordinateKind::angle,
             way = coordinate.kind == CoordinateKind::displacement;
  for (std::size_t i = 0; i < tree.clusters.size(); ++i) {
    const Cluster& c = tree.clusters[i];
    if (c.element == element && ((angle && c.kind == revolute) || (way && c.kind == prismatic))) {
      return TreeCoordinate{i, c.q, c.u, -1, c.parent == coordinate.joint.first ? 1.0 : -1.0};
    }
    for (int s = c.first_strut; way && s < c.first_strut + c.struts; ++s) {
      const Strut& strut = tree.struts[idx(s)];
      if (strut.element == element) return TreeCoordinate{i, c.q, c.u, s, strut.slides_up ? 1.0 : -1.0};
    }
  }
  return std::nullopt;
}

}  // namespace seacrane
