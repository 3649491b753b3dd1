#pragma once

#include "seacrane/model/model.hpp"

namespace seacrane {

/// Makes the described start consistent: Newton projection of poses and velocities in the mass metric,
/// rank of D, uniqueness of reactions. Writes initial_state, assembly, redundant and unique_reaction.
/// Throws SceneError naming the joints that cannot be closed together.
void assemble(Model& model);

}  // namespace seacrane
