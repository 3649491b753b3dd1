#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/periodic_spline.hpp"

namespace seacrane {

struct FlowForceDescription {
  std::string name, body;
  Vec3d point = Vec3d::Zero();  // body coordinates, m: where the load acts and the body's velocity is taken
  double density = 0.0;         // kg/m3
  Curve speed;                  // m/s
  double direction = 0.0;       // rad, where the flow goes, from +x towards +y, inertial frame
  double frontal_area = 0.0, lateral_area = 0.0, length = 0.0;  // m2, m2, m
  std::vector<double> angles;       // rad, where the relative flow goes, from the bow towards port
  std::vector<Vec3d> coefficients;  // C_x, C_y, C_n at the angles

  static constexpr const char* type = "FlowForce";
  static constexpr const char* text =
      "Wind or current on a body by coefficients; see Scene.add_wind and Scene.add_current.\n\n"
      "F_x, F_y = density / 2 V^2 (C_x frontal_area, C_y lateral_area), N = density / 2 V^2 C_n "
      "lateral_area\n"
      "length, V the horizontal flow relative to `point`, in axes that follow the body's yaw; C over "
      "`angles`,\n"
      "where the relative flow goes, from the bow towards port, by periodic cubic splines.";
  static constexpr auto fields() {
    using D = FlowForceDescription;
    return std::tuple(
        on_body("body", &D::body), optional("point", &D::point, "m", "where the load acts, body coordinates"),
        required("density", &D::density, "kg/m3", "").not_negative().usually(0.5, 1500.0),
        required("speed", &D::speed, "m/s", "").usually(0.0, 100.0),
        required("direction", &D::direction, "rad", "where the flow goes, from +x towards +y"),
        required("frontal_area", &D::frontal_area, "m2", "").not_negative().usually(0.0, 1e5),
        required("lateral_area", &D::lateral_area, "m2", "").not_negative().usually(0.0, 1e5),
        required("length", &D::length, "m", "").not_negative().usually(0.2, 600.0),
        required("angles", &D::angles, "rad", ""),
        required("coefficients", &D::coefficients, "", "C_x, C_y, C_n at the angles").usually(0.0, 20.0));
  }
};

/// Wind or current on a body by coefficients (DNV-RP-C205; OCIMF, Mooring Equipment Guidelines): with the
/// flow V relative to the point, horizontal, in axes that follow the body's yaw, going to the angle a, F_x =
/// rho/2 C_x(a) A_frontal V^2, F_y = rho/2 C_y(a) A_lateral V^2, N = rho/2 C_n(a) A_lateral length V^2.
/// Coefficients are periodic cubic splines of the angle.
struct FlowForce {
  static constexpr const char* kind = "flow force";
  static constexpr bool packs = true;
  using Description = FlowForceDescription;

  Description d;
  int body = 0;
  Vec3d point;                      // from the state point, body axes
  Vec3d bow;                        // x axis of the described body
  double cosine = 1.0, sine = 0.0;  // of the flow's direction
  PeriodicKnots knots;
  std::vector<Vec3d> load, curvature;  // over V^2, at the knots: N s2/m2, N s2/m2, N m s2/m2

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body);
    if (d.angles.size() < 4 || d.angles.size() != d.coefficients.size()) {
      c.fail("has " + std::to_string(d.angles.size()) + " angles and " +
             std::to_string(d.coefficients.size()) + " coefficients; give as many of both, at least four");
    }
    for (std::size_t i = 0; i < d.angles.size(); ++i) {
      const double next = i + 1 < d.angles.size() ? d.angles[i + 1] : d.angles.front() + PeriodicKnots::turn;
      if (!(next > d.angles[i] && next - d.angles[i] <= largest_gap)) {
        c.fail("angle " + to_text(d.angles[i]) + " rad is followed by " + to_text(next) +
               " rad; angles must increase within one turn, at most 90 deg apart");
      }
    }
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.body = "first";
    d.point = {0.0, 0.1, 0.4};
    d.density = 1.2;
    d.speed = Curve::constant(5.0);
    d.frontal_area = d.lateral_area = d.length = 1.3;
    d.angles = {0.0, 1.5, 3.0, 4.5, 5.5};
    d.coefficients = {
        {0.9, 0.0, 0.1}, {0.1, 0.8, 0.2}, {-0.8, 0.1, 0.0}, {0.0, -0.9, -0.2}, {0.6, -0.5, 0.1}};
    return d;
  }

  template <class Context>
  static FlowForce compile(const Description& d, Context& context) {
    FlowForce f;
    f.d = d;
    const Attachment on = context.attach(d.body, d.point);
    f.body = on.body;
    f.point = on.point;
    f.bow = on.axes.col(0);
    f.cosine = std::cos(d.direction);
    f.sine = std::sin(d.direction);
    f.knots = PeriodicKnots(d.angles);
    const Vec3d size(d.frontal_area, d.lateral_area, d.lateral_area * d.length);
    for (const Vec3d& coefficient : d.coefficients)
      f.load.emplace_back(0.5 * d.density * size.cwiseProduct(coefficient));
    const MatXd bend = f.knots.curvature();
    for (Eigen::Index i = 0; i < bend.rows(); ++i) {
      Vec3d sum = Vec3d::Zero();
      for (Eigen::Index k = 0; k < bend.cols(); ++k) sum += bend(i, k) * f.load[static_cast<std::size_t>(k)];
      f.curvature.push_back(sum);
    }
    return f;
  }

  /// Where a speed u jumps, (u - v)^2 does, with a velocity v of the body that is taken as up to 0.5 m/s.
  std::vector<LoadKinks> kinks() const {
    Vec3d largest = Vec3d::Zero();
    for (const Vec3d& at : load) largest = largest.cwiseMax(at.cwiseAbs());
    LoadKinks out;
    for (const CurveKink& kink : d.speed.kinks()) {
      const std::array<double, 3> jump = {square(kink.after, 0) - square(kink.before, 0),
                                          square(kink.after, 1) - square(kink.before, 1),
                                          square(kink.after, 2) - square(kink.before, 2)};
      LoadKink& of = out.emplace_back();
      of.time = kink.time;
      of.jump.setZero(3, 4);
      for (const int p : {1, 2, 3}) of.jump.col(p) = jump[idx(p - 1)] * largest;
    }
    return {out};
  }

  /// Components: along the bow and across it, N, and the moment about z, N m.
  void add_unit(int component, const LoadInput<double>& in, Vec6d* wrenches) const {
    const auto& k = in.bodies[body];
    const Vec3d lever = k.rotation * point, ahead = k.rotation * bow;
    Vec3d force = Vec3d::Zero();
    if (component == 0) force = Vec3d(ahead.x(), ahead.y(), 0.0).stableNormalized();
    if (component == 1) force = Vec3d(-ahead.y(), ahead.x(), 0.0).stableNormalized();
    wrenches[body].head<3>() += force;
    wrenches[body].tail<3>() += lever.cross(force) + (component == 2 ? 1.0 : 0.0) * Vec3d::UnitZ();
  }

  std::array<int, 1> bodies() const { return {body}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    using std::atan2, std::sqrt;
    const auto& k = in.bodies[body];
    const Vec3<T> lever = k.rotation * point.cast<T>();
    const Vec3<T> velocity = k.velocity + cross<T>(k.angular_velocity, lever);
    const T u = T(d.speed.at(in.time, in.curve_limit).value);
    const T along = T(cosine) * u - velocity.x(), across = T(sine) * u - velocity.y();
    const T square = along * along + across * across;
    const Vec3<T> ahead = k.rotation * bow.cast<T>();
    const T flat = ahead.x() * ahead.x() + ahead.y() * ahead.y();
    // No direction, or the bow points straight up or down and the axes are not defined: no load.
    const auto blows = [&](const T& yes, const T& no) {
      return select(square > T(0), select(flat > T(0), yes, no), no);
    };
    const T length = sqrt(blows(flat, T(1))), c = ahead.x() / length, s = ahead.y() / length;
    const T angle = atan2(blows(c * across - s * along, T(0)), blows(c * along + s * across, T(1)));
    Vec3<T> f = lane_by_lane(angle, [this](const auto& one) { return over_square(one); });
    for (int n = 0; n < 3; ++n) f[n] = blows(square * f[n], T(0));
    const Vec3<T> force(c * f.x() - s * f.y(), s * f.x() + c * f.y(), T(0));
    out.wrench[body].add(force, lever);
    out.wrench[body].moment += Vec3<T>(T(0), T(0), f.z());
    out.add_power(force.dot(velocity) + f.z() * k.angular_velocity.z());
  }

 private:
  /// The load over V^2 for an angle of the flow, in axes that follow yaw; z holds the moment.
  template <class T>
  Vec3<T> over_square(const T& angle) const {
    const SplinePlace<T> p = knots.place<T>(angle);
    Vec3<T> out;
    for (int n = 0; n < 3; ++n) {
      out[n] = p.left * T(load[p.i][n]) + p.right * T(load[p.j][n]) + p.bend_left * T(curvature[p.i][n]) +
               p.bend_right * T(curvature[p.j][n]);
    }
    return out;
  }
  /// Derivatives of u^2 + u (1 m/s).
  static double square(const std::array<double, 4>& u, int order) {
    if (order == 0) return u[0] * u[0] + u[0];
    if (order == 1) return 2.0 * u[0] * u[1] + u[1];
    return 2.0 * (u[1] * u[1] + u[0] * u[2]) + u[2];
  }

  static constexpr double largest_gap = 0.25 * PeriodicKnots::turn * (1.0 + 1e-9);
};

}  // namespace seacrane
