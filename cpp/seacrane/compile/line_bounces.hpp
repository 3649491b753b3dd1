#pragma once

#include <vector>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// The bounces of the lines of a model at its start, with its limits open and in water without waves: what
/// of a load is wet does not depend on the phases of a sea. A line that moves nothing there has none, and
/// neither has the paper's vessel, whose masses have no response to loads.
std::vector<LineBounce> find_line_bounces(const Model& model);

/// Gives lines without a mass of their own that of their bounce.
void hang_on_lines(Model& model, const std::vector<LineBounce>& bounces);

}  // namespace seacrane
