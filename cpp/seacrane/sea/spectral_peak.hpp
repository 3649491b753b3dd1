#pragma once

#include <string>

namespace seacrane {

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

}  // namespace seacrane
