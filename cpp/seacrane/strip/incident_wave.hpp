#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "seacrane/strip/section_solver.hpp"

namespace seacrane::strip {

/// A unit wave in deep water: pressure rho g exp(k z - i k (x cos b + y sin b)).
struct IncidentWave {
  double omega, wavenumber, cos_heading, sin_heading;
};

/// Pressure of the incident wave over one section, per metre of length and of amplitude, without the factor
/// exp(-i k x cos b): load in sway, heave, roll, and the integrals of p, y p and z p over the area, from
/// which the loads on whatever faces forward or aft follow by Gauss' theorem.
struct SectionalPressure {
  Eigen::Vector3cd load;
  std::complex<double> area, y_moment, z_moment;
};

/// Quadrature along one half section, three Gauss points on each side.
class SectionContour {
 public:
  /// Sides between the nodes given, long ones in parts of at most a twentieth of the outline.
  explicit SectionContour(const HalfSection& section);
  /// Sides as they are: the hull panels.
  explicit SectionContour(const SectionPanels& panels);

  SectionalPressure pressure(const IncidentWave& wave, double rho, double g) const;

  /// Haskind's relation in the section, Salvesen, Tuck and Faltinsen (1970): load of the diffracted waves in
  /// sway, heave and roll, from radiation potentials (per panel and unit velocity) at the frequency of
  /// encounter.
  Eigen::Vector3cd diffraction(const IncidentWave& wave, double encounter_frequency,
                               const Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 3>& potential,
                               double rho) const;

 private:
  struct Point {
    double y, z, normal_y, normal_z;  // normal times length
  };
  void add_side(std::complex<double> from, std::complex<double> to);
  std::vector<Point> points_;
};

}  // namespace seacrane::strip
