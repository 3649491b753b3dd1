#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

struct ImmersedPartDescription {
  enum class Shape { box, cylinder, disc, sphere, table };

  std::string name, body;
  std::string shape = "box";
  Vec3d point = Vec3d::Zero();     // its centre, body coordinates
  Mat3d axes = Mat3d::Identity();  // columns: its axes in those of the body
  Vec3d size = Vec3d::Zero();
  double fill = 1.0;  // share of its volume that keeps water out
  double density = 0.0;
  double wave_factor = 1.0;
  std::vector<double> depths;       // of its lowest point below the surface
  std::vector<Vec3d> added_masses;  // along its axes, at these depths
  std::vector<double> volumes;      // likewise, of a table
  Vec3d drag = Vec3d::Zero();       // rho/2 C_D S along its axes
  std::string row;                  // strips like it at equal steps have one name
  double place = 0.0, count = 1.0;  // its own among them; whole numbers
  Vec3d step = Vec3d::Zero();       // body coordinates
  std::string source;
  std::vector<Vec3d> slow_added_masses;

  static constexpr const char* type = "ImmersedPart";
  static constexpr const char* text =
      "Water on a part of a body: buoyancy, added mass over depth, slam, drag; see Scene.add_immersed.";
  static constexpr auto fields() {
    using D = ImmersedPartDescription;
    return std::tuple(
        on_body("body", &D::body),
        optional("shape", &D::shape, "", "'box', 'cylinder', 'disc', 'sphere' or 'table'"),
        optional("point", &D::point, "m", "its centre, body coordinates"),
        optional("axes", &D::axes, "", "columns: its axes in those of the body"),
        required(
            "size", &D::size, "m",
            "along its axes; of a cylinder, its length and twice its diameter; of a disc, an end of one that "
            "looks along x, first the depth over which it gains its water facing up"),
        optional("fill", &D::fill, "", "share of its volume that keeps water out")
            .within(0.0, 1.0)
            .usually(2e-3, 1.0),
        required("density", &D::density, "kg/m3", "of the water").positive().usually(900.0, 1100.0),
        required("depths", &D::depths, "m", "of its lowest point below the surface, from 0").not_negative(),
        required("added_masses", &D::added_masses, "kg", "along its axes, at the depths").not_negative(),
        optional("volumes", &D::volumes, "m3", "of a table: what is wet, at the depths").not_negative(),
        optional("drag", &D::drag, "N s2/m2", "density / 2 times C_D times area, along its axes")
            .not_negative(),
        optional("row", &D::row, "",
                 "name of a row of strips at equal steps, for which the sea is summed at once"),
        optional("place", &D::place, "", "in its row, from 0"),
        optional("count", &D::count, "", "strips of its row"),
        optional("step", &D::step, "m", "from strip to strip of its row, body coordinates"),
        optional("wave_factor", &D::wave_factor, "",
                 "times the waves of the sea: what a hull beside makes of them")
            .not_negative()
            .usually(0.1, 3.0),
        optional("source", &D::source, "", "where its coefficients are from"),
        optional("slow_added_masses", &D::slow_added_masses, "kg",
                 "at zero frequency, at the depths: what slow waves feel, for answers.scattered")
            .not_negative());
  }

  bool is(const char* name) const { return shape == name; }

  Shape form() const {
    if (is("cylinder")) return Shape::cylinder;
    if (is("disc")) return Shape::disc;
    if (is("sphere")) return Shape::sphere;
    return is("table") ? Shape::table : Shape::box;
  }
  /// Widths of a box with the second moments of the shape: a mean over it errs from the fourth order on.
  Vec3d widths() const {
    const double disc = std::sqrt(0.75), ball = std::sqrt(0.6);
    if (is("disc")) return {0.0, disc * size[1], disc * size[2]};
    if (is("cylinder")) return size.cwiseProduct(Vec3d(1.0, disc, disc));
    return is("sphere") ? Vec3d(ball * size) : size;
  }
  /// Of all that it encloses, m3.
  double volume() const {
    using std::numbers::pi;
    if (is("cylinder")) return pi / 4.0 * size[0] * size[1] * size[1];
    if (is("disc")) return 0.0;
    if (is("sphere")) return pi / 6.0 * std::pow(size[0], 3);
    return is("table") ? volumes.back() : size.prod();
  }
  std::vector<Eigen::Matrix<double, 1, 1>> volume_rows() const {
    std::vector<Eigen::Matrix<double, 1, 1>> out;
    for (const double v : volumes) out.emplace_back(v);
    return out;
  }

  void check(const Check& c, SceneNames& names) const {
    names.body(c, body);
    if (!is("box") && !is("cylinder") && !is("disc") && !is("sphere") && !is("table")) {
      c.fail("shape '" + shape + "' is unknown; choose 'box', 'cylinder', 'disc', 'sphere' or 'table'");
    }
    check_size(c);
    const bool whole = place == std::floor(place) && count == std::floor(count);
    if (!whole || place < 0.0 || place >= count || count > kMostStrips) {
      c.fail("place is " + to_text(place) + " in a row of " + to_text(count) +
             "; give whole numbers, 0 up to " + "one less than count, which is " + to_text(kMostStrips) +
             " at most");
    }
    if (!(axes.transpose() * axes).isIdentity(1e-9) || axes.determinant() < 0.0) {
      c.fail("axes are not those of a right-handed frame; give unit columns at right angles");
    }
    const std::size_t n = depths.size();
    if (n < 2 || added_masses.size() != n || depths.front() != 0.0) {
      c.fail("has " + std::to_string(n) + " depths and " + std::to_string(added_masses.size()) +
             " added masses; give as many of both, at least two, from depth 0 m on");
    }
    if (!slow_added_masses.empty() && slow_added_masses.size() != n) {
      c.fail("has " + std::to_string(slow_added_masses.size()) + " slow_added_masses at " +
             std::to_string(n) + " depths; give as many of both");
    }
    c.increases("depths", depths);
    check_growth("added_masses", added_masses, c);
    if (is("table") != !volumes.empty()) c.fail("volumes belong to shape 'table', which needs them");
    if (!is("table")) return;
    if (volumes.size() != n) {
      c.fail("has " + std::to_string(volumes.size()) + " volumes at " + std::to_string(n) +
             " depths; give as many of both");
    }
    check_growth("volumes", volume_rows(), c);
  }

  static ImmersedPartDescription example() {
    ImmersedPartDescription d;
    d.name = "load";
    d.body = "second";
    d.point = {0.3, -0.2, 0.4};
    d.axes = Eigen::AngleAxisd(0.4, Vec3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
    d.size = {7.0, 9.0, 8.0};
    d.density = 0.1;
    d.depths = {0.0, 2.0, 5.0, 9.0, 14.0, 20.0};
    d.added_masses = {{0.0, 0.0, 0.0}, {0.3, 0.4, 0.9}, {0.8, 1.2, 1.6},
                      {1.5, 2.0, 2.2}, {2.0, 2.6, 2.7}, {2.2, 2.9, 3.0}};
    d.drag = {0.3, 0.4, 0.5};
    return d;
  }

 private:
  static constexpr double kMostStrips = 1000.0;

  void check_size(const Check& c) const {
    if (size.minCoeff() < 0.0 || size.maxCoeff() <= 0.0) {
      c.fail("size holds " + to_text(size.minCoeff()) + " m; give lengths of which one is above 0 m");
    }
    if ((is("cylinder") || is("disc")) && size[1] != size[2]) {
      c.fail("the size of a " + shape + " is a length and twice its diameter; y and z differ");
    }
    if (is("disc") && size.minCoeff() == 0.0) c.fail("a disc of no size; give lengths above 0 m");
    if (is("sphere") && (size[0] != size[1] || size[0] != size[2])) {
      c.fail("a sphere's size is its diameter three times; its numbers differ");
    }
  }

  /// A table that falls would give slam a wrong sign.
  template <class Row>
  void check_growth(const char* what, const std::vector<Row>& values, const Check& c) const {
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
      if ((values[i + 1] - values[i]).minCoeff() >= 0.0) continue;
      c.fail(std::string(what) + " fall between " + to_text(depths[i]) + " and " + to_text(depths[i + 1]) +
             " m of depth; give values that grow");
    }
  }
};

}  // namespace seacrane
