#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/line_path.hpp"
#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

/// The sheaves of a line, described point by point; an empty list is one of points without friction.
struct SheaveDescriptions {
  std::vector<double> radii;
  std::vector<Vec3d> axes;
  std::vector<double> turns, efficiencies, frictions;
  double slip_speed = 0.01;

  bool any() const {
    return std::any_of(radii.begin(), radii.end(), [](double r) { return r > 0.0; });
  }

  void check(std::size_t points, std::size_t most, const Check& c) const {
    check_count("radii", radii.size(), points, c);
    check_count("axes", axes.size(), points, c);
    check_count("turns", turns.size(), points, c);
    check_count("efficiencies", efficiencies.size(), points, c);
    check_count("frictions", frictions.size(), points, c);
    if (any() && axes.empty()) c.fail("has sheaves and no axes; give the axis of each, (0, 0, 0) at points");
    for (std::size_t i = 0; i < points; ++i) check_point(i, i == 0 || i + 1 == points, c);
    if (any() && points > most) {
      c.fail("has sheaves and " + std::to_string(points) + " points; give at most " + std::to_string(most));
    }
  }

  /// Neighbours on one body stay as they are: each must be outside the other's rim, or on it.
  void check_neighbours(const std::vector<std::string>& bodies, const std::vector<Vec3d>& points,
                        const Check& c) const {
    if (!any()) return;
    const auto end = [&](std::size_t i) {
      const Vec3d axis = radii[i] > 0.0 ? Vec3d(axes[i].normalized()) : Vec3d(Vec3d::Zero());
      return TangentEnd<double>{radii[i], points[i], axis};
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      if (bodies[i] != bodies[i + 1]) continue;
      if (line_tangent::clearance(end(i), end(i + 1)) >= -kOnRim * (radii[i] + radii[i + 1])) continue;
      c.fail("has points " + std::to_string(i) + " and " + std::to_string(i + 1) + " of body '" + bodies[i] +
             "' within a rim of the sheaves there; move them apart, a drum's end to its rim or beyond");
    }
  }

  PathPoint at(std::size_t i, const Attachment& on) const {
    PathPoint out;
    out.body = on.body;
    out.point = on.point;
    out.radius = value(radii, i, 0.0);
    if (out.radius > 0.0) out.axis = on.axes * axes[i].normalized();
    out.turned = kTurn * value(turns, i, 0.0);
    out.grip = value(frictions, i, 0.0);
    out.drag = -std::log(value(efficiencies, i, 1.0));
    return out;
  }

  /// Why a run ends where a line is lost by the sheave at a point.
  static std::string lost(std::size_t point) {
    return "leaves the sheave at its point " + std::to_string(point) +
           ": its wrap there is below 0 or above 264 degrees beside whole turns, or the next point is within "
           "the rim; turn the axis if it runs on the wrong side, give it turns, or move the points";
  }

 private:
  static constexpr double kOnRim = 1e-6;
  static constexpr double kTurn = 6.283185307179586476925;

  static double value(const std::vector<double>& values, std::size_t i, double usual) {
    return values.empty() ? usual : values[i];
  }
  static void check_count(const char* what, std::size_t count, std::size_t points, const Check& c) {
    if (count == 0 || count == points) return;
    c.fail("has " + std::to_string(points) + " points and " + std::to_string(count) + " " + what +
           "; give one for each point, or none");
  }

  void check_point(std::size_t i, bool is_end, const Check& c) const {
    const std::string at = " at point " + std::to_string(i);
    const double radius = value(radii, i, 0.0), whole = value(turns, i, 0.0),
                 efficiency = value(efficiencies, i, 1.0), friction = value(frictions, i, 0.0);
    if (radius > 0.0 && !axes.empty() && !(axes[i].norm() > 0.0)) {
      c.fail("axes are zero" + at + ", which is a sheave; give the axis about which the line runs");
    }
    if (whole != std::floor(whole)) c.fail("turns are " + to_text(whole) + at + "; give a whole number");
    if (radius == 0.0 && (friction > 0.0 || whole > 0.0)) {
      c.fail("has friction or turns" + at + ", which has no radius; give it one, or an efficiency");
    }
    if (is_end && (radius > 0.0 || efficiency < 1.0)) {
      c.fail("has a sheave" + at +
             ", where it ends; end it at a point, for a drum behind a sheave on its body");
    }
  }
};

/// The entries of a description with a member `sheaves`.
template <class Description>
constexpr auto sheave_fields() {
  constexpr auto radii = [](auto& d) -> auto& { return d.sheaves.radii; };
  constexpr auto axes = [](auto& d) -> auto& { return d.sheaves.axes; };
  constexpr auto turns = [](auto& d) -> auto& { return d.sheaves.turns; };
  constexpr auto efficiencies = [](auto& d) -> auto& { return d.sheaves.efficiencies; };
  constexpr auto frictions = [](auto& d) -> auto& { return d.sheaves.frictions; };
  constexpr auto slip_speed = [](auto& d) -> auto& { return d.sheaves.slip_speed; };
  return std::tuple(
      optional("radii", radii, "m", "of sheaves at the points; 0: a point")
          .not_negative()
          .usually(5e-3, 10.0),
      optional("axes", axes, "",
               "of the sheaves, body coordinates; the line runs about them by the right hand"),
      optional("turns", turns, "", "whole turns on each besides").within(0.0, 1e3).usually(0.0, 20.0),
      optional("efficiencies", efficiencies, "", "of each: the smaller tension over the larger")
          .must_be({.minimum = 0.0, .maximum = 1.0, .above = true})
          .usually(0.3, 1.0),
      optional("frictions", frictions, "", "coefficients of friction on each")
          .not_negative()
          .usually(1e-3, 3.0),
      optional("slip_speed", slip_speed, "m/s", "at which sheaves have 76 % of their friction")
          .positive()
          .usually(5e-5, 2.0));
}

}  // namespace seacrane
