#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "seacrane/sea/flow_slopes.hpp"
#include "seacrane/sea/flow_stencil.hpp"
#include "seacrane/sea/near_waves.hpp"
#include "seacrane/sea/sea_field.hpp"

namespace seacrane {

/// Levels of a field for a cut, see SeaField: below which the surface is not asked for, and no waves are.
struct QuietLevels {
  double cut, calm, still;

  QuietLevels(const SeaField& field, double cut)
      : cut(cut), calm(field.calm_below(cut)), still(std::min(calm, field.still_below(cut))) {}
};

/// The sea at a stencil of points, and its scratch; one for each run. Without a field the water is still and
/// at rest. Results depend on the arguments alone, whatever was evaluated before.
class FlowEvaluator {
 public:
  /// `scratch`, for those of one thread that take turns, has room for the components of the field. Rows are
  /// sums over the few components of `near`, where there is one. `quiet`: levels of the field, if known.
  FlowEvaluator(std::shared_ptr<const SeaField> field, FlowStencil stencil,
                std::shared_ptr<sea::FlowScratch> scratch = nullptr,
                std::shared_ptr<NearWaves> near = nullptr, const QuietLevels* quiet = nullptr);

  /// At first + i step, i = 0 .. count - 1. With `whole`, each point is the middle of an element that is as
  /// long as the step, and feels the mean over it, see SeaField::filter. By recurrence from point to point:
  /// beside rounding of the angles, each number errs by error_bound() at most.
  std::span<const LocalFlow<double>> line(double t, const Vec3d& first, const Vec3d& step, bool whole = true);
  /// At any points, `count` of them.
  std::span<const LocalFlow<double>> cloud(double t, std::span<const FlowPoint> points);
  /// At elements that differ from the first by equal steps. Asked again for the same, they are not evaluated
  /// again.
  std::span<const LocalFlow<double>> row(double t, const FlowPoint& first, const Vec3d& step);
  /// The same at the one point of a stencil.
  const LocalFlow<double>& point(double t, const Vec3d& place) {
    if (!(row_.of_point && t == row_.t && place == row_.first.position)) {
      row(t, {place}, Vec3d::Zero());
      row_.of_point = true;
    }
    return flow_.front();
  }
  /// The flow of the row at an element, with slopes: those of the very sums that row() takes.
  template <int N>
  LocalFlow<Dual<N>> in_row(int index, double t, const FlowPlace<Dual<N>>& first, const Vec3<Dual<N>>& step) {
    const FlowSlopes& at =
        slopes(t, first.values(), step.unaryExpr([](const Dual<N>& x) { return x.value; }))[idx(index)];
    return in_directions(at, *field_, first, step, index, 0.5 * static_cast<double>(stencil_.count - 1));
  }

  const FlowStencil& stencil() const { return stencil_; }
  /// Of each number of a flow against SeaField::at: what `cut` leaves out, rounding, and what the few miss.
  LocalFlow<double> error_bound(double t, double x, double y) const;

 private:
  /// What of the waves a row is summed of.
  struct Sum {
    std::size_t most;  // of the components of the field
    bool few, calm;    // the few in their place; without its surface
  };
  /// SeaField::reach() of one field and cut, remembered between two levels that have the same.
  class Reach {
   public:
    std::size_t of(const SeaField& field, double level, double cut);

   private:
    std::size_t count_ = 0;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
  };
  struct Row {
    double t = std::numeric_limits<double>::quiet_NaN();
    FlowPoint first;
    Vec3d step = Vec3d::Zero();
    bool of_point = false;
    bool operator==(const Row&) const = default;
  };
  /// Where the decays of an element are.
  struct Depth {
    double level;
    std::size_t reached;  // as many of the components
  };

  void require_above_floor(double z) const;
  Sum sum(double t, const FlowPoint& first, const Vec3d& step);
  /// Amplitudes of the first waves, before an element takes its mean of them.
  void meet_waves(std::size_t count);
  /// Amplitudes that an element feels of the first waves, and how many components are felt at all.
  std::size_t feel(const FlowPoint& at, std::size_t most);
  /// The row from the phasors of its first element, `count` of them felt.
  void add_row(std::size_t count, const FlowPoint& first, const Vec3d& step);
  /// From here on sums are those over the few, until leave_few().
  NearWaves::Met meet_few(double t, const FlowPoint& first, const Vec3d& step, bool sloped);
  void leave_few();
  void write_near(double t, const FlowPoint& first, const Vec3d& step);
  void write_row(double t, const FlowPoint& first, const Vec3d& step);
  /// The flow at a point that feels `most` waves, without its surface.
  void write_calm(double t, const FlowPoint& at, std::size_t most, LocalFlow<double>& out);
  /// The surface at point n, from the phasors of the first, or else of the point before.
  void add_surface(std::size_t n, std::size_t count, LocalFlow<double>& out);
  /// From the phasors of a point to its flow; `count` components are felt at all.
  void take(std::size_t count, double z, double height, LocalFlow<double>& out);
  void interior(std::size_t count, double level, LocalFlow<double>& out);
  void add_current(double level, LocalFlow<double>& out);
  /// Of an element under a surface; in `calm` water it is all wet.
  Depth sink(std::size_t count, double z, double height, double elevation, bool calm);
  std::span<const FlowSlopes> slopes(double t, const FlowPoint& first, const Vec3d& step);
  void write_slopes(double t, const FlowPoint& first, const Vec3d& step);

  std::shared_ptr<const SeaField> field_;
  FlowStencil stencil_;
  std::shared_ptr<sea::FlowScratch> scratch_;
  std::shared_ptr<NearWaves> near_;
  const SeaField* summed_;  // the field, or the few of it
  std::vector<LocalFlow<double>> flow_;
  std::vector<FlowSlopes> slopes_;
  Row row_, sloped_;  // the last ones; none
  Reach reach_, few_reach_;
  double calm_ = -std::numeric_limits<double>::infinity(), still_ = calm_;
};

}  // namespace seacrane
