#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "seacrane/elements/check.hpp"
#include "seacrane/elements/loads/line_sheaves.hpp"
#include "seacrane/elements/loads/winch.hpp"
#include "seacrane/math/dual.hpp"

namespace seacrane {

/// Tension of a line by its strain: EA e, or a table through whose rows runs a monotone cubic spline
/// (Fritsch, Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300), beyond its end on along its tangent.
class LineElasticity {
 public:
  LineElasticity() = default;
  LineElasticity(double stiffness, std::vector<double> strains, std::vector<double> tensions)
      : stiffness_(stiffness), strains_(std::move(strains)), tensions_(std::move(tensions)) {
    if (strains_.empty()) return;
    find_slopes();
    energies_.push_back(0.0);
    for (std::size_t i = 0; i + 1 < strains_.size(); ++i) {
      const double h = strains_[i + 1] - strains_[i];
      energies_.push_back(energies_[i] + 0.5 * h * (tensions_[i] + tensions_[i + 1]) +
                          h * h / 12.0 * (slopes_[i] - slopes_[i + 1]));
    }
  }

  /// Tension of a strain of zero or more. Below zero the secant to the first row goes on, which tells how far
  /// the line is from being taut.
  template <class T>
  T tension(const T& strain) const {
    if (strains_.empty()) return T(stiffness_) * strain;
    const Piece p = piece(strain);
    const T x = strain - T(p.start);
    return T(p.a[0]) + x * (T(p.a[1]) + x * (T(p.a[2]) + x * T(p.a[3])));
  }
  /// Integral of the tension over the strain, J for each metre.
  template <class T>
  T energy(const T& strain) const {
    if (strains_.empty()) return T(0.5 * stiffness_) * strain * strain;
    const Piece p = piece(strain);
    const T x = strain - T(p.start);
    return T(p.energy) +
           x * (T(p.a[0]) + x * (T(p.a[1] / 2.0) + x * (T(p.a[2] / 3.0) + x * T(p.a[3] / 4.0))));
  }

  static void check(const std::vector<double>& strains, const std::vector<double>& tensions, const Check& c) {
    if (strains.size() != tensions.size() || strains.size() == 1) {
      c.fail("has " + std::to_string(strains.size()) + " strains and " + std::to_string(tensions.size()) +
             " tensions; give as many of both, at least two");
    }
    for (std::size_t i = 0; i < strains.size(); ++i) {
      if (i == 0 && (strains[0] != 0.0 || tensions[0] != 0.0)) {
        c.fail("its table starts with strain " + to_text(strains[0]) + " and tension " +
               to_text(tensions[0]) + " N; start with 0 and 0");
      }
      if (i > 0 && !(strains[i] > strains[i - 1] && tensions[i] > tensions[i - 1])) {
        c.fail("its table does not increase at strain " + to_text(strains[i]) + " with tension " +
               to_text(tensions[i]) + " N; give strains and tensions that both increase");
      }
    }
  }

 private:
  /// A cubic from the start of a piece on.
  struct Piece {
    double start, energy;
    std::array<double, 4> a;
  };

  template <class T>
  Piece piece(const T& strain) const {
    if (strain < T(0)) return {0.0, 0.0, {0.0, tensions_[1] / strains_[1], 0.0, 0.0}};
    if (!(strain < T(strains_.back()))) {
      return {strains_.back(), energies_.back(), {tensions_.back(), slopes_.back(), 0.0, 0.0}};
    }
    const auto next = std::upper_bound(strains_.begin() + 1, strains_.end() - 1, value_of(strain));
    const auto i = static_cast<std::size_t>(next - strains_.begin()) - 1;
    const double h = strains_[i + 1] - strains_[i], secant = (tensions_[i + 1] - tensions_[i]) / h;
    return {strains_[i],
            energies_[i],
            {tensions_[i], slopes_[i], (3.0 * secant - 2.0 * slopes_[i] - slopes_[i + 1]) / h,
             (slopes_[i] + slopes_[i + 1] - 2.0 * secant) / (h * h)}};
  }

  void find_slopes() {
    const std::size_t n = strains_.size();
    std::vector<double> h, secant;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      h.push_back(strains_[i + 1] - strains_[i]);
      secant.push_back((tensions_[i + 1] - tensions_[i]) / h[i]);
    }
    slopes_.assign(n, secant[0]);
    if (n == 2) return;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double w1 = 2.0 * h[i] + h[i - 1], w2 = h[i] + 2.0 * h[i - 1];
      slopes_[i] = (w1 + w2) / (w1 / secant[i - 1] + w2 / secant[i]);
    }
    slopes_[0] = end_slope(h[0], h[1], secant[0], secant[1]);
    slopes_[n - 1] = end_slope(h[n - 2], h[n - 3], secant[n - 2], secant[n - 3]);
  }
  /// The slope of the parabola through three rows at its end, kept monotone.
  static double end_slope(double h, double next_h, double secant, double next) {
    const double slope = ((2.0 * h + next_h) * secant - h * next) / (h + next_h);
    return std::max(slope, 0.0);
  }

  double stiffness_ = 0.0;
  std::vector<double> strains_, tensions_, slopes_, energies_;
};

inline constexpr const char* kQuasiStatic = "quasi-static";

struct LineDescription : WinchDescription {
  std::string name;
  std::vector<std::string> bodies;
  std::vector<Vec3d> points;
  double EA = 0.0;
  Curve length;
  double damping_ratio = 0.02, mass = 0.0;
  std::string rung = "elastic";
  double settling = 0.2;
  SheaveDescriptions sheaves;
  std::vector<double> strains, tensions;
  std::string paid_out_by;
  double share = 1.0;

  static constexpr const char* type = "Line";
  static constexpr const char* text =
      "An elastic line without mass over points of bodies, with a winch or without; see Scene.add_line.";
  static constexpr auto fields() {
    using D = LineDescription;
    const auto own = std::tuple(
        on_body("bodies", &D::bodies, "bodies of the points, in the order of the path"),
        required("points", &D::points, "m", "coordinates of these bodies"),
        required("EA", &D::EA, "N", "axial stiffness: tension over strain").positive().usually(0.0, 2e10),
        required("length", &D::length, "m", "unstretched; with a winch, at the start").positive(),
        optional("damping_ratio", &D::damping_ratio, "", "of critical damping of `mass` on the line")
            .not_negative()
            .usually(1e-4, 1.0),
        optional("mass", &D::mass, "kg", "that bounces on the line; 0: what its start tells, see LineBounce")
            .not_negative(),
        optional("rung", &D::rung, "", "'elastic', or 'quasi-static': its stretch follows the tension"),
        optional("settling", &D::settling, "s", "in which a quasi-static stretch follows")
            .positive()
            .usually(1e-3, 10.0));
    const auto table = std::tuple(
        optional("strains", &D::strains, "", "from 0, of a table in place of EA").usually(0.0, 3.0),
        optional("tensions", &D::tensions, "N", "at these strains, from 0"));
    const auto segment = std::tuple(
        optional("paid_out_by", &D::paid_out_by, "", "line with mass, on a winch, of which it is a segment"),
        optional("share", &D::share, "", "of the length that this winch pays out")
            .must_be({.minimum = 0.0, .maximum = 1.0, .above = true}));
    return std::tuple_cat(own, WinchDescription::fields(), sheave_fields<D>(), table, segment);
  }

  /// What a winch of it goes by.
  const std::string& winch_name() const { return paid_out_by.empty() ? name : paid_out_by; }

  /// A path over sheaves may have `most` points.
  void check(const Check& c, const SceneNames& names, std::size_t most) const {
    check_path(c, names);
    sheaves.check(points.size(), most, c);
    sheaves.check_neighbours(bodies, points, c);
    LineElasticity::check(strains, tensions, c);
    check_rung(c);
    check_segment(c);
    if (winch) {
      Winch::check(*this, length, share, c);
    } else if (rate.at(0.0).value != 0.0 || rate.pieces().size() > 1 || lag != 0.0) {
      c.fail("has a rate or a lag, and no winch; set winch, or leave them out");
    } else if (tension_gain != 0.0 || drum_inertia != 0.0) {
      c.fail("holds a tension or has a drum, and no winch; set winch, or leave them out");
    }
  }

  static LineDescription example() {
    LineDescription d;
    d.name = "load";
    d.bodies = {"first", "third", "second"};
    d.points = {{2.0, 0.5, -1.0}, {0.2, -0.4, 0.3}, {-1.0, 0.3, 2.0}};
    d.EA = 60.0;
    d.length = Curve::constant(3.0);
    d.damping_ratio = 0.1;
    d.winch = true;
    d.rate = Curve::quintic(0.0, 2.0, 0.1, 0.3);
    d.maximum_rate = 5.0;
    d.maximum_acceleration = 50.0;
    d.lag = 0.4;
    d.tension = Curve::constant(10.0);
    d.tension_gain = 0.01;
    d.dead_band = 1.0;
    d.drum_inertia = 2.0;
    d.drum_radius = 0.5;
    d.maximum_tension = 1e4;
    d.maximum_power = 1e5;
    d.brake = Curve::quintic(0.2, 1.2, 0.0, 1.0);
    d.brake_capacity = 30.0;
    d.brake_give = 0.5;
    d.sheaves.radii = {0.0, 0.2, 0.0};
    d.sheaves.axes = {{0.0, 0.0, 0.0}, {0.3, -1.0, 0.2}, {0.0, 0.0, 0.0}};
    d.sheaves.turns = {0.0, 1.0, 0.0};
    d.sheaves.efficiencies = {1.0, 0.9, 1.0};
    d.sheaves.frictions = {0.0, 0.02, 0.0};
    d.sheaves.slip_speed = 0.4;
    d.strains = {0.0, 0.5, 2.0, 9.0};
    d.tensions = {0.0, 20.0, 150.0, 900.0};
    return d;
  }

 private:
  void check_path(const Check& c, const SceneNames& names) const {
    if (points.size() < 2 || points.size() != bodies.size()) {
      c.fail("has " + std::to_string(bodies.size()) + " bodies and " + std::to_string(points.size()) +
             " points; give as many of both, at least two");
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      names.body(c, bodies[i], true);
      if (i > 0 && bodies[i] == bodies[i - 1] && points[i] == points[i - 1]) {
        c.fail("visits point " + std::to_string(i) + " twice in a row; leave one of them out");
      }
    }
    const auto other = [&](const std::string& name) { return name != bodies.front(); };
    if (std::none_of(bodies.begin(), bodies.end(), other)) {
      c.fail("has all its points on '" + bodies.front() + "', which it cannot move; name two bodies");
    }
  }

  void check_rung(const Check& c) const {
    if (rung != kQuasiStatic && rung != "elastic") {
      c.fail("rung '" + rung + "' is unknown; choose 'elastic' or 'quasi-static'");
    }
    if (rung != kQuasiStatic) return;
    if (!strains.empty()) c.fail("a quasi-static stretch takes EA, no table; choose rung 'elastic'");
    if (winch && lag == 0.0) {
      c.fail(
          "a quasi-static stretch needs a smooth length, and its winch has no lag; give one, such as 0.1 s");
    }
    if (drum_inertia > 0.0) {
      c.fail("a drum with inertia rings with its line; choose rung 'elastic', or leave drum_inertia out");
    }
    for (const CurveKink& kink : length.kinks()) {
      if (kink.time <= 0.0 || std::abs(kink.jump(0)) + std::abs(kink.jump(1)) <= kJump) continue;
      c.fail("a quasi-static stretch needs a smooth length, and that given jumps at t = " +
             to_text(kink.time) + " s, or its rate; smooth it, or choose rung 'elastic'");
    }
  }
  void check_segment(const Check& c) const {
    if (paid_out_by.empty()) {
      if (share != 1.0) c.fail("has a share of a line that no winch pays out; give paid_out_by, or no share");
      return;
    }
    if (winch && lag == 0.0) {
      c.fail(
          "is a segment of a line with mass, which needs a smooth rate, and its winch has no lag; give "
          "one, such as 0.1 s");
    }
  }
  static constexpr double kJump = 1e-9;  // m and m/s
};

}  // namespace seacrane
