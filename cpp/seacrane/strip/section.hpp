#pragma once

#include <Eigen/Core>
#include <string>

namespace seacrane::strip {

/// Points (p, 2) of y, z in m on the port half of a port-starboard symmetric section, from the still waterline
/// (z = 0) to the keel on the centre line (y = 0).
using HalfSection = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// Throws std::invalid_argument, naming `name`, the point and the fix, unless the points are finite, within
/// y >= 0 and z <= 0, start on the waterline, end on the centre line below it, and do not cross themselves.
void require_half_section(const HalfSection& section, const std::string& name);

/// Area of the whole section below the waterline, m2.
double area(const HalfSection& section);

}  // namespace seacrane::strip
