#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "seacrane/sea/spectral_peak.hpp"
#include "seacrane/sea/spectral_table.hpp"

namespace seacrane {

inline constexpr double standard_gravity = 9.80665;  // m/s2

/// Peak enhancement by DNV-RP-C205 (3.5.5): 5 for Tp / sqrt(Hs) <= 3.6, 1 from 5 on, between them
/// exp(5.75 - 1.15 Tp / sqrt(Hs)).
double dnv_gamma(double hs, double tp);

/// One-sided wave spectrum S(omega), m2 s/rad: a sum of peaks, or a table. Immutable.
class Spectrum {
 public:
  static Spectrum jonswap(double hs, double tp, double gamma = 3.3);
  static Spectrum pierson_moskowitz(double hs, double tp);
  /// Wind sea and swell from hs and tp alone: K. Torsethaugen, S. Haver, "Simplified double peak spectral
  /// model for ocean waves", ISOPE 2004; DNV-RP-C205 appendix A, fetch 370 km. The primary system, which
  /// has the period tp, comes first.
  static Spectrum torsethaugen(double hs, double tp, double gravity = standard_gravity);
  /// Two systems, each of height, peak period and shape lambda: M. K. Ochi, E. N. Hubble, ICCE 1976.
  static Spectrum ochi_hubble(const std::array<double, 2>& hs, const std::array<double, 2>& tp,
                              const std::array<double, 2>& lambda);
  static Spectrum tabulated(std::vector<double> omega, std::vector<double> density);

  /// S(omega); zero for omega <= 0.
  double operator()(double omega) const;
  /// Integral of S from omega_min to omega_max (infinity allowed), m2.
  double energy(double omega_min, double omega_max) const;
  /// Integral of omega^order S over all frequencies, for orders where it is finite (JONSWAP: -4 to 3).
  double moment(int order) const;
  /// hs over the deep-water length of a wave of the peak period, hs / (g tp^2 / 2 pi).
  double steepness(double gravity = standard_gravity) const;

  /// Each wave system by itself, the one with the given or highest peak first.
  std::vector<Spectrum> parts() const;
  /// What a realisation covers by default: min(0.3, lowest peak / 2) to max(2.5, 3 x highest peak) rad/s of
  /// the parts that hold a hundredth of the energy or more; for a table its own range.
  std::array<double, 2> default_range() const;

  const std::string& name() const { return name_; }
  double hs() const { return hs_; }
  /// 2 pi / peak_omega().
  double tp() const { return tp_; }
  /// Peak enhancement of the first part; none for a table.
  std::optional<double> gamma() const;
  /// Peak frequency of the first part.
  double peak_omega() const;

 private:
  using Part = std::variant<SpectralPeak, SpectralTable>;
  Spectrum(std::string name, std::vector<Part> parts, double hs, double tp);

  std::string name_;
  std::vector<Part> parts_;
  double hs_, tp_;
};

}  // namespace seacrane
