#pragma once

#include <string>

namespace seacrane {

struct Model;

/// What a component of the bodies' state (StateLayout) is, for messages.
std::string describe_state(const Model& model, int component);
/// Describes a state of the fluid memory or of a load, counted from the first of them.
std::string describe_memory(const Model& model, int state);

}  // namespace seacrane
