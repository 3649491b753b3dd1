#pragma once

#include <cstddef>
#include <optional>

#include "seacrane/dynamics/recursive/body_tree.hpp"
#include "seacrane/elements/joint_coordinate.hpp"

namespace seacrane {

/// A joint coordinate that is one of a tree: the angle of a hinge, the way of a slide, the stroke of a strut.
struct TreeCoordinate {
  std::size_t cluster = 0;
  int q = 0, u = 0;
  int strut = -1;     // -1: the coordinate is that of the joint itself
  double sign = 1.0;  // of the joint's coordinate over the tree's
};

/// Where a tree has the coordinate, if it has.
std::optional<TreeCoordinate> find_coordinate(const CoordinateData& coordinate, const BodyTree& tree);

}  // namespace seacrane
