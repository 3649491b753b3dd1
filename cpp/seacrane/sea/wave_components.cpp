#include "seacrane/sea/wave_components.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "seacrane/sea/dispersion.hpp"
#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

constexpr double repeat_threshold = 0.99;
const char* const object = "wave components";

void require_each(const std::vector<double>& values, const std::string& name, std::size_t count,
                  double smallest, const std::string& fix) {
  sea::require(values.size() == count, object, "length of " + name, values.size(),
               "give one value per frequency (" + std::to_string(count) + ")");
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isfinite(values[i]) && values[i] >= smallest) continue;
    sea::require(false, object, name + "[" + std::to_string(i) + "]", values[i], fix);
  }
}

struct Correlation {
  double value, slope;
};

Correlation correlation(const WaveComponents& waves, double lag) {
  double value = 0.0, slope = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const double w = waves.omega()[i], energy = waves.amplitude()[i] * waves.amplitude()[i];
    value += energy * std::cos(w * lag);
    slope -= energy * w * std::sin(w * lag);
    sum += energy;
  }
  return {value / sum, slope / sum};
}

}  // namespace

WaveComponents::WaveComponents(std::vector<double> omega, std::vector<double> amplitude,
                               std::vector<double> phase, std::vector<double> direction, double depth,
                               double gravity)
    : omega_(std::move(omega)),
      amplitude_(std::move(amplitude)),
      phase_(std::move(phase)),
      direction_(std::move(direction)),
      depth_(depth),
      gravity_(gravity) {
  const std::size_t n = omega_.size();
  sea::require(n > 0, object, "number of components", n, "give at least one");
  sea::require(depth > 0.0, object, "depth", depth, "give a depth above zero in m, or infinity");
  sea::require_positive(gravity, object, "gravity", "m/s2");
  constexpr double any = std::numeric_limits<double>::lowest();
  require_each(omega_, "omega", n, std::numeric_limits<double>::min(),
               "give a frequency above zero in rad/s");
  require_each(amplitude_, "amplitude", n, 0.0, "give an amplitude of zero or more in m");
  require_each(phase_, "phase", n, any, "give a finite phase in rad");
  require_each(direction_, "direction", n, any, "give a finite direction in rad");
  for (const double w : omega_) wavenumber_.push_back(seacrane::wavenumber(w, depth, gravity));
  for (const double b : direction_) {
    direction_x_.push_back(std::cos(b));
    direction_y_.push_back(std::sin(b));
  }
}

double WaveComponents::phase_at(std::size_t i, double x, double y) const {
  return phase_[i] - wavenumber_[i] * (x * direction_x_[i] + y * direction_y_[i]);
}

double WaveComponents::elevation(double t, double x, double y) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    sum += amplitude_[i] * std::cos(omega_[i] * t + phase_at(i, x, y));
  }
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
  sea::require_positive(m0, object, "energy m0", "m2: a sea at rest has no period");
  return 2.0 * std::numbers::pi * std::sqrt(m0 / moment(2));
}

double WaveComponents::autocorrelation(double lag) const {
  sea::require_finite(lag, object, "lag", "s");
  sea::require_positive(moment(0), object, "energy m0", "m2: a sea at rest has no autocorrelation");
  return correlation(*this, lag).value;
}

RepeatPeriod WaveComponents::repeat_period(double horizon) const {
  sea::require_positive(horizon, object, "horizon", "s");
  const double m0 = moment(0);
  sea::require_positive(m0, object, "energy m0", "m2: a sea at rest does not repeat");
  const double curvature = moment(2) / m0;
  const double shortest = 1e-6 / std::sqrt(curvature);
  double lag = 0.0;
  bool decayed = false;
  while (lag < horizon) {
    const auto [value, slope] = correlation(*this, lag);
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
    lag += step;
  }
  return {horizon, false};
}

}  // namespace seacrane
