#include "seacrane/sea/wave_kinematics.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

/// Decay from z = 0 to z <= 0: pressure cosh k(z + d) / cosh kd, horizontal velocity cosh k(z + d) / sinh kd,
/// vertical velocity sinh k(z + d) / sinh kd, from exponentials of negative numbers only.
struct Decay {
  double pressure, horizontal, vertical;
};

Decay decay(double k, double depth, double z) {
  const double deep = std::exp(k * z);
  if (std::isinf(depth)) return {deep, deep, deep};
  const double image = std::exp(-2.0 * k * (z + depth)), floor = std::exp(-2.0 * k * depth);
  const double sinh_floor = -std::expm1(-2.0 * k * depth);
  return {deep * (1.0 + image) / (1.0 + floor), deep * (1.0 + image) / sinh_floor,
          deep * -std::expm1(-2.0 * k * (z + depth)) / sinh_floor};
}

}  // namespace

WaveParticle kinematics(const WaveComponents& waves, double t, double x, double y, double z,
                        Stretching stretching) {
  const double depth = waves.depth();
  sea::require(z >= -depth, "wave kinematics", "z", z,
               "give a height above the sea floor at z = -" + std::to_string(depth) + " m");
  WaveParticle out;
  out.elevation = waves.elevation(t, x, y);
  out.submerged = z <= out.elevation;
  if (!out.submerged) return out;
  const double stretched =
      stretching == Stretching::wheeler ? (z - out.elevation) / (1.0 + out.elevation / depth) : z;
  const double level = std::clamp(stretched, -depth, 0.0);
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const double w = waves.intrinsic()[i], a = waves.amplitude()[i];
    const double angle = waves.omega()[i] * t + waves.phase_at(i, x, y);
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const Decay d = decay(waves.wavenumber()[i], depth, level);
    const double along = a * w * d.horizontal, up = a * w * d.vertical;
    const double bx = waves.direction_x()[i], by = waves.direction_y()[i];
    out.velocity[0] += along * bx * cosine;
    out.velocity[1] += along * by * cosine;
    out.velocity[2] -= up * sine;
    out.acceleration[0] -= w * along * bx * sine;
    out.acceleration[1] -= w * along * by * sine;
    out.acceleration[2] -= w * up * cosine;
    out.pressure_per_density += waves.gravity() * a * d.pressure * cosine;
  }
  const auto current = waves.current().at<double>(level);
  out.velocity[0] += current.x;
  out.velocity[1] += current.y;
  return out;
}

}  // namespace seacrane
