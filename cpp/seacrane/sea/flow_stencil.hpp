#pragma once

#include <cstddef>
#include <limits>
#include <string>

namespace seacrane {

/// What an element asks for, fixed when the scene is compiled.
struct FlowStencil {
  std::string name;       // the element's own, such as "part 'frame'"
  std::size_t count = 1;  // of points
  /// Components that a point hardly feels at its depth are left out: what is lost is at most this share of
  /// SeaField::magnitude(), in each number. Coefficients of drag and inertia are known to some 20 %.
  double cut = 1e-5;
  /// Whether the element asks for the surface over it also where waves hardly reach; of one point alone.
  bool surface = true;
  double waves = 1.0;  // times those of the sea: what a hull beside makes of them
  /// No part of an element is farther from the middle of the points, m; infinity: not known.
  double reach = std::numeric_limits<double>::infinity();
  double width = 0.0;  // longest extent of an element, m

  /// Whether it may leave out a surface that it is far below.
  bool sinks() const { return !surface && count == 1 && waves == 1.0; }
  bool operator==(const FlowStencil&) const = default;
};

}  // namespace seacrane
