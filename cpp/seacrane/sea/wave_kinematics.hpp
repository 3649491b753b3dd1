#pragma once

#include <array>

#include "seacrane/sea/wave_components.hpp"

namespace seacrane {

/// How linear theory, which ends at z = 0, is taken to the moving surface.
enum class Stretching {
  /// J. D. Wheeler (1970): taken at z' = (z - eta) / (1 + eta / depth), so that the profile of still water
  /// spans from the sea floor to the surface. The pressure vanishes at the surface exactly; below it the
  /// field no longer satisfies Laplace's equation exactly.
  wheeler,
  /// Linear theory itself up to z = 0, above it the values of z = 0.
  none
};

/// Undisturbed wave at one point, inertial axes.
struct WaveParticle {
  double elevation = 0.0;                // m
  std::array<double, 3> velocity{};      // m/s
  std::array<double, 3> acceleration{};  // m/s2: partial derivative in time at the stretched point
  double pressure_per_density = 0.0;     // m2/s2: dynamic, the hydrostatic -g z left out
  bool submerged = false;                // z <= elevation; in air all of the above but elevation is zero
};

/// Linear wave theory at (x, y, z), z up from the still water: potential flow that decays as
/// cosh k(z + depth), without overflow at any depth. Throws for z below the sea floor.
WaveParticle kinematics(const WaveComponents& waves, double t, double x, double y, double z,
                        Stretching stretching = Stretching::wheeler);

}  // namespace seacrane
