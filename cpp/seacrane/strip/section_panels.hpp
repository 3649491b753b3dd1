#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

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

/// Straight panels on the port half as a chain of nodes y + i z: first the interior free surface (the lid)
/// from the centre line to the side, then the hull from the waterline to the keel. Panel j runs from node j
/// to node j + 1; i times its direction points into the fluid.
struct SectionPanels {
  std::vector<std::complex<double>> node;
  std::size_t lid = 0;  // panels on the lid

  std::size_t count() const { return node.empty() ? 0 : node.size() - 1; }
  std::complex<double> start(std::size_t j) const { return node[j]; }
  std::complex<double> end(std::size_t j) const { return node[j + 1]; }
  std::complex<double> middle(std::size_t j) const { return 0.5 * (node[j] + node[j + 1]); }
  double length(std::size_t j) const { return std::abs(node[j + 1] - node[j]); }
  std::complex<double> direction(std::size_t j) const { return (node[j + 1] - node[j]) / length(j); }
  std::complex<double> normal(std::size_t j) const { return std::complex<double>(0.0, 1.0) * direction(j); }
};

/// About `panels` panels on a checked section, finer towards its corners, and a lid.
SectionPanels make_panels(const HalfSection& section, int panels);

}  // namespace seacrane::strip
