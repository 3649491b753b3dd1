#include "seacrane/strip/section_panels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seacrane/strip/complex.hpp"

namespace seacrane::strip {
namespace {

constexpr double corner_angle = 30.0 * std::numbers::pi / 180.0;

/// Turning angle between two directions, 0 to pi.
double turn(Complex before, Complex after) { return std::abs(std::arg(after / before)); }

/// Fraction of the arc for the fraction j / n of the panels: panels shrink towards the ends that are corners.
double graded(double t, bool from_corner, bool to_corner) {
  const double pi = std::numbers::pi;
  if (from_corner && to_corner) return 0.5 * (1.0 - std::cos(pi * t));
  if (from_corner) return 1.0 - std::cos(0.5 * pi * t);
  if (to_corner) return std::sin(0.5 * pi * t);
  return t;
}

/// Point at a fraction of the length of a polyline.
Complex along(const std::vector<Complex>& line, const std::vector<double>& arc, double fraction) {
  const double wanted = fraction * arc.back();
  const auto above = std::upper_bound(arc.begin() + 1, arc.end() - 1, wanted);
  const auto i = static_cast<std::size_t>(above - arc.begin());
  return line[i - 1] + (line[i] - line[i - 1]) * (wanted - arc[i - 1]) / (arc[i] - arc[i - 1]);
}

std::vector<double> arc_length(const std::vector<Complex>& line) {
  std::vector<double> arc{0.0};
  for (std::size_t i = 1; i < line.size(); ++i) arc.push_back(arc.back() + std::abs(line[i] - line[i - 1]));
  return arc;
}

void append(std::vector<Complex>& node, const std::vector<Complex>& piece, double count, bool from_corner,
            bool to_corner) {
  const std::vector<double> arc = arc_length(piece);
  const double n = std::max(1.0, std::round(count * arc.back()));
  for (double j = 1.0; j < n; ++j) node.push_back(along(piece, arc, graded(j / n, from_corner, to_corner)));
  node.push_back(piece.back());
}

}  // namespace

SectionPanels make_panels(const HalfSection& section, int panels) {
  SectionPanels out;
  if (section.rows() == 0) return out;
  std::vector<Complex> outline;
  for (Eigen::Index i = 0; i < section.rows(); ++i) outline.emplace_back(section(i, 0), section(i, 1));
  const double per_metre = panels / arc_length(outline).back();
  const double half_breadth = outline.front().real();
  out.node.emplace_back(0.0, 0.0);
  append(out.node, {0.0, half_breadth}, std::max(4.0 / half_breadth, 0.5 * per_metre), false, true);
  out.lid = out.node.size() - 1;

  bool from_corner = true;  // the waterline
  std::vector<Complex> piece{outline.front()};
  for (std::size_t i = 1; i < outline.size(); ++i) {
    piece.push_back(outline[i]);
    const Complex before = outline[i] - outline[i - 1];
    const bool keel = i + 1 == outline.size();
    const bool corner = turn(before, keel ? Complex(-1.0, 0.0) : outline[i + 1] - outline[i]) > corner_angle;
    if (!corner && !keel) continue;
    append(out.node, piece, per_metre, from_corner, corner);
    from_corner = corner;
    piece = {outline[i]};
  }
  return out;
}

}  // namespace seacrane::strip
