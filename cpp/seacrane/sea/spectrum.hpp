#pragma once

#include <string>

namespace seacrane {

inline constexpr double standard_gravity = 9.80665;  // m/s2

/// One-sided wave spectrum S(omega), m2 s/rad, of significant wave height and peak period. With x = omega
/// over peak frequency, S ~ x^-5 exp(-5/4 x^-4) gamma^G, G = exp(-(x - 1)^2 / (2 sigma^2)), sigma = 0.07 for
/// x <= 1, else 0.09 (Hasselmann et al. 1973); gamma = 1 is Pierson and Moskowitz (1964). Normalised by
/// quadrature, so that the integral over all frequencies is hs^2 / 16 to rounding (no fitted formula).
class Spectrum {
 public:
  static Spectrum jonswap(double hs, double tp, double gamma = 3.3);
  static Spectrum pierson_moskowitz(double hs, double tp);

  /// S(omega); zero for omega <= 0.
  double operator()(double omega) const;
  /// Integral of S from omega_min to omega_max (infinity allowed), m2.
  double energy(double omega_min, double omega_max) const;
  /// Integral of omega^order S over all frequencies, order -4 to 3 (from 4 on it is infinite).
  double moment(int order) const;
  /// hs over the deep-water length of a wave of the peak period, hs / (g tp^2 / 2 pi).
  double steepness(double gravity = standard_gravity) const;

  const std::string& name() const { return name_; }
  double hs() const { return hs_; }
  double tp() const { return tp_; }
  double gamma() const { return gamma_; }
  double peak_omega() const { return peak_omega_; }

 private:
  Spectrum(std::string name, double hs, double tp, double gamma);
  double excess(double x) const;
  double excess_integral(double from, double to, int order) const;

  std::string name_;
  double hs_, tp_, gamma_;
  double log_gamma_ = 0.0, peak_omega_ = 0.0;
  double scale_ = 0.0;  // m2: m0 over the integral of the shape in x
};

}  // namespace seacrane
