#pragma once

#include <string>
#include <vector>

#include "seacrane/math/curve.hpp"

namespace seacrane {

/// Through samples, held at rest before the first and after the last. Between them straight ("linear"), or
/// with continuous rate and acceleration and at rest at both ends ("cubic"), so that a driver may follow it.
Curve tabulated(const std::vector<double>& times, const std::vector<double>& values,
                const std::string& between);

}  // namespace seacrane
