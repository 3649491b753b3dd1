#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "seacrane/strip/section_panels.hpp"

namespace seacrane::strip {

/// Fluid and discretisation shared by all sections.
struct SectionSettings {
  double rho = 1025.0;  // kg/m3
  double g = 9.81;      // m/s2
  int panels = 40;      // on the half section
};

/// Radiation of sway, heave and roll about the waterline origin at one frequency, per metre of length.
struct SectionCoefficients {
  Eigen::Matrix3d added_mass, damping;
  Eigen::Vector3cd wave_amplitude;  // at y -> +infinity, per unit of motion amplitude
};

/// Added mass of the limits: zero frequency exists for sway and roll only (heave is NaN), where heave's
/// grows without bound.
struct SectionLimits {
  Eigen::Matrix3d infinite, zero;
};

struct SectionRadiation {
  std::vector<SectionCoefficients> at;  // per frequency
  SectionLimits limits;
};

/// Throws std::invalid_argument unless density, gravity, panel count and frequencies are in range.
void require_settings(const SectionSettings& settings, const std::vector<double>& omega);

/// Throws std::invalid_argument, naming `name`, where the panels do not resolve the flow: the damping of sway
/// or heave, from pressures, and the energy of the waves far away differ by more than a tenth of the whole
/// load.
void require_energy_balance(const SectionCoefficients& coefficients, const SectionLimits& limits,
                            double omega, const SectionSettings& settings, const std::string& name);

/// Coefficients at the frequencies omega (rad/s). `poll` is called once per frequency and may throw.
SectionRadiation section_radiation(const HalfSection& section, const std::vector<double>& omega,
                                   const SectionSettings& settings, const std::function<void()>& poll);

}  // namespace seacrane::strip
