#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace seacrane {

/// Tabulated wave spectrum: linear between its frequencies, zero outside them.
class SpectralTable {
 public:
  /// omega (rad/s) increasing from zero or more, density (m2 s/rad) zero or more and not zero everywhere.
  SpectralTable(const std::string& object, std::vector<double> omega, std::vector<double> density);

  double density(double omega) const;
  double energy(double omega_min, double omega_max) const;
  /// A table that starts at zero frequency has no moment of negative order.
  double moment(int order) const;
  int lowest_moment() const { return omega_.front() > 0.0 ? -4 : 0; }

  double hs() const { return hs_; }
  double peak_omega() const { return peak_omega_; }
  double first() const { return omega_.front(); }
  double last() const { return omega_.back(); }

 private:
  double inside(std::size_t i, double omega) const;

  std::vector<double> omega_, density_;
  double hs_ = 0.0, peak_omega_ = 0.0;
};

/// One peak of a wave spectrum. With x = omega over the peak frequency,
/// S ~ x^-N exp(-N/4 x^-4) gamma^G, G = exp(-(x - 1)^2 / (2 sigma^2)), sigma = 0.07 for x <= 1, else 0.09,
/// normalised by quadrature, so that the integral over all frequencies is hs^2 / 16 to rounding (no fitted
/// formula). N = 5 is JONSWAP (Hasselmann et al. 1973), with gamma = 1 Pierson and Moskowitz (1964); N = 4
/// Torsethaugen and Haver (2004); N = 4 lambda + 1, gamma = 1 Ochi and Hubble (1976).
class SpectralPeak {
 public:
  /// hs (m) and tp (s) above zero, gamma at least 1, exponent N above 3; `object` names them in errors.
  SpectralPeak(const std::string& object, double hs, double tp, double gamma, double exponent = 5.0);

  double density(double omega) const;
  /// 0 <= omega_min <= omega_max, infinity allowed.
  double energy(double omega_min, double omega_max) const;
  /// Finite for order < N - 1.
  double moment(int order) const;
  int highest_moment() const;

  double hs() const { return hs_; }
  double tp() const { return tp_; }
  double gamma() const { return gamma_; }
  double peak_omega() const { return peak_omega_; }

 private:
  double shape(double x) const;
  double shape_integral(double from, double to) const;
  double shape_tail(double from) const;
  double shape_moment(int order) const;
  double excess(double x) const;
  double excess_integral(double from, double to, int order) const;

  double hs_, tp_, gamma_, exponent_;
  double log_gamma_ = 0.0, peak_omega_ = 0.0;
  double scale_ = 0.0;  // m2: m0 over the integral of the shape in x
};

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
