#include "seacrane/sea/spectral_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "seacrane/sea/gauss_legendre.hpp"
#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

std::string entry(const char* name, std::size_t i) {
  return std::string(name) + '[' + std::to_string(i) + ']';
}

}  // namespace

SpectralTable::SpectralTable(const std::string& object, std::vector<double> omega,
                             std::vector<double> density)
    : omega_(std::move(omega)), density_(std::move(density)) {
  const std::size_t n = omega_.size();
  sea::require(n >= 2, object, "number of frequencies", n, "give at least two");
  sea::require(density_.size() == n, object, "length of density", density_.size(),
               "give one value per frequency (" + std::to_string(n) + ")");
  for (std::size_t i = 0; i < n; ++i) {
    const double below = i == 0 ? 0.0 : std::nextafter(omega_[i - 1], HUGE_VAL);
    sea::require(std::isfinite(omega_[i]) && omega_[i] >= below, object, entry("frequency", i), omega_[i],
                 "give finite frequencies from zero up, each above the one before");
    sea::require(std::isfinite(density_[i]) && density_[i] >= 0.0, object, entry("density", i), density_[i],
                 "give finite densities of zero or more");
  }
  const double m0 = moment(0);
  sea::require(m0 > 0.0, object, "energy m0", m0, "give a density above zero, or leave the sea out");
  hs_ = 4.0 * std::sqrt(m0);
  peak_omega_ =
      omega_[static_cast<std::size_t>(std::max_element(density_.begin(), density_.end()) - density_.begin())];
  sea::require(peak_omega_ > 0.0, object, "frequency of the highest density", peak_omega_,
               "give a spectrum whose peak lies above zero frequency");
}

double SpectralTable::inside(std::size_t i, double omega) const {
  const double share = (omega - omega_[i]) / (omega_[i + 1] - omega_[i]);
  return density_[i] + share * (density_[i + 1] - density_[i]);
}

double SpectralTable::density(double omega) const {
  if (!(omega >= first() && omega <= last())) return 0.0;
  const auto above = std::upper_bound(omega_.begin() + 1, omega_.end() - 1, omega);
  return inside(static_cast<std::size_t>(above - omega_.begin()) - 1, omega);
}

double SpectralTable::energy(double omega_min, double omega_max) const {
  const double to = std::min(omega_max, last());
  const auto above = std::upper_bound(omega_.begin() + 1, omega_.end() - 1, omega_min);
  double sum = 0.0;
  for (auto i = static_cast<std::size_t>(above - omega_.begin()) - 1; i + 1 < omega_.size(); ++i) {
    const double a = std::max(omega_min, omega_[i]), b = std::min(to, omega_[i + 1]);
    if (b > a) sum += 0.5 * (b - a) * (inside(i, a) + inside(i, b));
    if (omega_[i + 1] >= to) break;
  }
  return sum;
}

double SpectralTable::moment(int order) const {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < omega_.size(); ++i) {
    const auto f = [&](double w) { return std::pow(w, order) * inside(i, w); };
    // Panels of half the frequency keep the poles of negative powers far enough for full accuracy.
    const double width = order < 0 ? 0.5 * omega_[i] : omega_[i + 1] - omega_[i];
    sum += sea::integrate(f, omega_[i], omega_[i + 1], width);
  }
  return sum;
}

}  // namespace seacrane
