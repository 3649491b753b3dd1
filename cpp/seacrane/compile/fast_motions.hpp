#pragma once

#include "seacrane/model/model.hpp"

namespace seacrane {

/// Fast motions of vessels in the initial state, as a steady drift of the velocities there leaves them.
void start_fast_motions(Model& model);

}  // namespace seacrane
