#pragma once

#include <string>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// What tells two compiled scenes apart in what runs side by side share, such as "joint 'pin' (kind)"; empty:
/// nothing. They may differ in the values of their waves, in their start but for where vessels are at rest,
/// in the mass and inertia of bodies without hydrodynamics, and in the parameters of their loads. What is
/// only recorded does not count.
std::string difference(const Model& one, const Model& other);

/// Whether their loads of a kind, or bodies on which these act, have other numbers.
bool loads_differ(const Model& one, const Model& other, const LoadKind& kind);

}  // namespace seacrane
