#include "seacrane/strip/section_panels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <vector>

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

constexpr double position_tolerance = 1e-6;  // of the section's size: what slicing a mesh leaves
constexpr double thinnest = 0.02;            // of the other dimension

using Point = Eigen::RowVector2d;

[[noreturn]] void refuse(const std::string& name, Eigen::Index point, const Point& p,
                         const std::string& why) {
  std::ostringstream text;
  text.precision(10);
  text << name << ": point " << point << " at (y, z) = (" << p.x() << ", " << p.y() << ") m " << why;
  throw std::invalid_argument(text.str());
}

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

bool opposite_sides(const Point& a, const Point& b, const Point& c, const Point& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0;
}

void require_simple(const HalfSection& s, const std::string& name) {
  for (Eigen::Index i = 1; i + 1 < s.rows(); ++i) {
    const Point before = s.row(i) - s.row(i - 1), after = s.row(i + 1) - s.row(i);
    if (before.dot(after) < -(1.0 - 1e-12) * before.norm() * after.norm()) {
      refuse(name, i, s.row(i), "is where the outline turns back on itself; remove it");
    }
  }
  for (Eigen::Index i = 0; i + 1 < s.rows(); ++i) {
    for (Eigen::Index j = i + 2; j + 1 < s.rows(); ++j) {
      if (opposite_sides(s.row(i), s.row(i + 1), s.row(j), s.row(j + 1)) &&
          opposite_sides(s.row(j), s.row(j + 1), s.row(i), s.row(i + 1))) {
        refuse(name, j, s.row(j),
               "begins a side that crosses the side after point " + std::to_string(i) +
                   "; order the points along the outline");
      }
    }
  }
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

HalfSection checked(const HalfSection& section, const std::string& name) {
  if (section.rows() < 3) {
    throw std::invalid_argument(name + ": has " + std::to_string(section.rows()) +
                                " points; give at least 3 from waterline to keel");
  }
  for (Eigen::Index i = 0; i < section.rows(); ++i) {
    if (!section.row(i).allFinite()) refuse(name, i, section.row(i), "is not finite; give metres");
  }
  const double tolerance = position_tolerance * section.cwiseAbs().maxCoeff();
  const Eigen::Index last = section.rows() - 1;
  if (std::abs(section(0, 1)) > tolerance) {
    refuse(name, 0, section.row(0), "is not on the waterline; start at z = 0 and cut the hull there");
  }
  if (std::abs(section(last, 0)) > tolerance) {
    refuse(name, last, section.row(last), "is not on the centre line; end at the keel, y = 0");
  }
  std::vector<Point> kept;
  for (Eigen::Index i = 0; i <= last; ++i) {
    Point p = section.row(i);
    if (p.x() < -tolerance) {
      refuse(name, i, p, "has crossed the centre line; give the port half, y >= 0");
    }
    if (p.y() > tolerance) refuse(name, i, p, "is above the water; cut the section at z = 0");
    p = Point(std::max(p.x(), 0.0), std::min(p.y(), 0.0));
    if (i == 0) p.y() = 0.0;
    if (i == last) p.x() = 0.0;
    if (!kept.empty() && (p - kept.back()).norm() <= tolerance) continue;
    if (!kept.empty() && p.y() >= -tolerance) {
      refuse(name, i, p, "is on the waterline again; only the first point may be there");
    }
    kept.push_back(p);
  }
  if (kept.size() == 1) return HalfSection(0, 2);
  kept.back().x() = 0.0;
  HalfSection out(static_cast<Eigen::Index>(kept.size()), 2);
  for (std::size_t i = 0; i < kept.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = kept[i];
  require_simple(out, name);
  return out;
}

HalfSection thickened(const HalfSection& section) {
  if (section.rows() == 0) return section;
  HalfSection out = section;
  const double draught = -section.col(1).minCoeff(), half_breadth = section.col(0).maxCoeff();
  const double thin = thinnest * draught, shallow = thinnest * half_breadth;
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const double y = section(i, 0), z = section(i, 1);
    const double down = z / draught, across = y / std::max(half_breadth, thin);
    out(i, 0) = std::max(y, thin * std::sqrt(std::max(0.0, 1.0 - down * down)));
    out(i, 1) = std::min(z, -shallow * std::sqrt(std::max(0.0, 1.0 - across * across)));
  }
  out(0, 1) = 0.0;
  out(out.rows() - 1, 0) = 0.0;
  return out;
}

}  // namespace seacrane::strip
