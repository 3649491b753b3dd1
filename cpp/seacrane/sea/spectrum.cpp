#include "seacrane/sea/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "seacrane/sea/gauss_legendre.hpp"
#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

constexpr double largest_gamma = 7.0;
constexpr double negligible_height = 0.1;  // of the whole: a hundredth of the energy

template <class Value>
std::string object_of(const Value& name) {
  return std::string(name) + " spectrum";
}

template <class Parts, class Function>
double sum_over(const Parts& parts, const Function& f) {
  double sum = 0.0;
  for (const auto& part : parts) sum += std::visit(f, part);
  return sum;
}

std::array<int, 2> finite_moments(const SpectralPeak& peak) { return {-4, peak.highest_moment()}; }
std::array<int, 2> finite_moments(const SpectralTable& table) { return {table.lowest_moment(), 4}; }

double part_tp(const SpectralPeak& peak) { return peak.tp(); }
double part_tp(const SpectralTable& table) { return 2.0 * std::numbers::pi / table.peak_omega(); }

constexpr double sigma_below = 0.07, sigma_above = 0.09;
// Ten sigma from the peak G is 2e-22; below x = 0.1 the shape underflows to zero.
constexpr double excess_from = 1.0 - 10.0 * sigma_below, excess_to = 1.0 + 10.0 * sigma_above;
constexpr double shape_from = 0.1;
constexpr double tail_from = 3.0;

std::string entry(const char* name, std::size_t i) {
  return std::string(name) + '[' + std::to_string(i) + ']';
}

}  // namespace

double dnv_gamma(double hs, double tp) {
  sea::require_positive(hs, "gamma by DNV-RP-C205", "hs", "m");
  sea::require_positive(tp, "gamma by DNV-RP-C205", "tp", "s");
  const double ratio = tp / std::sqrt(hs);
  if (ratio <= 3.6) return 5.0;
  return ratio >= 5.0 ? 1.0 : std::exp(5.75 - 1.15 * ratio);
}

Spectrum::Spectrum(std::string name, std::vector<Part> parts, double hs, double tp)
    : name_(std::move(name)), parts_(std::move(parts)), hs_(hs), tp_(tp) {}

Spectrum Spectrum::jonswap(double hs, double tp, double gamma) {
  const std::string object = object_of("JONSWAP");
  SpectralPeak peak(object, hs, tp, gamma);
  sea::require(gamma <= largest_gamma, object, "gamma", gamma,
               "give a peak enhancement of 7 or less: none above it was measured (DNV-RP-C205: 1 to 5)");
  return {"JONSWAP", {std::move(peak)}, hs, tp};
}

Spectrum Spectrum::pierson_moskowitz(double hs, double tp) {
  return {"Pierson-Moskowitz", {SpectralPeak(object_of("Pierson-Moskowitz"), hs, tp, 1.0)}, hs, tp};
}

Spectrum Spectrum::torsethaugen(double hs, double tp, double gravity) {
  const std::string object = object_of("Torsethaugen");
  const SpectralPeak whole(object, hs, tp, 1.0, 4.0);  // refuses bad input before it is used
  sea::require_positive(gravity, object, "gravity", "m/s2");
  constexpr double kept_wind = 0.7, kept_swell = 0.6, longest = 25.0;
  const double fully_developed = 6.6 * std::cbrt(hs);
  const auto steepness_gamma = [&](double height, double period) {
    return 35.0 * std::pow(2.0 * std::numbers::pi * height / (gravity * period * period), 0.857);
  };
  const auto share = [](double kept, double distance, double decay) {
    const double q = std::min(distance, 1.0) / decay;
    return kept + (1.0 - kept) * std::exp(-q * q);
  };
  double ratio = 1.0, gamma = 1.0, second_tp = 0.0;
  if (tp <= fully_developed) {
    const double shortest = 2.0 * std::sqrt(hs);
    ratio = share(kept_wind, (fully_developed - tp) / (fully_developed - shortest), 0.5);
    gamma = steepness_gamma(ratio * hs, tp);
    second_tp = fully_developed + 2.0;
  } else {
    // Only a sea of 54 m is fully developed at 25 s: there is no swell longer than it.
    sea::require(fully_developed < longest, object, "hs", hs, "give a height below 54 m");
    const double distance = (tp - fully_developed) / (longest - fully_developed);
    ratio = share(kept_swell, distance, 0.3);
    gamma = steepness_gamma(hs, fully_developed) * (1.0 + 6.0 * std::min(distance, 1.0));
  }
  const double second_hs = std::sqrt(1.0 - ratio * ratio) * hs;
  if (second_tp == 0.0) second_tp = 6.6 * std::cbrt(second_hs);
  std::vector<Part> parts{SpectralPeak(object, ratio * hs, tp, std::max(gamma, 1.0), 4.0)};
  if (second_hs > 1e-6) parts.emplace_back(SpectralPeak(object, second_hs, second_tp, 1.0, 4.0));
  return {"Torsethaugen", std::move(parts), hs, tp};
}

Spectrum Spectrum::ochi_hubble(const std::array<double, 2>& hs, const std::array<double, 2>& tp,
                               const std::array<double, 2>& lambda) {
  const std::string object = object_of("Ochi-Hubble");
  std::vector<Part> parts;
  std::array<double, 2> top{};
  for (std::size_t i = 0; i < 2; ++i) {
    sea::require(lambda[i] > 0.5 && lambda[i] <= 20.0, object, "lambda", lambda[i],
                 "give a shape above 0.5 (below it the mean period is zero) and up to 20");
    SpectralPeak peak(object, hs[i], tp[i], 1.0, 4.0 * lambda[i] + 1.0);
    top[i] = peak.density(peak.peak_omega());
    parts.emplace_back(std::move(peak));
  }
  if (top[1] > top[0]) std::swap(parts[0], parts[1]);
  return {"Ochi-Hubble", std::move(parts), std::hypot(hs[0], hs[1]), top[1] > top[0] ? tp[1] : tp[0]};
}

Spectrum Spectrum::tabulated(std::vector<double> omega, std::vector<double> density) {
  SpectralTable table(object_of("tabulated"), std::move(omega), std::move(density));
  const double hs = table.hs(), tp = part_tp(table);
  return {"tabulated", {std::move(table)}, hs, tp};
}

double Spectrum::operator()(double omega) const {
  return sum_over(parts_, [omega](const auto& part) { return part.density(omega); });
}

double Spectrum::energy(double omega_min, double omega_max) const {
  const std::string object = object_of(name_);
  sea::require(omega_min >= 0.0, object, "minimum_omega", omega_min,
               "give a frequency of zero or more in rad/s");
  sea::require(omega_max >= omega_min, object, "maximum_omega", omega_max, "give at least minimum_omega");
  return sum_over(parts_, [=](const auto& part) { return part.energy(omega_min, omega_max); });
}

double Spectrum::moment(int order) const {
  int low = -4, high = 4;
  for (const Part& part : parts_) {
    const auto [from, to] = std::visit([](const auto& p) { return finite_moments(p); }, part);
    low = std::max(low, from);
    high = std::min(high, to);
  }
  sea::require(order >= low && order <= high, object_of(name_), "moment order", order,
               "give " + std::to_string(low) + " to " + std::to_string(high) +
                   ": others are infinite, or beyond any use");
  return sum_over(parts_, [order](const auto& part) { return part.moment(order); });
}

double Spectrum::steepness(double gravity) const {
  sea::require_positive(gravity, object_of(name_), "gravity", "m/s2");
  return hs_ * 2.0 * std::numbers::pi / (gravity * tp_ * tp_);
}

std::vector<Spectrum> Spectrum::parts() const {
  std::vector<Spectrum> out;
  for (const Part& part : parts_) {
    std::visit([&](const auto& p) { out.push_back(Spectrum(name_, {p}, p.hs(), part_tp(p))); }, part);
  }
  return out;
}

std::array<double, 2> Spectrum::default_range() const {
  if (const auto* table = std::get_if<SpectralTable>(&parts_.front())) return {table->first(), table->last()};
  std::array<double, 2> range{0.3, 2.5};
  for (const Part& part : parts_) {
    const auto [peak, hs] = std::visit([](const auto& p) { return std::pair(p.peak_omega(), p.hs()); }, part);
    if (hs < negligible_height * hs_) continue;
    range = {std::min(range[0], 0.5 * peak), std::max(range[1], 3.0 * peak)};
  }
  return range;
}

std::optional<double> Spectrum::gamma() const {
  const auto* peak = std::get_if<SpectralPeak>(&parts_.front());
  return peak == nullptr ? std::nullopt : std::optional(peak->gamma());
}

double Spectrum::peak_omega() const {
  return std::visit([](const auto& part) { return part.peak_omega(); }, parts_.front());
}

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
