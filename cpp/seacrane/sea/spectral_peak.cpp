#include "seacrane/sea/spectral_peak.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seacrane/sea/gauss_legendre.hpp"
#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

constexpr double sigma_below = 0.07, sigma_above = 0.09;
// Ten sigma from the peak G is 2e-22; below x = 0.1 the shape underflows to zero.
constexpr double excess_from = 1.0 - 10.0 * sigma_below, excess_to = 1.0 + 10.0 * sigma_above;
constexpr double shape_from = 0.1;
constexpr double tail_from = 3.0;

}  // namespace

SpectralPeak::SpectralPeak(const std::string& object, double hs, double tp, double gamma, double exponent)
    : hs_(hs), tp_(tp), gamma_(gamma), exponent_(exponent) {
  sea::require(std::isfinite(hs) && hs > 0.0, object, "hs", hs,
               "give a significant wave height above zero in m, or leave the sea out for still water");
  sea::require_positive(tp, object, "tp", "s");
  // Values beyond these belong to no water, and their powers would overflow.
  sea::require(hs >= 1e-6 && hs <= 1e3, object, "hs", hs, "give a significant wave height of 1e-6 to 1000 m");
  sea::require(tp >= 1e-3 && tp <= 1e4, object, "tp", tp, "give a peak period of 0.001 to 10000 s");
  sea::require(std::isfinite(gamma) && gamma >= 1.0, object, "gamma", gamma,
               "give a peak enhancement of 1 (Pierson-Moskowitz) or more; 3.3 is the mean of JONSWAP");
  log_gamma_ = std::log(gamma);
  peak_omega_ = 2.0 * std::numbers::pi / tp;
  scale_ = hs * hs / 16.0 / (shape_moment(0) + excess_integral(excess_from, excess_to, 0));
}

double SpectralPeak::shape(double x) const {
  if (x < shape_from) return 0.0;
  const double r = 1.0 / (x * x);
  const double power = exponent_ == 5.0 ? r * r / x : std::pow(x, -exponent_);
  return power * std::exp(-0.25 * exponent_ * r * r);
}

/// For N = 5 in closed form, exp(-5/4 x^-4) / 5, without cancellation in a narrow band; else by quadrature
/// over ln x up to `tail_from` and a series from there.
double SpectralPeak::shape_integral(double from, double to) const {
  if (to < shape_from) return 0.0;
  const double a = std::max(from, shape_from);
  if (exponent_ == 5.0) {
    const double qa = 1.25 * std::pow(a, -4.0), qb = 1.25 * std::pow(to, -4.0);
    return -0.2 * std::exp(-qb) * std::expm1(qb - qa);
  }
  const auto f = [this](double s) { return std::exp(s) * shape(std::exp(s)); };
  const double body = sea::integrate(f, std::log(a), std::log(std::min(to, tail_from)), 0.1);
  const double far = std::max(a, tail_from);
  return to > far ? body + shape_tail(far) - shape_tail(to) : body;
}

/// Integral from x >= tail_from to infinity: the exponential in its power series.
double SpectralPeak::shape_tail(double from) const {
  const double z = -0.25 * exponent_ * std::pow(from, -4.0), order = exponent_ - 1.0;
  double power = std::pow(from, -order), sum = power / order;
  for (int k = 1; std::fabs(power) > 1e-18 * sum; ++k) {
    power *= z / k;
    sum += power / (order + 4.0 * k);
  }
  return sum;
}

/// Integral of x^order times the shape over all x: substitution u = N/4 x^-4.
double SpectralPeak::shape_moment(int order) const {
  const double p = 0.25 * (exponent_ - 1.0 - order);
  return 0.25 * std::pow(0.25 * exponent_, -p) * std::tgamma(p);
}

double SpectralPeak::excess(double x) const {
  const double d = (x - 1.0) / (x <= 1.0 ? sigma_below : sigma_above);
  return shape(x) * std::expm1(log_gamma_ * std::exp(-0.5 * d * d));
}

double SpectralPeak::excess_integral(double from, double to, int order) const {
  if (log_gamma_ == 0.0) return 0.0;
  const auto f = [&](double x) { return std::pow(x, order) * excess(x); };
  // Split at the peak, where sigma changes and the second derivative jumps.
  const double a = std::clamp(from, excess_from, excess_to), b = std::clamp(to, excess_from, excess_to);
  return sea::integrate(f, a, std::min(b, 1.0), 0.25 * sigma_below) +
         sea::integrate(f, std::max(a, 1.0), b, 0.25 * sigma_above);
}

double SpectralPeak::density(double omega) const {
  if (omega <= 0.0) return 0.0;
  const double x = omega / peak_omega_;
  return scale_ / peak_omega_ * (shape(x) + excess(x));
}

double SpectralPeak::energy(double omega_min, double omega_max) const {
  const double a = omega_min / peak_omega_, b = omega_max / peak_omega_;
  return scale_ * (shape_integral(a, b) + excess_integral(a, b, 0));
}

double SpectralPeak::moment(int order) const {
  return scale_ * std::pow(peak_omega_, order) *
         (shape_moment(order) + excess_integral(excess_from, excess_to, order));
}

int SpectralPeak::highest_moment() const { return static_cast<int>(std::ceil(exponent_ - 1.0)) - 1; }

}  // namespace seacrane
