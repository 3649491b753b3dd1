#pragma once

#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

/// The force of a limit that holds, from the multipliers `lambda` of the model of `terms`, positive in the
/// direction in which it can act: tension of a wire, push of a stop, pressure on a seat.
double limit_force(const Limit& limit, const Terms& terms, const double* lambda);

}  // namespace seacrane
