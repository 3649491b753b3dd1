#pragma once

#include <string>
#include <utility>
#include <vector>

#include "seacrane/dynamics/maximal.hpp"

namespace seacrane {

/// Nanoseconds per evaluation by part, each repeated `count` times at (t, y).
std::vector<std::pair<std::string, double>> time_parts(MaximalSystem& system, double t, const double* y,
                                                       long count);

}  // namespace seacrane
