#include "seacrane/strip/section_radiation.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "seacrane/sea/require.hpp"
#include "seacrane/strip/section_solver.hpp"

namespace seacrane::strip {

void require_settings(const SectionSettings& settings, const std::vector<double>& omega) {
  sea::require_positive(settings.rho, "strip theory", "rho", "kg/m3");
  sea::require_positive(settings.g, "strip theory", "g", "m/s2");
  sea::require(settings.panels >= 8 && settings.panels <= 400, "strip theory", "panels", settings.panels,
               "give 8 to 400 on the half section");
  for (double w : omega) sea::require_positive(w, "strip theory", "omega", "rad/s");
}

void require_energy_balance(const SectionCoefficients& coefficients, const SectionLimits& limits,
                            double omega, const SectionSettings& settings, const std::string& name) {
  for (int mode : {0, 1}) {
    const double carried = settings.rho * settings.g * settings.g / (omega * omega * omega) *
                           std::norm(coefficients.wave_amplitude[mode]);
    const double damping = coefficients.damping(mode, mode);
    const double inertia = omega * std::max(std::abs(coefficients.added_mass(mode, mode)),
                                            std::abs(limits.infinite(mode, mode)));
    const double whole = std::hypot(std::max(damping, carried), inertia);
    if (std::abs(damping - carried) <= 0.1 * whole) continue;  // a NaN is refused, too
    std::ostringstream text;
    text << name << ": at " << omega << " rad/s the damping in " << (mode == 0 ? "sway" : "heave") << " is "
         << damping << " by pressure and " << carried << " by the waves it makes; " << settings.panels
         << " panels are too few for this shape: give more, or smooth out narrow necks and gaps";
    throw std::invalid_argument(text.str());
  }
}

SectionRadiation section_radiation(const HalfSection& section, const std::vector<double>& omega,
                                   const SectionSettings& settings, const std::function<void()>& poll) {
  require_settings(settings, omega);
  const SectionSolver solver(checked(section, "section"), settings);
  SectionRadiation out{{}, solver.limits()};
  for (double w : omega) {
    poll();
    out.at.push_back(solver.solve(w).coefficients);
    require_energy_balance(out.at.back(), out.limits, w, settings, "section");
  }
  return out;
}

}  // namespace seacrane::strip
