#pragma once

#include <memory>
#include <vector>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// The compiled scene in another sea: a copy with other wave loads and another field, which is what compiling
/// the scene in that sea gives. The loads are on the same vessels, in the same order, at the same kind of
/// position; SceneError where they are not.
std::shared_ptr<const Model> in_sea(const Model& model, const std::vector<WaveLoadDescription>& loads,
                                    std::shared_ptr<const SeaField> sea);

}  // namespace seacrane
