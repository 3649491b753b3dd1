#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "seacrane/sea/exact_wave_load.hpp"

namespace seacrane {

/// Slowly varying second-order load at the mean position after Newman (Second-order, slowly-varying forces on
/// vessels in irregular waves, 1974): the mean load D of each regular wave stands for its neighbours,
/// F_j(t) = sum_ik a_i a_k (D_ij + D_kj) / 2 cos(theta_i - theta_k) = Re(conj(S) S_j), with the envelopes
/// S = sum a exp(i theta) and S_j = sum a D_j exp(i theta). Two sums of n terms instead of n^2 products, and
/// difference frequencies only. Its mean is sum a^2 D. Immutable; nothing is allocated after construction.
class DriftLoad {
 public:
  static constexpr std::size_t channels = 6;
  static constexpr const char* object = "drift load";
  using Channels = std::array<double, channels>;

  /// D: one row per component, six columns, N/m2 and N m/m2: mean load per amplitude squared.
  DriftLoad(WaveComponents waves, const Eigen::Ref<const Eigen::MatrixXd>& coefficient,
            WavePoint position = {});

  /// Forces (N) and moments (N m).
  void evaluate(double t, double* out) const;
  /// Value, first and second derivative in time.
  void evaluate(double t, double* value, double* rate, double* acceleration) const;

  const WaveComponents& waves() const { return waves_; }
  /// sum_ik a_i a_k |D_kj| (omega_i - omega_k)^n for n = 0 and 12: no derivative of that order exceeds it.
  std::array<Channels, 2> bounds() const { return {magnitude(0), magnitude(12)}; }

 private:
  Channels magnitude(int order) const;     // an even one
  static constexpr std::size_t lanes = 8;  // the six D, one, and nothing
  using Row = std::array<double, lanes>;
  struct Sums {
    double real[lanes], imaginary[lanes];
  };
  template <std::size_t orders>
  void sum(double t, Sums (&out)[orders]) const;

  WaveComponents waves_;
  std::vector<Row> rows_;
  std::vector<double> real_, imaginary_;  // a exp(i phase) at the position
  double largest_omega_ = 0.0;
};

}  // namespace seacrane
