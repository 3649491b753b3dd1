#include "seacrane/sea/wave_components.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "seacrane/sea/current.hpp"
#include "seacrane/sea/require.hpp"
#include "seacrane/sea/sincos.hpp"

namespace seacrane {
namespace {

constexpr double repeat_threshold = 0.99;
const char* const kComponents = "wave components";

void require_each(const std::vector<double>& values, const std::string& name, std::size_t count,
                  double smallest, const std::string& fix) {
  sea::require(values.size() == count, kComponents, "length of " + name, values.size(),
               "give one value per frequency (" + std::to_string(count) + ")");
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isfinite(values[i]) && values[i] >= smallest) continue;
    sea::require(false, kComponents, name + "[" + std::to_string(i) + "]", values[i], fix);
  }
}

/// use(i, cos, sin) of angle(i) for i = 0 .. count - 1, in order; in blocks, so that the functions are SIMD.
template <class Angle, class Use>
void for_each_phasor(std::size_t count, const Angle& angle, const Use& use) {
  constexpr std::size_t block = 64;
  double angles[block], sine[block], cosine[block];
  for (std::size_t from = 0; from < count; from += block) {
    const std::size_t n = std::min(block, count - from);
    double largest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      angles[i] = angle(from + i);
      largest = std::max(largest, std::fabs(angles[i]));
    }
    sea::sincos_of(angles, n, largest, 1.0, sine, cosine);
    for (std::size_t i = 0; i < n; ++i) use(from + i, cosine[i], sine[i]);
  }
}

struct Correlation {
  double value, slope;
  double envelope;  // no less than the value, and slower
};

Correlation correlation(const WaveComponents& waves, double lag) {
  double value = 0.0, quadrature = 0.0, slope = 0.0, sum = 0.0;
  for_each_phasor(
      waves.size(), [&](std::size_t i) { return waves.omega()[i] * lag; },
      [&](std::size_t i, double cosine, double sine) {
        const double energy = waves.amplitude()[i] * waves.amplitude()[i];
        value += energy * cosine;
        quadrature += energy * sine;
        slope -= energy * waves.omega()[i] * sine;
        sum += energy;
      });
  return {value / sum, slope / sum, std::hypot(value, quadrature) / sum};
}

}  // namespace

WaveComponents::WaveComponents(std::vector<double> omega, std::vector<double> amplitude,
                               std::vector<double> phase, std::vector<double> direction, double depth,
                               double gravity, Current current)
    : omega_(std::move(omega)),
      amplitude_(std::move(amplitude)),
      phase_(std::move(phase)),
      direction_(std::move(direction)),
      depth_(depth),
      gravity_(gravity),
      current_(std::move(current)) {
  const std::size_t n = omega_.size();
  sea::require(n > 0, kComponents, "number of components", n, "give at least one");
  sea::require(depth > 0.0, kComponents, "depth", depth, "give a depth above zero in m, or infinity");
  sea::require_positive(gravity, kComponents, "gravity", "m/s2");
  constexpr double any = std::numeric_limits<double>::lowest();
  require_each(omega_, "omega", n, std::numeric_limits<double>::min(),
               "give a frequency above zero in rad/s");
  require_each(amplitude_, "amplitude", n, 0.0, "give an amplitude of zero or more in m");
  require_each(phase_, "phase", n, any, "give a finite phase in rad");
  require_each(direction_, "direction", n, any, "give a finite direction in rad");
  for (std::size_t i = 0; i < n; ++i) {
    const bool again = i > 0 && direction_[i] == direction_[i - 1];  // in a long-crested sea
    direction_x_.push_back(again ? direction_x_.back() : std::cos(direction_[i]));
    direction_y_.push_back(again ? direction_y_.back() : std::sin(direction_[i]));
  }
  for (std::size_t i = 0; i < n; ++i) add_wavenumber(i);
}

void WaveComponents::add_wavenumber(std::size_t i) {
  const double w = omega_[i], x = direction_x_[i], y = direction_y_[i];
  const double k = current_.wavenumber(w, x, y, depth_, gravity_);
  if (std::isnan(k)) {
    sea::require(false, kComponents, "omega[" + std::to_string(i) + "]", w,
                 "the current stops this wave, which comes against it; leave it out");
  }
  wavenumber_.push_back(k);
  intrinsic_.push_back(current_.any() ? w - k * current_.carrying(k, x, y, depth_) : w);
}

double WaveComponents::phase_at(std::size_t i, double x, double y) const {
  return phase_[i] - wavenumber_[i] * (x * direction_x_[i] + y * direction_y_[i]);
}

double WaveComponents::elevation(double t, double x, double y) const {
  double sum = 0.0;
  for_each_phasor(
      size(), [&](std::size_t i) { return omega_[i] * t + phase_at(i, x, y); },
      [&](std::size_t i, double cosine, double) { sum += amplitude_[i] * cosine; });
  return sum;
}

double WaveComponents::moment(int order) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    sum += std::pow(omega_[i], order) * 0.5 * amplitude_[i] * amplitude_[i];
  }
  return sum;
}

double WaveComponents::realised_hs() const { return 4.0 * std::sqrt(moment(0)); }

double WaveComponents::mean_period() const {
  const double m0 = moment(0);
  sea::require_positive(m0, kComponents, "energy m0", "m2: a sea at rest has no period");
  return 2.0 * std::numbers::pi * std::sqrt(m0 / moment(2));
}

double WaveComponents::autocorrelation(double lag) const {
  sea::require_finite(lag, kComponents, "lag", "s");
  sea::require_positive(moment(0), kComponents, "energy m0", "m2: a sea at rest has no autocorrelation");
  return correlation(*this, lag).value;
}

RepeatPeriod WaveComponents::repeat_period(double horizon) const {
  sea::require_positive(horizon, kComponents, "horizon", "s");
  const double m0 = moment(0);
  sea::require_positive(m0, kComponents, "energy m0", "m2: a sea at rest does not repeat");
  const double curvature = moment(2) / m0;
  const double shortest = 1e-6 / std::sqrt(curvature);
  // The envelope, |sum of p exp(i (w - mean) lag)|, changes by no more than sum of p |w - mean| a second.
  const double spread = std::sqrt(std::max(curvature - std::pow(moment(1) / m0, 2), 0.0));
  double lag = 0.0;
  bool decayed = false;
  while (lag < horizon) {
    const auto [value, slope, envelope] = correlation(*this, lag);
    if (!decayed) {
      decayed = value < 0.5;
      lag += 0.05 / std::sqrt(curvature);
      continue;
    }
    if (value >= repeat_threshold) return {lag, true};
    // value + slope s + curvature s^2 / 2 stays below the threshold up to this s.
    const double room = repeat_threshold - value;
    const double root = std::sqrt(slope * slope + 2.0 * curvature * room);
    const double step = slope > 0.0 ? 2.0 * room / (slope + root) : (root - slope) / curvature;
    if (step < shortest) return {lag, true};
    lag += std::max(step, (repeat_threshold - envelope) / spread);
  }
  return {horizon, false};
}

}  // namespace seacrane
