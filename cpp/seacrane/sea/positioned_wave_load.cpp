#include "seacrane/sea/positioned_wave_load.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "seacrane/math/dual.hpp"
#include "seacrane/sea/sincos.hpp"

namespace seacrane {

PositionedWaveLoad::PositionedWaveLoad(WaveComponents waves, ForceByHeading force, DriftByHeading drift,
                                       double cutoff)
    : waves_(std::move(waves)), force_(std::move(force)), drift_(std::move(drift)), cutoff_(cutoff) {
  if (!std::isfinite(cutoff) || cutoff < 0.0) {
    throw std::invalid_argument("cut-off is " + std::to_string(cutoff) +
                                " rad/s; make it positive, or 0 for loads at the pose of the moment");
  }
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const double k = waves_.wavenumber()[i], b = waves_.direction()[i];
    along_x_.push_back(k * std::cos(b));
    along_y_.push_back(k * std::sin(b));
    largest_omega_ = std::max(largest_omega_, waves_.omega()[i]);
    largest_wavenumber_ = std::max(largest_wavenumber_, k);
    largest_phase_ = std::max(largest_phase_, std::fabs(waves_.phase()[i]));
  }
}

void PositionedWaveLoad::evaluate(double t, double x, double y, double yaw, PositionedLoad& out) const {
  constexpr std::size_t chunk = 64;  // phases held on the stack
  double angle[chunk], sine[chunk], cosine[chunk];
  double force[6] = {}, elevation = 0.0;
  double envelope[2] = {}, drift[2][6] = {};
  const double largest =
      largest_omega_ * std::fabs(t) + largest_wavenumber_ * (std::fabs(x) + std::fabs(y)) + largest_phase_;
  double direction = std::nan("");
  SplinePlace<double> in_force, in_drift;
  for (std::size_t first = 0; first < waves_.size(); first += chunk) {
    const std::size_t count = std::min(chunk, waves_.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t n = first + i;
      angle[i] = waves_.omega()[n] * t + (waves_.phase()[n] - (along_x_[n] * x + along_y_[n] * y));
    }
    sea::sincos_each(angle, count, largest, sine, cosine);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t n = first + i;
      if (waves_.direction()[n] != direction) {
        direction = waves_.direction()[n];
        in_force = force_.place(direction - yaw);
        if (has_drift()) in_drift = drift_.place(direction - yaw);
      }
      const double a = waves_.amplitude()[n], re = a * cosine[i], im = a * sine[i];
      double transfer[12];
      force_.at(n, in_force, transfer);
      for (std::size_t j = 0; j < 6; ++j) force[j] += re * transfer[2 * j] - im * transfer[2 * j + 1];
      elevation += re;
      if (!has_drift()) continue;
      double d[6];
      drift_.at(n, in_drift, d);
      envelope[0] += re;
      envelope[1] += im;
      for (std::size_t j = 0; j < 6; ++j) drift[0][j] += re * d[j];
      for (std::size_t j = 0; j < 6; ++j) drift[1][j] += im * d[j];
    }
  }
  out.elevation = elevation;
  for (std::size_t j = 0; j < 6; ++j) {
    out.force[j] = force[j];
    out.drift[j] = envelope[0] * drift[0][j] + envelope[1] * drift[1][j];
  }
}

void PositionedWaveLoad::slopes(double t, double x, double y, double yaw, double (&out)[6][3]) const {
  using T = Dual<3>;
  const T here[3] = {T::variable(x, 0), T::variable(y, 1), T::variable(yaw, 2)};
  T force[6], envelope[2], drift[2][6];
  for (std::size_t n = 0; n < waves_.size(); ++n) {
    const T angle =
        T(waves_.omega()[n] * t + waves_.phase()[n]) - along_x_[n] * here[0] - along_y_[n] * here[1];
    const double a = waves_.amplitude()[n];
    const T wave[2] = {a * cos(angle), a * sin(angle)};
    const T heading = T(waves_.direction()[n]) - here[2];
    T transfer[12];
    force_.at(n, force_.place(heading), transfer);
    for (std::size_t j = 0; j < 6; ++j) {
      force[j] += wave[0] * transfer[2 * j] - wave[1] * transfer[2 * j + 1];
    }
    if (!has_drift()) continue;
    T d[6];
    drift_.at(n, drift_.place(heading), d);
    for (std::size_t part = 0; part < 2; ++part) {
      envelope[part] += wave[part];
      for (std::size_t j = 0; j < 6; ++j) drift[part][j] += wave[part] * d[j];
    }
  }
  for (std::size_t j = 0; j < 6; ++j) {
    const T sum = force[j] + envelope[0] * drift[0][j] + envelope[1] * drift[1][j];
    for (std::size_t i = 0; i < 3; ++i) out[j][i] = sum.slope[i];
  }
}

}  // namespace seacrane
