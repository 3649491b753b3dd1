#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "seacrane/sea/flow_kernel.hpp"
#include "seacrane/sea/flow_stencil.hpp"
#include "seacrane/sea/near_waves.hpp"
#include "seacrane/sea/sea_field.hpp"

namespace seacrane {

/// A point, as the middle of an element that is as wide as its extents.
template <class T>
struct FlowPlace {
  Vec3<T> position = Vec3<T>::Zero();  // m, inertial frame
  Mat3<T> extents = Mat3<T>::Zero();   // m, inertial frame: of the element along three axes, in columns
  Vec3<T> turning = Vec3<T>::Zero();   // rad/s, of the element
  T height = T(0);                     // m, of the element: the flow is averaged over what of it is wet

  bool operator==(const FlowPlace& other) const {
    return position == other.position && extents == other.extents && turning == other.turning &&
           height == other.height;
  }
};
using FlowPoint = FlowPlace<double>;

/// The sea at a stencil of points, and its scratch; one for each run. Without a field the water is still and
/// at rest. Results depend on the arguments alone, whatever was evaluated before.
class FlowEvaluator {
 public:
  /// `scratch`, for those of one thread that take turns, has room for the components of the field. Rows are
  /// sums over the few components of `near`, where there is one.
  FlowEvaluator(std::shared_ptr<const SeaField> field, FlowStencil stencil,
                std::shared_ptr<sea::FlowScratch> scratch = nullptr,
                std::shared_ptr<NearWaves> near = nullptr);

  /// At first + i step, i = 0 .. count - 1. With `whole`, each point is the middle of an element that is as
  /// long as the step, and feels the mean over it, see SeaField::filter. By recurrence from point to point:
  /// beside rounding of the angles, each number errs by error_bound() at most.
  std::span<const LocalFlow<double>> line(double t, const Vec3d& first, const Vec3d& step, bool whole = true);
  /// At any points, `count` of them.
  std::span<const LocalFlow<double>> cloud(double t, std::span<const FlowPoint> points);
  /// At elements that differ from the first by equal steps. Asked again for the same, they are not evaluated
  /// again.
  std::span<const LocalFlow<double>> row(double t, const FlowPoint& first, const Vec3d& step);

  const FlowStencil& stencil() const { return stencil_; }
  /// Of each number of a flow against SeaField::at: what `cut` leaves out, rounding, and what the few miss.
  LocalFlow<double> error_bound(double t, double x, double y) const;

 private:
  void require_above_floor(double z) const;
  /// Amplitudes of the first waves, before an element takes its mean of them.
  void meet_waves(std::size_t count);
  /// Amplitudes that an element feels of the first waves, and how many components are felt at all.
  std::size_t feel(const FlowPoint& at, std::size_t most);
  /// The row from the phasors of its first element, `count` of them felt.
  void add_row(std::size_t count, const FlowPoint& first, const Vec3d& step);
  void write_near(double t, const FlowPoint& first, const Vec3d& step);
  void write_row(double t, const FlowPoint& first, const Vec3d& step);
  /// The flow at a point that feels `most` waves, without its surface.
  void write_calm(double t, const FlowPoint& at, std::size_t most, LocalFlow<double>& out);
  /// The surface at point n, from the phasors of the first, or else of the point before.
  void add_surface(std::size_t n, std::size_t count, LocalFlow<double>& out);
  /// From the phasors of a point to its flow; `count` components are felt at all.
  void take(std::size_t count, double z, double height, LocalFlow<double>& out);
  void interior(std::size_t count, double level, LocalFlow<double>& out);

  std::shared_ptr<const SeaField> field_;
  FlowStencil stencil_;
  std::shared_ptr<sea::FlowScratch> scratch_;
  std::shared_ptr<NearWaves> near_;
  const SeaField* summed_;  // the field, or the few of it
  std::vector<LocalFlow<double>> flow_;
  double time_ = std::numeric_limits<double>::quiet_NaN();  // of the last row; none
  FlowPoint first_;
  Vec3d step_ = Vec3d::Zero();
  double calm_ = -std::numeric_limits<double>::infinity();  // z below which the surface is not asked for
};

}  // namespace seacrane
