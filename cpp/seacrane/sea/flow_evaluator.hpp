#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "seacrane/sea/flow_kernel.hpp"
#include "seacrane/sea/flow_stencil.hpp"
#include "seacrane/sea/sea_field.hpp"

namespace seacrane {

/// One point of a cloud.
struct FlowPoint {
  Vec3d position = Vec3d::Zero();  // m, inertial frame
  Mat3d extents = Mat3d::Zero();   // m, inertial frame: of its element along three axes, in columns; 0: none
  double height =
      0.0;  // m, of its element, over what of which is wet the flow is averaged; the point its middle

  bool operator==(const FlowPoint& other) const {
    return position == other.position && extents == other.extents && height == other.height;
  }
};

/// The sea at a stencil of points, and its scratch; one for each run. Without a field the water is still and
/// at rest. Results depend on the arguments alone, whatever was evaluated before.
class FlowEvaluator {
 public:
  FlowEvaluator(std::shared_ptr<const SeaField> field, FlowStencil stencil);

  /// At first + i step, i = 0 .. count - 1. With `whole`, each point is the middle of an element that is as
  /// long as the step, and feels the mean over it, see SeaField::filter. By recurrence from point to point:
  /// beside rounding of the angles, each number errs by error_bound() at most.
  std::span<const LocalFlow<double>> line(double t, const Vec3d& first, const Vec3d& step, bool whole = true);
  /// At any points, `count` of them.
  std::span<const LocalFlow<double>> cloud(double t, std::span<const FlowPoint> points);
  /// At the one point of a stencil that has one; asked again for the same, it is not evaluated again.
  const LocalFlow<double>& one(double t, const FlowPoint& point);

  const FlowStencil& stencil() const { return stencil_; }
  /// Of each number of a flow against SeaField::at: what `cut` leaves out, and rounding.
  LocalFlow<double> error_bound(double t, double x, double y) const;

 private:
  void require_above_floor(double z) const;
  /// From the phasors of a point to its flow; `count` components are felt at all.
  void take(std::size_t count, double z, double height, LocalFlow<double>& out);
  void interior(std::size_t count, double level, LocalFlow<double>& out);

  std::shared_ptr<const SeaField> field_;
  FlowStencil stencil_;
  sea::FlowScratch scratch_;
  std::vector<LocalFlow<double>> flow_;
  double time_ = std::numeric_limits<double>::quiet_NaN();  // of one(); none
  FlowPoint point_;
};

}  // namespace seacrane
