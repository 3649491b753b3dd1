#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "seacrane/sea/current.hpp"
#include "seacrane/sea/spectrum.hpp"

namespace seacrane {

/// When the sea comes back on itself, see WaveComponents::repeat_period.
struct RepeatPeriod {
  double time = 0.0;   // s: the first repeat, or the end of the search
  bool found = false;  // false: proven that nothing repeats before `time`
};

/// Regular waves whose sum is the sea: elevation = sum a cos(omega t - k (x cos b + y sin b) + phase) in the
/// inertial frame, b the direction of travel from +x towards +y. Immutable.
class WaveComponents {
 public:
  /// Vectors of one length: rad/s (above zero), m (zero or more), rad, rad. Wavenumbers follow from the
  /// linear dispersion relation at `depth` (m, infinity for deep water) on the current; frequencies are those
  /// that a fixed observer sees. A component that the current stops is refused.
  WaveComponents(std::vector<double> omega, std::vector<double> amplitude, std::vector<double> phase,
                 std::vector<double> direction, double depth = std::numeric_limits<double>::infinity(),
                 double gravity = standard_gravity, Current current = {});

  std::size_t size() const { return omega_.size(); }
  const std::vector<double>& omega() const { return omega_; }
  const std::vector<double>& wavenumber() const { return wavenumber_; }
  /// omega - k U, with which the water moves: sqrt(g k tanh k depth).
  const std::vector<double>& intrinsic() const { return intrinsic_; }
  const std::vector<double>& direction() const { return direction_; }
  const std::vector<double>& amplitude() const { return amplitude_; }
  const std::vector<double>& phase() const { return phase_; }
  /// cos b and sin b of the directions.
  const std::vector<double>& direction_x() const { return direction_x_; }
  const std::vector<double>& direction_y() const { return direction_y_; }
  double depth() const { return depth_; }
  double gravity() const { return gravity_; }
  const Current& current() const { return current_; }

  double elevation(double t, double x, double y) const;
  /// phase_i - k_i (x cos b_i + y sin b_i).
  double phase_at(std::size_t i, double x, double y) const;

  /// sum omega^order a^2 / 2.
  double moment(int order) const;
  /// 4 sqrt(m0), from the amplitudes: no sampling scatter.
  double realised_hs() const;
  /// Mean zero-upcrossing period 2 pi sqrt(m0 / m2), s.
  double mean_period() const;
  /// Autocorrelation coefficient of the elevation at one point, sum a^2 cos(omega T) / sum a^2.
  double autocorrelation(double lag) const;
  /// The smallest T, after the first decay, at which the autocorrelation returns to 0.99: the record then
  /// differs from itself T earlier by 14 % of its standard deviation (root mean square) or less. Searched up
  /// to `horizon` in steps that the bound |second derivative| <= m2/m0 proves free of such a T.
  RepeatPeriod repeat_period(double horizon = 10800.0) const;

 private:
  void add_wavenumber(std::size_t i);

  std::vector<double> omega_, amplitude_, phase_, direction_, wavenumber_, intrinsic_, direction_x_,
      direction_y_;
  double depth_, gravity_;
  Current current_;
};

}  // namespace seacrane
