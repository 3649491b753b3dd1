#pragma once

#include <vector>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// Those of the lines of a model whose limits are open, at its start; none of lines that move nothing there,
/// nor with the paper's masses, which have no response to loads.
std::vector<LineBounce> find_line_bounces(const Model& model);

/// Gives lines without a mass of their own that of their bounce.
void hang_on_lines(Model& model, const std::vector<LineBounce>& bounces);

}  // namespace seacrane
