#pragma once

#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

/// Of the multipliers `lambda` of the model of `terms`, the part of a limit that holds in the direction in
/// which it can act: tension of a wire, push of a stop, pressure on a seat.
double limit_force(const Limit& limit, const Terms& terms, const double* lambda);

}  // namespace seacrane
