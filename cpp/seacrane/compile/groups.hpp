#pragma once

#include <string>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// The place of a vessel among those of a scene.
int vessel_of(const SceneDescription& scene, const std::string& name);

/// Adds the groups of a model's scene, whose bodies and vessels it has. Throws SceneError where a memory does
/// not fit, or rigid and added masses of a group at the start are not positive definite.
void add_groups(Model& model);

}  // namespace seacrane
