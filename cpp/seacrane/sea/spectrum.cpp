#include "seacrane/sea/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

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

}  // namespace seacrane
