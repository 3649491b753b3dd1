#pragma once

#include <complex>
#include <vector>

#include "seacrane/strip/section.hpp"

namespace seacrane::strip {

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
