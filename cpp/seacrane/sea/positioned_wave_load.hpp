#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "seacrane/math/periodic_spline.hpp"
#include "seacrane/sea/require.hpp"
#include "seacrane/sea/wave_components.hpp"

namespace seacrane {

/// `width` numbers per wave component, as periodic cubic splines over the wave's heading relative to the
/// vessel. All components of one heading lie side by side: those of a long-crested sea need two such rows.
template <std::size_t width>
class HeadingTable {
 public:
  HeadingTable() = default;

  /// Values: headings x components x width, row by row; headings increase within one turn, at most 45 deg
  /// apart.
  HeadingTable(const std::string& object, std::vector<double> headings, std::size_t components,
               const double* values) {
    check(object, headings);
    const std::size_t m = headings.size();
    knots_ = PeriodicKnots(std::move(headings));
    const MatXd curvature = knots_.curvature();
    components_ = components;
    entries_.resize(m * components);
    VecXd at(static_cast<Eigen::Index>(m));
    for (std::size_t i = 0; i < components; ++i) {
      for (std::size_t k = 0; k < width; ++k) {
        for (std::size_t h = 0; h < m; ++h) {
          const double v = values[(h * components + i) * width + k];
          if (!std::isfinite(v)) {
            sea::require(false, object, "value of component " + std::to_string(i), v, "give finite numbers");
          }
          at[static_cast<Eigen::Index>(h)] = v;
        }
        const VecXd bent = curvature * at;
        for (std::size_t h = 0; h < m; ++h) {
          entries_[h * components + i].value[k] = at[static_cast<Eigen::Index>(h)];
          entries_[h * components + i].curvature[k] = bent[static_cast<Eigen::Index>(h)];
        }
      }
    }
  }

  bool empty() const { return entries_.empty(); }
  template <class T>
  SplinePlace<T> place(const T& heading) const {
    return knots_.place<T>(heading);
  }

  template <class T>
  void at(std::size_t component, const SplinePlace<T>& p, T* out) const {
    const Entry &a = entries_[p.i * components_ + component], &b = entries_[p.j * components_ + component];
    for (std::size_t k = 0; k < width; ++k) {
      out[k] = p.left * a.value[k] + p.right * b.value[k] + p.bend_left * a.curvature[k] +
               p.bend_right * b.curvature[k];
    }
  }

 private:
  struct Entry {
    double value[width], curvature[width];
  };

  static void check(const std::string& object, const std::vector<double>& headings) {
    constexpr double widest = 0.25 * 3.14159265358979323846 * (1.0 + 1e-9);
    const std::string fix = "give headings that increase within one turn, at most 45 deg apart";
    sea::require(headings.size() >= 8, object, "number of headings", headings.size(), fix);
    for (std::size_t h = 0; h < headings.size(); ++h) {
      const bool last = h + 1 == headings.size();
      const double gap =
          last ? headings.front() + PeriodicKnots::turn - headings[h] : headings[h + 1] - headings[h];
      sea::require(gap > 0.0 && gap <= widest, object, "gap after heading " + std::to_string(h) + " (rad)",
                   gap, fix);
    }
  }

  PeriodicKnots knots_;
  std::vector<Entry> entries_;
  std::size_t components_ = 0;
};

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
