#pragma once

#include <memory>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// With `merge`, a second model in which bodies that move as one are merged goes with it, for stepping.
std::shared_ptr<const Model> compile(const SceneDescription& scene, bool merge = true);

/// The model of the same scene in which other limits hold; only `initial_state` is not assembled.
std::shared_ptr<const Model> compile_set(const Model& model, ClosedSet closed);

}  // namespace seacrane
