#pragma once

#include <vector>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// The one list of all that curves of time do to a model: drivers and loads, by time. Accelerations are those
/// at the described start.
std::vector<Kink> find_kinks(const Model& model);

}  // namespace seacrane
