#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

#include "seacrane/strip/section_radiation.hpp"

namespace seacrane::strip {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6c = Eigen::Matrix<std::complex<double>, 6, 1>;

/// What strip theory is asked: sections at increasing x, waves, forward speed.
struct StripCase {
  std::vector<double> x;  // m, forward
  std::vector<HalfSection> sections;
  std::vector<double> omega, heading;  // rad/s, rad
  double speed = 0.0;                  // m/s
  SectionSettings settings;
};

/// Matrices at encounter frequencies omega; forces per metre of wave amplitude at wave frequencies omega.
/// All about x = 0 on the centre line at the waterline.
struct StripResult {
  std::vector<Matrix6> added_mass, damping;           // [omega]
  Matrix6 infinite_frequency, zero_frequency;         // added mass; NaN where the limit does not exist
  std::vector<Vector6c> force, froude_krylov;         // [heading * omega count + omega]
  std::vector<double> encounter_frequency;            // likewise, rad/s
  std::vector<Eigen::Matrix3d> sectional_added_mass;  // [omega * station count + station]
  std::vector<Eigen::Matrix3d> sectional_damping;     // likewise
  std::vector<SectionLimits> sectional_limits;        // [station]
};

/// `poll` is called at least once per station and frequency and may throw.
StripResult strip_theory(const StripCase& input, const std::function<void()>& poll);

}  // namespace seacrane::strip
