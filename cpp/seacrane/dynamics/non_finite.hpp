#pragma once

#include <string>

#include "seacrane/dynamics/maximal.hpp"

namespace seacrane {

/// What is not finite at (t, y), named with its value: a state, a load, the rows of a joint or what comes of
/// them; empty where all is. For the report of a run that had to stop: loads are evaluated one by one.
std::string name_non_finite(MaximalSystem& system, double t, const double* y);

}  // namespace seacrane
