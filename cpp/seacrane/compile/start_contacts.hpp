#pragma once

#include "seacrane/model/model.hpp"

namespace seacrane {

/// Gives points of contacts their anchors where they are at the start. Throws SceneError where a point starts
/// deep inside: it would be shot out.
void start_contacts(Model& model);

}  // namespace seacrane
