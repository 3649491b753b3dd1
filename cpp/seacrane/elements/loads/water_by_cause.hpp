#pragma once

#include <array>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// Why the water pushes a load: its weight, the undisturbed flow (Du/Dt on volume and added mass), the added
/// mass by the load's own motion, drag, and the growth of added mass on entry.
enum class WaterCause { buoyancy, waves, added_mass, drag, slam };

/// What the water does to a load by each cause: forces (N, inertial frame) with those of accelerations, and
/// what each brings into the energy of the ledger (W). Buoyancy and added mass of a part are in that energy.
struct WaterByCause {
  static constexpr std::size_t kCount = 5;
  std::array<Vec3d, kCount> forces;
  std::array<double, kCount> powers{};
  Vec3d momentum = Vec3d::Zero();  // kg m/s, of the water that goes along, A v
  Vec3d shed = Vec3d::Zero();      // N, what of it stays behind on exit

  WaterByCause() { forces.fill(Vec3d::Zero()); }
  Vec3d& force(WaterCause cause) { return forces[static_cast<std::size_t>(cause)]; }
  double& power(WaterCause cause) { return powers[static_cast<std::size_t>(cause)]; }
};

}  // namespace seacrane
