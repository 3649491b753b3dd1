#include "seacrane/strip/incident_wave.hpp"

#include <array>
#include <cmath>

#include "seacrane/strip/complex.hpp"

namespace seacrane::strip {
namespace {

constexpr int points_per_side = 3;

/// Integrals from 0 to y of cos(q y) and of y sin(q y).
std::array<double, 2> breadth_integrals(double q, double y) {
  const double t = q * y, t2 = t * t;
  if (std::abs(t) < 0.05) {
    return {y * (1.0 - t2 / 6.0 * (1.0 - t2 / 20.0)),
            q * y * y * y / 3.0 * (1.0 - t2 / 10.0 * (1.0 - t2 / 28.0))};
  }
  return {std::sin(t) / q, (std::sin(t) / q - y * std::cos(t)) / q};
}

}  // namespace

SectionContour::SectionContour(const HalfSection& section) {
  double girth = 0.0;
  for (Eigen::Index i = 0; i + 1 < section.rows(); ++i) girth += (section.row(i + 1) - section.row(i)).norm();
  for (Eigen::Index i = 0; i + 1 < section.rows(); ++i) {
    const Complex from(section(i, 0), section(i, 1)), to(section(i + 1, 0), section(i + 1, 1));
    const double parts = std::ceil(20.0 * std::abs(to - from) / girth);
    for (double part = 0.0; part < parts; ++part) {
      add_side(from + (to - from) * (part / parts), from + (to - from) * ((part + 1.0) / parts));
    }
  }
}

SectionContour::SectionContour(const SectionPanels& panels) {
  for (std::size_t j = panels.lid; j < panels.count(); ++j) add_side(panels.start(j), panels.end(j));
}

void SectionContour::add_side(Complex from, Complex to) {
  static constexpr std::array<double, points_per_side> node{-0.77459666924148337704, 0.0,
                                                            0.77459666924148337704};
  static constexpr std::array<double, points_per_side> weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const Complex normal = i_unit * (to - from);
  for (std::size_t k = 0; k < points_per_side; ++k) {
    const Complex at = 0.5 * (from + to) + 0.5 * node[k] * (to - from);
    points_.push_back({at.real(), at.imag(), weight[k] * normal.real(), weight[k] * normal.imag()});
  }
}

SectionalPressure SectionContour::pressure(const IncidentWave& wave, double rho, double g) const {
  const double k = wave.wavenumber, q = k * wave.sin_heading;
  double sway = 0.0, heave = 0.0, roll = 0.0, area = 0.0, y_moment = 0.0, z_moment = 0.0;
  for (const Point& p : points_) {
    // Twice the half section: exp(-i q y) leaves cos(q y) for even normals and -i sin(q y) for odd ones.
    const double decay = 2.0 * rho * g * std::exp(k * p.z);
    const double cosine = decay * std::cos(q * p.y), sine = decay * std::sin(q * p.y);
    sway += p.normal_y * sine;
    heave += p.normal_z * cosine;
    roll += (p.y * p.normal_z - p.z * p.normal_y) * sine;
    const auto [even, odd] = breadth_integrals(q, p.y);
    area += decay * even * p.normal_y;  // normal_y is the depth of the strip up to the centre line
    z_moment += decay * even * p.z * p.normal_y;
    y_moment += decay * odd * p.normal_y;
  }
  return {{i_unit * sway, -heave, i_unit * roll}, area, -i_unit * y_moment, z_moment};
}

Eigen::Vector3cd SectionContour::diffraction(const IncidentWave& wave, double encounter_frequency,
                                             const Eigen::Matrix<Complex, Eigen::Dynamic, 3>& potential,
                                             double rho) const {
  const double k = wave.wavenumber, q = k * wave.sin_heading;
  Eigen::Vector3cd sum = Eigen::Vector3cd::Zero();
  for (Eigen::Index panel = 0; panel < potential.rows(); ++panel) {
    // Normal velocity omega (i n_z + n_y sin b) exp(k z - i q y), its even and its odd part.
    Complex even = 0.0, odd = 0.0;
    for (int j = 0; j < points_per_side; ++j) {
      const Point& p = points_[points_per_side * panel + j];
      const double decay = std::exp(k * p.z), cosine = decay * std::cos(q * p.y);
      const double sine = decay * std::sin(q * p.y);
      even += i_unit * (p.normal_z * cosine - p.normal_y * wave.sin_heading * sine);
      odd += p.normal_z * sine + p.normal_y * wave.sin_heading * cosine;
    }
    sum += potential.row(panel).transpose().cwiseProduct(Eigen::Vector3cd(odd, even, odd));
  }
  return -2.0 * i_unit * rho * encounter_frequency * wave.omega * sum;
}

}  // namespace seacrane::strip
