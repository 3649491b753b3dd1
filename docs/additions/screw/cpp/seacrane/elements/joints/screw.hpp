#pragma once

#include <cmath>
#include <numbers>

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"
#include "seacrane/math/rotation.hpp"

namespace seacrane {

/// Rotation about z_a that advances along it: d . x_a = d . y_a = 0, z_b . x_a
/// = z_b . y_a = 0, d . z_a = lead angle / 2 pi. Coordinates: angle about z_a
/// from x_a to x_b, the usual one, and displacement = d . z_a. The angle is
/// known to whole turns only: the turn nearest to the displacement counts.
struct Screw : JointDefaults {
  static constexpr const char* kind = "screw";
  static constexpr int rows = 5;
  static constexpr const char* coordinates = "angle displacement";
  static constexpr const char* usual = "angle";
  static constexpr bool slides = true;
  static constexpr bool parallel_axes = true;

  struct Parameters {
    double lead = 0.0;

    static constexpr auto fields() {
      return std::tuple(
          required("lead", &Parameters::lead, "m", "advance in one turn; negative: left-handed").not_zero());
    }
    double advance() const { return lead / (2.0 * std::numbers::pi); }  // m/rad
  };

  static JointDescription example(Random& random) {
    return example_joint<Screw>(random, {}, {{"lead", 3.0 * random.positive()}});
  }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& joint, RowBlock<T>& out) {
    using std::atan2;
    rows::along<T>(g, g.a.col(0), out, 0);
    rows::along<T>(g, g.a.col(1), out, 1);
    rows::parallel_z(g, out, 2);
    rows::along<T>(g, g.a.col(2), out, 4);
    // The angle is atan2(s, c), s = y_a . x_b, c = x_a . x_b. Its row is D = (c D_s - s D_c) / (s^2 + c^2).
    RowBlock<T> parts;
    rows::perpendicular<T>(g, g.a.col(1), g.b.col(0), parts, 0);
    rows::perpendicular<T>(g, g.a.col(0), g.b.col(0), parts, 1);
    const T s = parts.phi[0], c = parts.phi[1], square = s * s + c * c;
    const Vec3<T> relative = g.omega_a - g.omega_b;
    const T s_rate = cross<T>(g.a.col(1), g.b.col(0)).dot(relative);
    const T c_rate = cross<T>(g.a.col(0), g.b.col(0)).dot(relative);
    const T rate = (c * s_rate - s * c_rate) / square;
    const T advance(parameters_of<Parameters>(joint.parameters).advance());
    const T c_part = advance * c / square, s_part = advance * s / square;
    for (int side = 0; side < 2; ++side) {
      out.d[side].row(4) -= c_part * parts.d[side].row(0) - s_part * parts.d[side].row(1);
    }
    out.gamma[4] -= c_part * parts.gamma[0] - s_part * parts.gamma[1] +
                    T(2) * advance * rate * (c * c_rate + s * s_rate) / square;
    const T angle = atan2(s, c);
    out.phi[4] = advance * wrap_angle<T>(out.phi[4] / advance - angle);
  }

  struct Branch : branch::ScalarRates<1> {
    static constexpr int positions = 1, speeds = 1;
    static constexpr const char *position_kinds = "a",
                                *speed_kinds = "a";  // a: rad, l: m

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* /*u*/,
                     BranchMotionOf<T>& out) {
      const Mat3<T> a = branch::parent_axes(j, parent);
      const T advance(parameters_of<Parameters>(j.parameters).advance());
      out.rotation = branch::turn_about_z<T>(a, q[0]) * j.child_axes.transpose().cast<T>();
      out.reach = branch::parent_lever(j, parent) + advance * q[0] * a.col(2);
      out.slide[0] = advance * a.col(2);
      out.turn[0] = a.col(2);
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const Mat3d a = branch::parent_axes(j, parent);
      const branch::Gap gap(j, parent, child);
      const double whole = a.col(2).dot(gap.offset) / parameters_of<Parameters>(j.parameters).advance();
      q[0] = whole - wrap_angle<double>(whole - branch::turned(a, branch::child_axes(j, child)));
      u[0] = a.col(2).dot(gap.turning);
    }
  };
};

}  // namespace seacrane
