#pragma once

#include "seacrane/model/model.hpp"

namespace seacrane {

/// Throws SceneError where the rigid and added masses of a group at the start are not positive definite. Its
/// bodies and vessels are in the model.
void check_mass(const HydroGroupDescription& d, const HydroGroup& group, const Model& model);

}  // namespace seacrane
