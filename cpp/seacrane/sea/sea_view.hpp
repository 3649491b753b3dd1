#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "seacrane/sea/flow_evaluator.hpp"

namespace seacrane {

/// What the loads of one run see of the sea: the stencils that they asked for when the scene was compiled, by
/// the numbers that they got. Const to loads; its scratch belongs to the run, and nothing is allocated.
class SeaView {
 public:
  /// Without a field: deep water, still and at rest.
  /// Without `near` all components are summed everywhere.
  SeaView(std::shared_ptr<const SeaField> field, const std::vector<FlowStencil>& stencils,
          std::shared_ptr<const NearSea> near = nullptr)
      : field_(std::move(field)) {
    const auto scratch = std::make_shared<sea::FlowScratch>(field_ ? field_->padded() : 0);
    const auto waves = near ? std::make_shared<NearWaves>(near, stencils.size()) : nullptr;
    std::vector<QuietLevels> known;
    for (const FlowStencil& one : stencils) {
      const QuietLevels* const quiet = field_ && one.sinks() ? &quiet_levels(one.cut, known) : nullptr;
      evaluators_.emplace_back(field_, one, scratch, near && near->serves(one) ? waves : nullptr, quiet);
    }
  }
  SeaView(SeaView&&) = default;  // and no copy, which would share the scratch

  const SeaField* field() const { return field_.get(); }
  double depth() const { return field_ ? field_->depth() : std::numeric_limits<double>::infinity(); }

  /// The flow at all elements of a stencil that differ by equal steps, FlowEvaluator::row; without a field,
  /// none.
  std::span<const LocalFlow<double>> row(int stencil, double t, const FlowPoint& first,
                                         const Vec3d& step) const {
    if (!field_) return {};
    return evaluators_[idx(stencil)].row(t, first, step);
  }
  /// The flow at an element of a stencil whose elements differ by equal steps, FlowEvaluator::row; with
  /// slopes where T is a Dual.
  template <class T>
  LocalFlow<T> in_row(int stencil, int index, double t, const FlowPlace<T>& first,
                      const Vec3<T>& step) const {
    if constexpr (std::is_same_v<T, double>) {
      return evaluators_[idx(stencil)].row(t, first, step)[idx(index)];
    } else {
      if (!field_) return {};
      return evaluators_[idx(stencil)].in_row(index, t, first, step);
    }
  }
  /// The flow at the one point of a stencil, likewise.
  template <class T>
  LocalFlow<T> at_point(int stencil, double t, const Vec3<T>& point) const {
    if (!field_) return {};
    if constexpr (std::is_same_v<T, double>) {
      return evaluators_[idx(stencil)].point(t, point);
    } else {
      return in_row<T>(stencil, 0, t, {point}, Vec3<T>::Zero());
    }
  }
  /// No crest is higher at a stencil, m.
  double crest(int stencil) const { return field_ ? waves(stencil) * field_->crest() : 0.0; }

 private:
  const QuietLevels& quiet_levels(double cut, std::vector<QuietLevels>& known) const {
    const auto found = std::ranges::find(known, cut, &QuietLevels::cut);
    return found != known.end() ? *found : known.emplace_back(*field_, cut);
  }
  double waves(int stencil) const { return evaluators_[idx(stencil)].stencil().waves; }

  std::shared_ptr<const SeaField> field_;
  mutable std::vector<FlowEvaluator> evaluators_;
};

}  // namespace seacrane
