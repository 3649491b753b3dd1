#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "seacrane/sea/flow_stencil.hpp"
#include "seacrane/sea/sea_field.hpp"

namespace seacrane {

/// A long-crested sea as loads see it that are short beside its waves: a few of its wavenumbers stand for
/// all. Over a region around s along the waves the kernels cosh k(z + d) / cosh kd exp(-ik(s - s_m)) of all
/// components follow from those of the few by an interpolative decomposition, K_i = sum_j alpha_ji K_j, which
/// is the same for every region; alpha is real, as the region is symmetric. The sums over the few then have
/// amplitudes that vary in time, see NearWaves. Immutable.
class NearSea {
 public:
  /// Of magnitude() of the whole sea: no number errs by more within a region, and no more comes from knots.
  static constexpr double relative_bound = 1e-6, knot_bound = 1e-7;
  static constexpr double overlap = 0.25;  // of neighbours, over their distance
  /// Sums with another factor each: the elevation and g times it, of the potential, of the elevation's rate.
  static constexpr std::size_t sums = 3;

  /// Null where the sum over all components is as cheap, or no stencil is short enough.
  static std::shared_ptr<const NearSea> of(const std::shared_ptr<const SeaField>& all,
                                           const std::vector<FlowStencil>& stencils);

  /// Whether a stencil is seen by the few. It depends on its sizes alone.
  bool serves(const FlowStencil& stencil) const;
  const SeaField& all() const { return *all_; }
  /// Waves of unit height, whose velocity takes the sum of the potential, see SeaField::of_unit_height.
  const SeaField& few() const { return few_; }
  /// Real shares alpha of the few in the components of `all`, of unit height, times their amplitudes; a row
  /// of few().padded() for each component.
  const std::vector<double>& shares() const { return shares_; }
  /// By which a component counts in each sum.
  const std::array<std::vector<double>, sums>& factors() const { return factors_; }
  double spacing() const { return spacing_; }  // of the regions, m
  double step() const { return step_; }        // of the knots, s

 private:
  NearSea(std::shared_ptr<const SeaField> all, SeaField few) : all_(std::move(all)), few_(std::move(few)) {}

  std::shared_ptr<const SeaField> all_;
  SeaField few_;
  std::vector<double> shares_;
  std::array<std::vector<double>, sums> factors_;
  double reach_ = 0.0, spacing_ = 0.0, step_ = 0.0;
};

}  // namespace seacrane
