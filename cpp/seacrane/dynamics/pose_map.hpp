#pragma once

#include <vector>

#include "seacrane/integrate/position_map.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// Poses of all bodies, moved along their twists (StateLayout).
class PoseMap final : public PositionMap {
 public:
  explicit PoseMap(const Model& model) : model_(model), moved_(idx(model.layout.size)) {}

  std::size_t position_size() const override { return idx(model_.layout.velocity); }
  void move(double h, double* y) override;
  bool move_jacobian(double h, const double* y, double* out) override;

 private:
  const Model& model_;
  std::vector<double> moved_;
};

}  // namespace seacrane
