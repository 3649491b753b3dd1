#include "seacrane/strip/strip_theory.hpp"

#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "seacrane/sea/require.hpp"
#include "seacrane/strip/complex.hpp"
#include "seacrane/strip/incident_wave.hpp"
#include "seacrane/strip/section_solver.hpp"
#include "seacrane/strip/station_integral.hpp"

namespace seacrane::strip {
namespace {

constexpr double slowest_encounter = 1e-4;  // of the wave frequency

/// c0 + c1 x.
struct Lever {
  Complex c0, c1;
};

/// The section's mode behind each of the six motions: pitch acts by heave, yaw by sway.
constexpr std::array<int, 6> section_mode{-1, 0, 1, 2, 1, 0};

/// n_j + m_j U / (i omega) in terms of the section's normal, s = U / (i omega): n_5 = -x n_3 and m_5 = n_3,
/// n_6 = x n_2 and m_6 = -n_2 (Salvesen, Tuck and Faltinsen 1970).
Lever load_lever(int motion, Complex s) {
  if (motion == 4) return {-s, -1.0};
  if (motion == 5) return {s, 1.0};
  return {1.0, 0.0};
}

/// phi_k in terms of the section's potential: phi_5 = (-x + s) phi_3, phi_6 = (x - s) phi_2.
Lever potential_lever(int motion, Complex s) {
  if (motion == 4) return {s, -1.0};
  if (motion == 5) return {-s, 1.0};
  return {1.0, 0.0};
}

/// n_j at the aftmost section.
double end_lever(int motion, double x) { return motion == 4 ? -x : motion == 5 ? x : 1.0; }

/// a + b / (i omega) of the hull from that of the sections. The end terms are those of the aftmost section.
Eigen::Matrix<Complex, 6, 6> assembled(const std::vector<double>& x, const Eigen::MatrixX3d& weights,
                                       const std::vector<Eigen::Matrix3cd>& section, Complex s) {
  Eigen::Matrix<Complex, 6, 6> out = Eigen::Matrix<Complex, 6, 6>::Zero();
  for (int j = 1; j < 6; ++j) {
    for (int k = 1; k < 6; ++k) {
      const Lever l = load_lever(j, s), p = potential_lever(k, s);
      const Eigen::Vector3cd polynomial(l.c0 * p.c0, l.c0 * p.c1 + l.c1 * p.c0, l.c1 * p.c1);
      const int row = section_mode[j], column = section_mode[k];
      for (std::size_t i = 0; i < x.size(); ++i) {
        out(j, k) +=
            section[i](row, column) * (weights.row(static_cast<Eigen::Index>(i)) * polynomial).value();
      }
      out(j, k) += s * end_lever(j, x[0]) * (p.c0 + p.c1 * x[0]) * section[0](row, column);
    }
  }
  return out;
}

/// The section's own reciprocity, sway with roll, holds to the error of its panels.
Eigen::Matrix3d symmetric(const Eigen::Matrix3d& m) { return 0.5 * (m + m.transpose()); }

std::string station_name(const StripCase& input, std::size_t i) {
  std::ostringstream name;
  name << "strip theory: section " << i << " at x = " << input.x[i] << " m";
  return name.str();
}

std::vector<HalfSection> checked_sections(const StripCase& input) {
  const std::string object = "strip theory";
  require_settings(input.settings, input.omega);
  sea::require(input.x.size() >= 2, object, "the number of stations", input.x.size(), "give at least 2");
  sea::require(input.sections.size() == input.x.size(), object, "the number of sections",
               input.sections.size(),
               "give one for each of the " + std::to_string(input.x.size()) + " stations");
  for (double b : input.heading) sea::require_finite(b, object, "heading", "rad");
  sea::require(std::isfinite(input.speed) && input.speed >= 0.0, object, "speed", input.speed,
               "give a forward speed in m/s, zero or above");
  std::vector<HalfSection> out;
  bool pointed = true;
  for (std::size_t i = 0; i < input.x.size(); ++i) {
    const std::string station = "x[" + std::to_string(i) + "]";
    sea::require_finite(input.x[i], object, station, "m");
    sea::require(i == 0 || input.x[i] > input.x[i - 1], object, station, input.x[i],
                 "sort the stations, each further forward than the one before");
    out.push_back(checked(input.sections[i], station_name(input, i)));
    pointed = pointed && out.back().rows() == 0;
  }
  sea::require(!pointed, object, "the number of immersed sections", 0, "give sections below the waterline");
  return out;
}

/// Waves of every heading and frequency, and the frequency at which the ship meets them.
class Waves {
 public:
  explicit Waves(const StripCase& input) : frequencies_(input.omega.size()) {
    for (double heading : input.heading) {
      for (double omega : input.omega) {
        const double k = omega * omega / input.settings.g;
        wave_.push_back({omega, k, std::cos(heading), std::sin(heading)});
        encounter_.push_back(omega - k * input.speed * std::cos(heading));
        if (std::abs(encounter_.back()) < slowest_encounter * omega) {
          sea::require(false, "strip theory", "the encounter frequency", encounter_.back(),
                       "the ship keeps up with the wave of " + std::to_string(omega) + " rad/s and heading " +
                           std::to_string(heading) + " rad; change speed, frequency or heading");
        }
      }
    }
  }

  std::size_t count() const { return wave_.size(); }
  std::size_t frequency(std::size_t i) const { return i % frequencies_; }
  const IncidentWave& wave(std::size_t i) const { return wave_[i]; }
  double encounter(std::size_t i) const { return encounter_[i]; }
  const std::vector<double>& encounter() const { return encounter_; }

 private:
  std::size_t frequencies_;
  std::vector<IncidentWave> wave_;
  std::vector<double> encounter_;
};

/// Loads of one wave at one station, without exp(-i k x cos b).
struct SectionalLoad {
  SectionalPressure pressure;
  Eigen::Vector3cd diffraction;
};

/// Radiation and wave loads of all sections; [omega * stations + station], [wave * stations + station].
struct Sections {
  std::vector<SectionCoefficients> radiation;
  std::vector<SectionLimits> limits;
  std::vector<SectionalLoad> load;
};

void solve_section(const HalfSection& section, std::size_t station, const StripCase& input,
                   const Waves& waves, Sections& out, const std::function<void()>& poll) {
  const SectionSettings& settings = input.settings;
  const SectionSolver solver(section, settings);
  const SectionContour outline(section), panels(solver.panels());
  const std::size_t stations = input.x.size();
  out.limits[station] = solver.limits();
  std::vector<SectionSolution> solution;
  for (std::size_t i = 0; i < input.omega.size(); ++i) {
    poll();
    solution.push_back(solver.solve(input.omega[i]));
    require_energy_balance(solution.back().coefficients, out.limits[station], input.omega[i], settings,
                           station_name(input, station));
    out.radiation[i * stations + station] = solution.back().coefficients;
  }
  for (std::size_t i = 0; i < waves.count(); ++i) {
    const IncidentWave& wave = waves.wave(i);
    const double encounter = waves.encounter(i);
    SectionalLoad& load = out.load[i * stations + station];
    load.pressure = outline.pressure(wave, settings.rho, settings.g);
    if (encounter == wave.omega) {
      const auto& potential = solution[waves.frequency(i)].potential;
      load.diffraction = panels.diffraction(wave, encounter, potential, settings.rho);
      continue;
    }
    poll();
    SectionSolution met = solver.solve(std::abs(encounter));
    require_energy_balance(met.coefficients, out.limits[station], std::abs(encounter), settings,
                           station_name(input, station));
    if (encounter < 0.0) met.potential = met.potential.conjugate().eval();  // overtaken waves: time runs back
    load.diffraction = panels.diffraction(wave, encounter, met.potential, settings.rho);
  }
}

/// Forces of one wave: the incident pressure exactly, the diffracted waves after Salvesen, Tuck and
/// Faltinsen.
void add_force(const StripCase& input, const Waves& waves, std::size_t index, const Sections& sections,
               StripResult& out) {
  const IncidentWave& wave = waves.wave(index);
  const double k = wave.wavenumber * wave.cos_heading;
  const Eigen::MatrixX2cd weights = oscillatory_weights(input.x, k);
  const Complex s = input.speed / (i_unit * waves.encounter(index));
  Vector6c incident = Vector6c::Zero(), diffraction = Vector6c::Zero();
  for (std::size_t i = 0; i < input.x.size(); ++i) {
    const SectionalLoad& load = sections.load[index * input.x.size() + i];
    const SectionalPressure& p = load.pressure;
    const auto weight = weights.row(static_cast<Eigen::Index>(i));
    for (int j = 1; j < 4; ++j) incident[j] += weight[0] * p.load[j - 1];
    // n_1 over all that faces forward or aft, ends included: the volume integral of -dp/dx = i k cos b p.
    incident[0] += i_unit * k * weight[0] * p.area;
    incident[4] += i_unit * k * weight[0] * p.z_moment - weight[1] * p.load[1];
    incident[5] += weight[1] * p.load[0] - i_unit * k * weight[0] * p.y_moment;
    for (int j = 1; j < 6; ++j) {
      const Lever lever = load_lever(j, s);
      diffraction[j] += (lever.c0 * weight[0] + lever.c1 * weight[1]) * load.diffraction[section_mode[j]];
    }
  }
  const SectionalLoad& aft = sections.load[index * input.x.size()];
  const Complex phase = std::polar(1.0, -k * input.x[0]);
  for (int j = 1; j < 6; ++j) {
    diffraction[j] += s * end_lever(j, input.x[0]) * phase * aft.diffraction[section_mode[j]];
  }
  out.froude_krylov.push_back(incident);
  out.force.push_back(incident + diffraction);
}

Matrix6 limit_of(const std::vector<double>& x, const Eigen::MatrixX3d& weights,
                 const std::vector<SectionLimits>& limits, Eigen::Matrix3d SectionLimits::*which) {
  std::vector<Eigen::Matrix3cd> section;
  for (const SectionLimits& limit : limits) section.push_back(symmetric(limit.*which).cast<Complex>());
  return assembled(x, weights, section, 0.0).real();
}

}  // namespace

StripResult strip_theory(const StripCase& input, const std::function<void()>& poll) {
  const std::vector<HalfSection> checked = checked_sections(input);
  const Waves waves(input);
  const std::size_t stations = input.x.size(), frequencies = input.omega.size();
  Sections sections{std::vector<SectionCoefficients>(stations * frequencies),
                    std::vector<SectionLimits>(stations),
                    std::vector<SectionalLoad>(stations * waves.count())};
  for (std::size_t i = 0; i < stations; ++i) solve_section(checked[i], i, input, waves, sections, poll);

  StripResult out;
  const Eigen::MatrixX3d weights = moment_weights(input.x);
  for (std::size_t f = 0; f < frequencies; ++f) {
    const double omega = input.omega[f];
    std::vector<Eigen::Matrix3cd> section;
    for (std::size_t i = 0; i < stations; ++i) {
      const SectionCoefficients& c = sections.radiation[f * stations + i];
      out.sectional_added_mass.push_back(symmetric(c.added_mass));
      out.sectional_damping.push_back(symmetric(c.damping));
      section.push_back(out.sectional_added_mass.back().cast<Complex>() +
                        out.sectional_damping.back() / (i_unit * omega));
    }
    const auto hull = assembled(input.x, weights, section, input.speed / (i_unit * omega));
    out.added_mass.push_back(hull.real());
    out.damping.push_back(-omega * hull.imag());
  }
  out.infinite_frequency = limit_of(input.x, weights, sections.limits, &SectionLimits::infinite);
  out.zero_frequency = limit_of(input.x, weights, sections.limits, &SectionLimits::zero);
  for (std::size_t i = 0; i < waves.count(); ++i) add_force(input, waves, i, sections, out);
  out.encounter_frequency = waves.encounter();
  out.sectional_limits = sections.limits;
  return out;
}

}  // namespace seacrane::strip
