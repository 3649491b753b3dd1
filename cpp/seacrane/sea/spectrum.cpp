#include "seacrane/sea/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "seacrane/sea/gauss_legendre.hpp"
#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

constexpr double sigma_below = 0.07, sigma_above = 0.09;
// Ten sigma from the peak G is 2e-22; below x = 0.1 the shape underflows to zero.
constexpr double excess_from = 1.0 - 10.0 * sigma_below, excess_to = 1.0 + 10.0 * sigma_above;
constexpr double shape_from = 0.1;

/// Pierson-Moskowitz shape: x^-5 exp(-5/4 x^-4).
double shape(double x) {
  if (x < shape_from) return 0.0;
  const double r = 1.0 / (x * x);
  return r * r / x * std::exp(-1.25 * r * r);
}

/// Its integral from a to b in closed form, exp(-5/4 x^-4) / 5, without cancellation in a narrow band.
double shape_integral(double a, double b) {
  if (b < shape_from) return 0.0;
  const double qa = 1.25 * std::pow(std::max(a, shape_from), -4.0), qb = 1.25 * std::pow(b, -4.0);
  return -0.2 * std::exp(-qb) * std::expm1(qb - qa);
}

/// Integral of x^order times the shape over all x: substitution u = 5/4 x^-4.
double shape_moment(int order) {
  const double p = 0.25 * order;
  return 0.25 * std::pow(1.25, p - 1.0) * std::tgamma(1.0 - p);
}

}  // namespace

Spectrum::Spectrum(std::string name, double hs, double tp, double gamma)
    : name_(std::move(name)), hs_(hs), tp_(tp), gamma_(gamma) {
  const std::string object = name_ + " spectrum";
  sea::require(std::isfinite(hs) && hs > 0.0, object, "hs", hs,
               "give a significant wave height above zero in m, or leave the sea out for still water");
  sea::require_positive(tp, object, "tp", "s");
  sea::require(std::isfinite(gamma) && gamma >= 1.0, object, "gamma", gamma,
               "give a peak enhancement of 1 (Pierson-Moskowitz) or more; 3.3 is the mean of JONSWAP");
  log_gamma_ = std::log(gamma);
  peak_omega_ = 2.0 * std::numbers::pi / tp;
  scale_ = hs * hs / 16.0 / (shape_moment(0) + excess_integral(excess_from, excess_to, 0));
}

Spectrum Spectrum::jonswap(double hs, double tp, double gamma) { return {"JONSWAP", hs, tp, gamma}; }

Spectrum Spectrum::pierson_moskowitz(double hs, double tp) { return {"Pierson-Moskowitz", hs, tp, 1.0}; }

double Spectrum::excess(double x) const {
  const double d = (x - 1.0) / (x <= 1.0 ? sigma_below : sigma_above);
  return shape(x) * std::expm1(log_gamma_ * std::exp(-0.5 * d * d));
}

double Spectrum::excess_integral(double from, double to, int order) const {
  if (log_gamma_ == 0.0) return 0.0;
  const auto f = [&](double x) { return std::pow(x, order) * excess(x); };
  // Split at the peak, where sigma changes and the second derivative jumps.
  const double a = std::clamp(from, excess_from, excess_to), b = std::clamp(to, excess_from, excess_to);
  return sea::integrate(f, a, std::min(b, 1.0), 0.25 * sigma_below) +
         sea::integrate(f, std::max(a, 1.0), b, 0.25 * sigma_above);
}

double Spectrum::operator()(double omega) const {
  if (omega <= 0.0) return 0.0;
  const double x = omega / peak_omega_;
  return scale_ / peak_omega_ * (shape(x) + excess(x));
}

double Spectrum::energy(double omega_min, double omega_max) const {
  const std::string object = name_ + " spectrum";
  sea::require(omega_min >= 0.0, object, "omega_min", omega_min, "give a frequency of zero or more in rad/s");
  sea::require(omega_max >= omega_min, object, "omega_max", omega_max, "give at least omega_min");
  const double a = omega_min / peak_omega_, b = omega_max / peak_omega_;
  return scale_ * (shape_integral(a, b) + excess_integral(a, b, 0));
}

double Spectrum::moment(int order) const {
  sea::require(order >= -4 && order <= 3, name_ + " spectrum", "moment order", order,
               "give -4 to 3: the tail of omega^-5 makes higher moments infinite");
  return scale_ * std::pow(peak_omega_, order) *
         (shape_moment(order) + excess_integral(excess_from, excess_to, order));
}

double Spectrum::steepness(double gravity) const {
  sea::require_positive(gravity, name_ + " spectrum", "gravity", "m/s2");
  return hs_ * 2.0 * std::numbers::pi / (gravity * tp_ * tp_);
}

}  // namespace seacrane
