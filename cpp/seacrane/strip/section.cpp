#include "seacrane/strip/section.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace seacrane::strip {
namespace {

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
