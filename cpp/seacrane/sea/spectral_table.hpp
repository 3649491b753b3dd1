#pragma once

#include <string>
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

}  // namespace seacrane
