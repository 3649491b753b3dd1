#pragma once

#include "seacrane/integrate/position_map.hpp"
#include "seacrane/integrate/residual_system.hpp"
#include "seacrane/integrate/stiff_part.hpp"
#include "seacrane/integrate/system.hpp"

namespace seacrane {

/// What there is to integrate: the system, and what single methods ask for beside it; null where there is no
/// such thing. All of it must outlive the integrator.
struct Problem {
  System& system;
  PositionMap* positions = nullptr;
  ResidualSystem* residual = nullptr;
  StiffPart* stiff = nullptr;
};

}  // namespace seacrane
