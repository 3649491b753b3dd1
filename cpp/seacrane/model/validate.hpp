#pragma once

#include "seacrane/elements/check.hpp"
#include "seacrane/model/description.hpp"

namespace seacrane {

/// Checks every description by itself and all names; throws SceneError.
void validate(const SceneDescription& scene);

}  // namespace seacrane
