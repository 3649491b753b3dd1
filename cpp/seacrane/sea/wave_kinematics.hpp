#pragma once

#include <array>

#include "seacrane/sea/stretching.hpp"
#include "seacrane/sea/wave_components.hpp"

namespace seacrane {

/// Undisturbed wave at one point, inertial axes.
struct WaveParticle {
  double elevation = 0.0;            // m
  std::array<double, 3> velocity{};  // m/s, with the current
  std::array<double, 3>
      acceleration{};                 // m/s2, of the water: partial derivative in time, and along a current
  double pressure_per_density = 0.0;  // m2/s2: dynamic, the hydrostatic -g z left out
  bool submerged = false;             // z <= elevation; in air all of the above but elevation is zero
};

/// Linear wave theory at (x, y, z), z up from the still water: potential flow that decays as
/// cosh k(z + depth), without overflow at any depth. Throws for z below the sea floor.
WaveParticle kinematics(const WaveComponents& waves, double t, double x, double y, double z,
                        Stretching stretching = Stretching::wheeler);

}  // namespace seacrane
