#pragma once

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/check.hpp"
#include "seacrane/elements/field.hpp"

namespace seacrane {

struct EntrappedWaterDescription {
  static constexpr std::size_t kMostOpenings = 12;

  std::string name, body;
  Vec3d point = Vec3d::Zero();  // centre of its bottom, body coordinates
  double area = 0.0, height = 0.0;
  std::vector<Vec3d> opening_points;  // likewise
  std::vector<double> opening_areas;
  std::string air;
  double exponent = 0.0, air_pressure = 101325.0;
  double discharge_coefficient = 0.6;
  double initial = 0.0;
  double density = 0.0;
  double wave_factor = 1.0;

  static constexpr const char* type = "EntrappedWater";
  static constexpr const char* text =
      "Water in a compartment of a body, which comes and goes through openings; see "
      "Scene.add_immersed.";
  static constexpr auto fields() {
    using D = EntrappedWaterDescription;
    return std::tuple(
        on_body("body", &D::body),
        optional("point", &D::point, "m", "centre of its bottom, body coordinates"),
        required("area", &D::area, "m2", "of its section, the same at every height").positive(),
        required("height", &D::height, "m", "along the body's z").positive(),
        required("opening_points", &D::opening_points, "m", "centres of its openings, body coordinates"),
        required("opening_areas", &D::opening_areas, "m2", "of the openings").positive(),
        required("air", &D::air, "", "above the water: free, vented, or shut in"),
        optional("exponent", &D::exponent, "", "of air that is shut in: p V^exponent stays").not_negative(),
        optional("air_pressure", &D::air_pressure, "Pa", "absolute, of air that is shut in, at the start")
            .not_negative()
            .usually(1e3, 1e7),
        optional("discharge_coefficient", &D::discharge_coefficient, "",
                 "C_d: share of an opening's area that the jet fills")
            .must_be({.minimum = 0.0, .maximum = 1.0, .above = true})
            .usually(0.02, 1.0),
        optional("initial", &D::initial, "m3", "of water in it at the start").not_negative(),
        required("density", &D::density, "kg/m3", "of the water").positive().usually(900.0, 1100.0),
        optional("wave_factor", &D::wave_factor, "",
                 "times the waves of the sea: what a hull beside makes of them")
            .not_negative()
            .usually(0.1, 3.0));
  }

  double whole() const { return area * height; }  // m3
  /// -1 of an opening in the bottom, 1 in the lid.
  int end_of(std::size_t i) const {
    const double over = opening_points[i].z() - point.z(), rounding = kRounding * height;
    return over < rounding ? -1 : over > height - rounding ? 1 : 0;
  }
  /// Of the section, at an end.
  double open_share(int end) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < opening_areas.size(); ++i) {
      if (end_of(i) == end) sum += opening_areas[i];
    }
    return sum / area;
  }

  void check(const Check& c, SceneNames& names) const {
    names.body(c, body);
    const std::size_t n = opening_points.size();
    if (n == 0 || n > kMostOpenings || opening_areas.size() != n) {
      c.fail("has " + std::to_string(n) + " opening_points and " + std::to_string(opening_areas.size()) +
             " opening_areas; give as many of both, 1 to " + std::to_string(kMostOpenings));
    }
    for (std::size_t i = 0; i < n; ++i) check_opening(i, c);
    check_air(c);
    if (initial > whole()) {
      c.fail("initial is " + to_text(initial) + " m3, and it holds " + to_text(whole()) +
             " m3; give at most that");
    }
  }

  static EntrappedWaterDescription example() {
    EntrappedWaterDescription d;
    d.name = "load";
    d.body = "second";
    d.point = {0.2, -0.1, -3.0};
    d.area = 2.0;
    d.height = 5.0;
    d.opening_points = {{0.3, 0.2, -2.8}, {-0.4, 0.1, -2.5}};
    d.opening_areas = {0.05, 0.1};
    d.air = "vented";
    d.initial = 4.0;
    d.density = 0.1;
    return d;
  }

 private:
  static constexpr double kWidest = 10.0;  // roots of the area, beside the axis
  static constexpr double kRounding = 1e-9;

  void check_air(const Check& c) const {
    if (air != "free" && air != "vented" && air != "shut") {
      c.fail("air is '" + air + "'; give free, vented or shut");
    }
    const bool shut = air == "shut";
    if (shut ? exponent < 1.0 || exponent > 1.4 : exponent != 0.0) {
      c.fail("exponent is " + to_text(exponent) + ", and air is " + air +
             "; give 1 (slow) to 1.4 (quick) for air that is shut in, and none for other air");
    }
    for (const int end : {-1, 1}) {
      if (const double open = open_share(end); open > 1.0 + kRounding) {
        c.fail(std::string("openings in its ") + (end < 0 ? "bottom" : "lid") + " take " + to_text(open) +
               " of its section; give areas that find place there");
      }
    }
  }

  void check_opening(std::size_t i, const Check& c) const {
    const Vec3d place = opening_points[i] - point;
    const std::string which = "opening " + std::to_string(i + 1);
    const double rounding = kRounding * height;
    if (place.z() < -rounding || place.z() > height + rounding) {
      c.fail(which + " is at " + to_text(place.z()) + " m over the bottom, and the height is " +
             to_text(height) + " m; give a point between bottom and top, in body coordinates");
    }
    if (place.head<2>().norm() > kWidest * std::sqrt(area)) {
      c.fail(which + " is " + to_text(place.head<2>().norm()) + " m beside the middle of a section of " +
             to_text(area) + " m2; give a point on its wall, in body coordinates");
    }
    if (opening_areas[i] > area) {
      c.fail(which + " has " + to_text(opening_areas[i]) + " m2, more than the section of " + to_text(area) +
             " m2; give the area of the opening");
    }
  }
};

}  // namespace seacrane
