#pragma once

#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {

/// Of the multipliers `lambda` of `system`, the part of a limit that holds in the direction in which it can
/// act: tension of a wire, push of a stop, pressure on a seat.
double limit_force(const Limit& limit, const RedundantSystem& system, const double* lambda);

}  // namespace seacrane
