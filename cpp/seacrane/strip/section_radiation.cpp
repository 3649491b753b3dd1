#include "seacrane/strip/section_radiation.hpp"

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

SectionRadiation section_radiation(const HalfSection& section, const std::vector<double>& omega,
                                   const SectionSettings& settings, const std::function<void()>& poll) {
  require_settings(settings, omega);
  const SectionSolver solver(checked(section, "section"), settings);
  SectionRadiation out{{}, solver.limits()};
  for (double w : omega) {
    poll();
    out.at.push_back(solver.solve(w).coefficients);
  }
  return out;
}

}  // namespace seacrane::strip
