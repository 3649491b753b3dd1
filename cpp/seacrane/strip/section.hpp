#pragma once

#include <Eigen/Core>
#include <string>

namespace seacrane::strip {

/// Points (p, 2) of y, z in m on the port half of a port-starboard symmetric section, from the still
/// waterline (z = 0) to the keel on the centre line (y = 0).
using HalfSection = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The section without repeated points and with its ends put exactly on the waterline and the centre line.
/// A pointed end, all points at the origin, comes back empty.
///
/// Throws std::invalid_argument, naming `name`, the point and the fix, unless there are at least three finite
/// points with y >= 0 and z <= 0, the first on the waterline, the others below it, the last on the centre
/// line, and no two sides cross. Offsets below a millionth of the section's size count as zero.
HalfSection checked(const HalfSection& section, const std::string& name);

/// The section widened where it is thinner than an ellipse of 2 % of its draught, and deepened where it is
/// shallower than 2 % of its half breadth: a stem line then answers in sway as the plate that it is.
HalfSection thickened(const HalfSection& section);

}  // namespace seacrane::strip
