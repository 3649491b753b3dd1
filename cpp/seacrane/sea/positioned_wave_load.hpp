#pragma once

#include <vector>

#include "seacrane/sea/heading_table.hpp"
#include "seacrane/sea/wave_components.hpp"

namespace seacrane {

/// Force transfer (six complex numbers, real part first) and mean drift per amplitude squared by heading.
using ForceByHeading = HeadingTable<12>;
using DriftByHeading = HeadingTable<6>;

struct PositionedLoad {
  double force[6], drift[6], elevation;
};

/// Wave loads with phase and heading of the vessel as it is now, or of its motion below a cut-off frequency,
/// in axes that follow its yaw:
/// F_j = Re sum_i a_i X_j(omega_i, b_i - psi) exp(i theta_i), theta_i = omega_i t + phase_i
/// - k_i (x cos b_i + y sin b_i); the slow drift as in DriftLoad, with the same theta_i and D at b_i - psi.
/// Immutable; nothing is allocated after construction.
class PositionedWaveLoad {
 public:
  /// Tables with one row per component; an empty drift table leaves drift out. Cut-off in rad/s; 0: none.
  PositionedWaveLoad(WaveComponents waves, ForceByHeading force, DriftByHeading drift, double cutoff = 0.0);

  void evaluate(double t, double x, double y, double yaw, PositionedLoad& out) const;

  /// Slopes of the six loads, force and drift together, over x, y and yaw.
  void slopes(double t, double x, double y, double yaw, double (&out)[6][3]) const;

  const WaveComponents& waves() const { return waves_; }
  bool has_drift() const { return !drift_.empty(); }
  double cutoff() const { return cutoff_; }

 private:
  WaveComponents waves_;
  ForceByHeading force_;
  DriftByHeading drift_;
  double cutoff_;
  std::vector<double> along_x_, along_y_;  // k cos b, k sin b
  double largest_omega_ = 0.0, largest_wavenumber_ = 0.0, largest_phase_ = 0.0;
};

}  // namespace seacrane
