#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

/// How far a point is outside a surface, negative inside it, and the way out there.
template <class T>
struct SurfaceDistance {
  T distance;
  Vec3<T> normal;
};

/// The surface of a body in axes of its own: a plane z = 0 with all below it inside, a box, a round post
/// along z, or the wall of a pipe along z. Edges are round, so that a point does not fall off with a jump.
struct ContactSurface {
  enum class Shape { plane, box, post, pipe };

  Shape shape = Shape::plane;
  Vec3d half = Vec3d::Zero();  // of a box; of a post or wall: half its thickness, unused, half its length
  double middle = 0.0;         // radius of the middle of a wall
  double edge = 0.0;           // radius of its edges

  /// m: no shorter way leads through it but past its edges.
  double thin() const {
    if (shape == Shape::plane) return std::numeric_limits<double>::infinity();
    return shape == Shape::box ? half.minCoeff() : std::min(half.x(), half.z());
  }

  template <class T>
  SurfaceDistance<T> at(const Vec3<T>& x) const {
    if (shape == Shape::plane) return {x.z(), Vec3<T>(T(0), T(0), T(1))};
    if (shape == Shape::box) {
      const auto out = round_box<3, T>({x.x(), x.y(), x.z()}, {half.x(), half.y(), half.z()});
      return {out.distance, Vec3<T>(out.way[0], out.way[1], out.way[2])};
    }
    using std::sqrt;
    const T radius = sqrt(x.x() * x.x() + x.y() * x.y() + T(kOnAxis * kOnAxis));
    const auto out = round_box<2, T>({radius - T(middle), x.z()}, {half.x(), half.z()});
    const T across = out.way[0] / radius;
    return {out.distance, Vec3<T>(across * x.x(), across * x.y(), out.way[1])};
  }

 private:
  static constexpr double kOnAxis = 1e-9;  // m: the distance to an axis has a slope there too

  template <int N, class T>
  struct Way {
    T distance;
    std::array<T, N> way;
  };

  /// A box of N dimensions about the origin.
  template <int N, class T>
  Way<N, T> round_box(const std::array<T, N>& x, const std::array<double, N>& halves) const {
    using std::sqrt;
    std::array<T, N> beyond, sign;
    T square(0);
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < N; ++i) {
      sign[i] = x[i] < T(0) ? T(-1) : T(1);
      beyond[i] = sign[i] * x[i] - T(halves[i] - edge);
      if (beyond[i] > T(0)) square += beyond[i] * beyond[i];
      if (beyond[i] > beyond[nearest]) nearest = i;
    }
    Way<N, T> out;
    out.way.fill(T(0));
    if (!(square > T(0))) {
      out.way[nearest] = sign[nearest];
      out.distance = beyond[nearest] - T(edge);
      return out;
    }
    const T root = sqrt(square);
    for (std::size_t i = 0; i < N; ++i) {
      if (beyond[i] > T(0)) out.way[i] = sign[i] * beyond[i] / root;
    }
    out.distance = root - T(edge);
    return out;
  }
};

struct ContactDescription {
  std::string name, body, on;
  std::vector<Vec3d> points;  // body coordinates
  std::string surface = "plane";
  Vec3d place = Vec3d::Zero();     // of the surface on `on`, in its body coordinates
  Mat3d axes = Mat3d::Identity();  // columns: its axes in those of `on`
  Vec3d size = Vec3d::Zero();
  double edge = 0.05;
  double stiffness = 0.0, damping = 0.0;
  std::vector<double> compressions, forces;
  double friction = 0.0, shear_stiffness = 0.0, shear_damping = 0.0, hold = 1e-3;

  static constexpr std::size_t kMostPoints = 64;
  static constexpr const char* type = "Contact";
  static constexpr const char* text =
      "Points of a body against the surface of another, which presses and rubs; see Scene.add_contact.";
  static constexpr auto fields() {
    using D = ContactDescription;
    return std::tuple(
        on_body("body", &D::body, "whose points they are"), on_body("on", &D::on, "whose surface it is"),
        required("points", &D::points, "m", "body coordinates"),
        optional("surface", &D::surface, "", "'plane', 'box', 'post' or 'pipe'"),
        optional("place", &D::place, "m", "of a plane one of its points, else its centre; coordinates of on"),
        optional("axes", &D::axes, "", "columns: its axes in those of on; z away from a plane, along a post"),
        optional("size", &D::size, "m",
                 "of a box along its axes; of a post or pipe its inner and outer diameter, and its length")
            .not_negative()
            .usually(0.01, 1000.0),
        optional("edge", &D::edge, "m", "radius of its edges").positive().usually(1e-3, 1.0),
        required("stiffness", &D::stiffness, "N/m", "of each point; not used beside a table").positive(),
        optional("damping", &D::damping, "s/m", "force = elastic force (1 + damping rate)")
            .not_negative()
            .usually(1e-3, 100.0),
        optional("compressions", &D::compressions, "m", "of a table, from 0, in place of stiffness")
            .not_negative(),
        optional("forces", &D::forces, "N", "elastic force at the compressions").not_negative(),
        optional("friction", &D::friction, "", "coefficient, of sticking and of sliding")
            .not_negative()
            .usually(0.01, 2.0),
        optional("shear_stiffness", &D::shear_stiffness, "N/m", "of each point, while it sticks")
            .not_negative(),
        optional("shear_damping", &D::shear_damping, "N s/m", "likewise").not_negative(),
        optional("hold", &D::hold, "m",
                 "that a point gives before it slides: errors of anchors count over it")
            .positive()
            .usually(1e-5, 0.1));
  }

  bool is(const char* name) const { return surface == name; }

  void check(const Check& c, SceneNames& names) const {
    names.body(c, body, true);
    names.body(c, on, true);
    if (body == on) c.fail("has body and on '" + on + "'; give two bodies, or one and 'ground'");
    if (points.empty() || points.size() > kMostPoints) {
      c.fail("has " + std::to_string(points.size()) + " points; give 1 to " + std::to_string(kMostPoints) +
             ", and more in another contact");
    }
    if (!(axes.transpose() * axes).isIdentity(1e-9) || axes.determinant() < 0.0) {
      c.fail("axes are not those of a right-handed frame; give unit columns at right angles");
    }
    check_surface(c);
    check_table(c);
    if (friction > 0.0 && !(shear_stiffness > 0.0 && shear_damping > 0.0)) {
      c.fail("has friction " + to_text(friction) + " with a shear_stiffness of " + to_text(shear_stiffness) +
             " N/m and a shear_damping of " + to_text(shear_damping) + " N s/m; give both above 0");
    }
  }

  ContactSurface shape() const {
    using Shape = ContactSurface::Shape;
    if (is("box")) return {Shape::box, 0.5 * size, 0.0, edge};
    if (is("post")) return {Shape::post, {0.5 * size[1], 0.0, 0.5 * size[2]}, 0.0, edge};
    if (!is("pipe")) return {};
    return {Shape::pipe, {wall(), 0.0, 0.5 * size[2]}, 0.25 * (size[0] + size[1]), edge};
  }

 private:
  double wall() const { return 0.25 * (size[1] - size[0]); }  // half of its thickness

  void check_surface(const Check& c) const {
    if (is("plane")) return;
    if (!is("box") && !is("post") && !is("pipe")) {
      c.fail("surface '" + surface + "' is unknown; choose 'plane', 'box', 'post' or 'pipe'");
    }
    if (is("post") && size[0] != 0.0) {
      c.fail("a post has an inner diameter of " + to_text(size[0]) + " m; give 0, or surface 'pipe'");
    }
    if (is("pipe") && !(size[0] > 0.0 && size[1] > size[0])) {
      c.fail("a pipe has inner and outer diameters of " + to_text(size[0]) + " and " + to_text(size[1]) +
             " m; give both, the outer one larger");
    }
    const double least =
        is("box") ? 0.5 * size.minCoeff() : std::min(is("pipe") ? wall() : 0.5 * size[1], 0.5 * size[2]);
    if (least >= edge) return;
    c.fail("size is " + to_text(2.0 * least) + " m where it is thinnest, and edges have a radius of " +
           to_text(edge) + " m; give a thicker " + surface + ", or an edge of at most half of that");
  }

  void check_table(const Check& c) const {
    if (compressions.empty() && forces.empty()) return;
    if (compressions.size() != forces.size() || forces.size() < 2 || compressions.front() != 0.0 ||
        forces.front() != 0.0) {
      c.fail("the table has " + std::to_string(compressions.size()) + " compressions and " +
             std::to_string(forces.size()) + " forces; give as many of both, two at least, both from 0");
    }
    c.increases("compressions", compressions);
    c.increases("forces", forces);
  }
};

}  // namespace seacrane
