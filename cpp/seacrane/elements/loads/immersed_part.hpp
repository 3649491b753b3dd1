#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/elements/loads/water_by_cause.hpp"
#include "seacrane/elements/loads/wet_volume.hpp"
#include "seacrane/math/monotone_spline.hpp"
#include "seacrane/math/spatial.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

struct ImmersedPartDescription {
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
        on_body("body", &D::body), optional("shape", &D::shape, "", "'box', 'cylinder', 'sphere' or 'table'"),
        optional("point", &D::point, "m", "its centre, body coordinates"),
        optional("axes", &D::axes, "", "columns: its axes in those of the body"),
        required("size", &D::size, "m", "along its axes; of a cylinder, its length and twice its diameter"),
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
                 "at zero frequency, at the depths: what slow waves feel, for coefficient_scatter alone")
            .not_negative());
  }

  bool is(const char* name) const { return shape == name; }
};

/// Water on a part of a body with frame at its centre P, its lowest point at a depth h below the surface at
/// P. With u the undisturbed flow, its mean over the part, v the velocity of P over it, A(h) the added mass
/// along the part's axes, V the volume that is wet,
///
///   F = rho V (Du/Dt + g e_z) - A (a - Du/Dt) - s A' h' v - (d/dt of A by turning) v - drag,
///   M = -v x (A v) and the moment of buoyancy,   s = 1 on entry (h' > 0), 0 on exit.
///
/// Momentum A v is brought in on entry; half of |A' h'| v^2 goes with the jet, and as much remains in the
/// water on exit. The moment is Munk's (Kirchhoff's equations; H. Lamb, Hydrodynamics, art. 124).
///
/// The energies of the ledger are those of still water: v_b^T A v_b / 2 with the body's own velocity v_b, and
/// that of buoyancy at the depth; the power of the sea is what changes them.
struct ImmersedPart {
  static constexpr const char* kind = "immersed part";
  using Description = ImmersedPartDescription;
  enum class Shape { box, cylinder, sphere, table };

  Description d;
  Shape shape = Shape::box;
  int body = 0;
  Vec3d point;              // from the state point, body axes
  Vec3d first_point, step;  // of its row
  Mat3d axes;
  double whole = 0.0, volume = 0.0;  // m3; and of it, what keeps water out
  double weight = 0.0;               // of the water that it keeps out, N
  double edge = 0.0;                 // m, by which edges are round: no attitude is singular
  MonotoneSpline<3> added;
  MonotoneSpline<1> wet_volume;  // of a table
  int place_in_row = 0;
  StateRange states;             // what slam has taken, J
  Mat3d widths = Mat3d::Zero();  // columns: over which the flow is averaged, its axes
  int stencil = -1;              // its point in the sea

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body);
    if (!d.is("box") && !d.is("cylinder") && !d.is("sphere") && !d.is("table")) {
      c.fail("shape '" + d.shape + "' is unknown; choose 'box', 'cylinder', 'sphere' or 'table'");
    }
    check_size(d, c);
    const bool whole = d.place == std::floor(d.place) && d.count == std::floor(d.count);
    if (!whole || d.place < 0.0 || d.place >= d.count || d.count > kMostStrips) {
      c.fail("place is " + to_text(d.place) + " in a row of " + to_text(d.count) +
             "; give whole numbers, 0 up to " + "one less than count, which is " + to_text(kMostStrips) +
             " at most");
    }
    if (!(d.axes.transpose() * d.axes).isIdentity(1e-9) || d.axes.determinant() < 0.0) {
      c.fail("axes are not those of a right-handed frame; give unit columns at right angles");
    }
    const std::size_t n = d.depths.size();
    if (n < 2 || d.added_masses.size() != n || d.depths.front() != 0.0) {
      c.fail("has " + std::to_string(n) + " depths and " + std::to_string(d.added_masses.size()) +
             " added masses; give as many of both, at least two, from depth 0 m on");
    }
    if (!d.slow_added_masses.empty() && d.slow_added_masses.size() != n) {
      c.fail("has " + std::to_string(d.slow_added_masses.size()) + " slow_added_masses at " +
             std::to_string(n) + " depths; give as many of both");
    }
    c.increases("depths", d.depths);
    check_growth("added_masses", d.added_masses, d, c);
    if (d.is("table") != !d.volumes.empty()) c.fail("volumes belong to shape 'table', which needs them");
    if (!d.is("table")) return;
    if (d.volumes.size() != n) {
      c.fail("has " + std::to_string(d.volumes.size()) + " volumes at " + std::to_string(n) +
             " depths; give as many of both");
    }
    check_growth("volumes", rows(d.volumes), d, c);
  }

  static Description example() {
    Description d;
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

  template <class Context>
  static ImmersedPart compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, d.point);
    ImmersedPart out;
    out.d = d;
    out.shape = shape_of(d);
    out.body = on.body;
    out.point = on.point;
    out.first_point = context.attach(d.body, d.point - d.place * d.step).point;
    out.step = on.axes * d.step;
    out.place_in_row = static_cast<int>(d.place);
    out.axes = on.axes * d.axes;
    out.whole = volume_of(d);
    out.volume = d.fill * volume_of(d);
    out.weight = d.density * context.gravity() * out.volume;
    out.edge = (out.shape == Shape::box ? kRound : 0.1 * kRound) * 0.5 * d.size.maxCoeff();
    out.added = MonotoneSpline<3>(d.depths, d.added_masses);
    if (d.is("table")) out.wet_volume = MonotoneSpline<1>(d.depths, rows(d.volumes));
    const double largest = d.added_masses.back().maxCoeff();
    const double scale = (largest > 0.0 ? largest : 1.0) * context.length_scale();  // at 1 m/s
    out.widths = widths_of(out.shape, d.size).asDiagonal();
    out.stencil = context.stencil({.name = "immersed part '" + (d.row.empty() ? d.name : d.row) + "'",
                                   .count = static_cast<std::size_t>(d.count),
                                   .waves = d.wave_factor});
    out.states = {context.state({d.name + ".slam_loss", "J", 0.0, scale}), 1};
    return out;
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 1> bodies() const { return {body}; }

  template <class T>
  void add_inertia(const LoadInput<T>& in, Mat6<T>* mass) const {
    const Place<T> at = place(in);
    if (!(at.depth > T(0))) return;
    const Vec3<T> along = added.at(at.depth).value;
    const Mat3<T> weighted = at.axes * along.asDiagonal(), a = weighted * at.axes.transpose();
    add_mass_at<T>(at.lever, a, mass[body]);
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Place<T> at = place(in);
    T& slam = out.state_rates[states.first];
    slam = T(0);
    const WetShare<T> wet = wet_share(at);
    if (wet.share > T(0)) {
      float_on(at, wet, out);
      const Vec3<T> force = drag(at, wet);
      out.wrench[body].add(force, at.lever);
      out.add_power(force.dot(at.own));
    }
    if (at.depth > T(0)) {
      const Carried<T> water = carried(at);
      out.wrench[body].add(water.force, at.lever);
      out.wrench[body].moment += water.moment;
      out.add_power(water.power);
      slam = water.loss;
    }
  }

  /// By cause, with an acceleration of its body (state point, inertial axes).
  WaterByCause by_cause(const LoadInput<double>& in, const Vec6d& acceleration) const {
    using Cause = WaterCause;
    const Place<double> at = place(in);
    const WetShare<double> wet = wet_share(at);
    WaterByCause out;
    if (wet.share > 0.0) {
      out.force(Cause::buoyancy).z() = weight * wet.share;
      out.force(Cause::waves) = at.flow.acceleration * (d.density * volume * wet.share);
      out.force(Cause::drag) = drag(at, wet);
      out.power(Cause::waves) = weight * wet.share * at.rise + out.force(Cause::waves).dot(at.own);
      out.power(Cause::drag) = out.force(Cause::drag).dot(at.own);
    }
    if (!(at.depth > 0.0)) return out;
    const auto here = added.at(at.depth);
    const Carried<double> water = carried(at);
    const Mat3d mass = at.axes * here.value.asDiagonal() * at.axes.transpose();
    const Vec3d gain = at.rate * here.slope, v = at.axes.transpose() * at.velocity;
    const Vec3d accelerated = acceleration.head<3>() + Vec3d(acceleration.tail<3>()).cross(at.lever);
    const Vec3d driven = mass * at.flow.acceleration;
    out.force(Cause::waves) += driven;
    out.force(Cause::slam) = -(at.axes * gain.cwiseMax(0.0).cwiseProduct(v));
    out.force(Cause::added_mass) = water.force - out.force(Cause::slam) - driven - mass * accelerated;
    out.power(Cause::slam) = -water.loss;
    out.power(Cause::waves) += water.power + water.loss;
    out.momentum = mass * at.velocity;
    out.shed = -(at.axes * gain.cwiseMin(0.0).cwiseProduct(v));
    return out;
  }

  double potential(const LoadInput<double>& in) const {
    const Place<double> at = place(in);
    if (shape != Shape::table) return weight * wet_share(at).integral;
    return at.depth > 0.0 ? weight / whole * wet_volume.integral(at.depth)[0] : 0.0;
  }

  std::vector<std::string> reached(int from, int to) const {
    return bounds_met(d.name, Sides{Margin{"touch"}, {"awash"}}, from, to);
  }
  static bool has_sides() { return true; }
  int side(const LoadInput<double>& in) const { return margins(in).side(); }
  double across(const LoadInput<double>& in, int from, int to) const { return margins(in).across(from, to); }

 private:
  using Sides = std::array<Margin, 2>;
  static constexpr double kRound = 1e-3;  // of half a size, or of a cosine
  static constexpr double kMostStrips = 1000.0;

  /// Where a part is, inertial axes.
  template <class T>
  struct Place {
    Vec3<T> lever;     // from the state point to its centre
    Mat3<T> axes;      // its own
    Vec3<T> own;       // velocity of its centre
    Vec3<T> velocity;  // and over the water
    Vec3<T> turning;
    LocalFlow<T> flow;
    T rise;                 // how fast the surface above its centre rises
    T center, depth, rate;  // depths of its centre, of its lowest point, and how fast that one sinks
    T below;                // its lowest point under its centre
  };

  /// What the added mass does to a part beside -A a.
  template <class T>
  struct Carried {
    Vec3<T> force, moment;        // inertial axes
    T loss = T(0), power = T(0);  // by slam, and into the energy of the ledger
  };

  /// |n|, rounded off at zero, exact at 0 and 1, from n^2; and its derivative in n^2.
  template <class T>
  struct Rounded {
    T value, slope;
    explicit Rounded(const T& square) {
      using std::sqrt;
      const double whole = std::sqrt(1.0 + kRound * kRound) - kRound;
      const T root = sqrt(square + T(kRound * kRound));
      value = (root - T(kRound)) * T(1.0 / whole);
      slope = T(0.5 / whole) / root;
    }
  };

  Margins margins(const LoadInput<double>& in) const {
    const Place<double> at = place(in);
    return Margins(Sides{Margin{"touch", -at.depth}, {"awash", at.below - at.center}});
  }

  template <class T>
  Place<T> place(const LoadInput<T>& in) const {
    const auto& k = in.bodies[body];
    Place<T> at;
    at.lever = k.rotation * point.cast<T>();
    at.axes = k.rotation * axes.cast<T>();
    at.turning = k.angular_velocity;
    at.own = k.velocity + cross<T>(at.turning, at.lever);
    at.rate = -at.own.z();
    at.below = T(0);
    const auto reach = [&](double half, const T& square, const T& square_rate) {
      const Rounded<T> share(square);
      at.below += T(half) * share.value;
      at.rate += T(half) * share.slope * square_rate;
    };
    if (shape == Shape::box || shape == Shape::cylinder) {
      for (int i = 0; i < (shape == Shape::box ? 3 : 1); ++i) {
        const T n = at.axes(2, i);
        const T n_rate = at.turning.x() * at.axes(1, i) - at.turning.y() * at.axes(0, i);
        const T square = n * n, square_rate = T(2) * n * n_rate;
        reach(0.5 * d.size[i], square, square_rate);
        if (shape == Shape::cylinder) reach(0.5 * d.size[1], T(1) - square, -square_rate);
      }
    } else {
      at.below = T(0.5 * d.size[2]);
    }
    float_in<T>(in, k.position + at.lever, at);
    return at;
  }

  /// The sea at a part; above all crests there is none.
  template <class T>
  void float_in(const LoadInput<T>& in, const Vec3<T>& center, Place<T>& at) const {
    using std::sqrt;
    if (center.z() - at.below < T(in.sea->crest(stencil))) {
      const auto& k = in.bodies[body];
      FlowPlace<T> first{k.position + k.rotation * first_point.cast<T>(), at.axes * widths.cast<T>(),
                         at.turning, T(0)};
      first.height = sqrt(first.extents.row(2).squaredNorm() + T(edge * edge));  // plates have slopes too
      at.flow =
          in.sea->template in_row<T>(stencil, place_in_row, in.time, first, k.rotation * step.cast<T>());
    }
    at.velocity = at.own - at.flow.velocity;
    at.rise = at.flow.elevation_rate + at.flow.slope[0] * at.own.x() + at.flow.slope[1] * at.own.y();
    at.center = at.flow.elevation - center.z();
    at.depth = at.center + at.below;
    at.rate += at.rise;
  }

  /// Widths of a box with the second moments of the shape: a mean over it errs from the fourth order on.
  static Vec3d widths_of(Shape shape, const Vec3d& size) {
    const double disc = std::sqrt(0.75), ball = std::sqrt(0.6);
    if (shape == Shape::cylinder) return size.cwiseProduct(Vec3d(1.0, disc, disc));
    return shape == Shape::sphere ? Vec3d(ball * size) : size;
  }

  /// Half of a size along the vertical, from the square of its cosine.
  template <class T>
  T width(double half, const T& square) const {
    using std::sqrt;
    return sqrt(T(half * half) * square + T(edge * edge));
  }

  template <class T>
  WetShare<T> wet_share(const Place<T>& at) const {
    const auto square = [&](int i) -> T { return at.axes(2, i) * at.axes(2, i); };
    const Vec3d half = 0.5 * d.size;
    switch (shape) {
      case Shape::box:
        return wet_box<T>(at.center, Vec3<T>(width<T>(half[0], square(0)), width<T>(half[1], square(1)),
                                             width<T>(half[2], square(2))));
      case Shape::cylinder:
        return wet_cylinder<T>(
            at.center, Vec3<T>(width<T>(half[0], square(0)), width<T>(half[1], T(1) - square(0)), T(0)));
      case Shape::sphere:
        return wet_sphere<T>(at.center, half[0]);
      case Shape::table:
        break;
    }
    WetShare<T> out;
    if (at.depth > T(0)) out.share = wet_volume.at(at.depth).value[0] / T(whole);
    return out;
  }

  /// Buoyancy with the pressure of the flow: the gradient of its energy.
  template <class T>
  void float_on(const Place<T>& at, const WetShare<T>& wet, LoadSum<T>& out) const {
    const Vec3<T> up(T(0), T(0), T(weight) * wet.share);
    const Vec3<T> pushed = at.flow.acceleration * (T(d.density * volume) * wet.share);
    out.wrench[body].add(up + pushed, at.lever);
    out.add_power(up.z() * at.rise + pushed.dot(at.own));
    const auto turn = [&](int i, const T& over_cosine) {
      const T energy = T(weight) * over_cosine;  // times axis x e_z
      out.wrench[body].moment[0] -= energy * at.axes(1, i);
      out.wrench[body].moment[1] += energy * at.axes(0, i);
    };
    const Vec3d half = 0.5 * d.size;
    const auto slope = [&](int i, double of, int axis) -> T {
      const T n = at.axes(2, axis), square = n * n;
      return wet.over_width[i] * T(of * of) * n / width<T>(of, i == axis ? square : T(1) - square);
    };
    if (shape == Shape::box) {
      for (int i = 0; i < 3; ++i) turn(i, slope(i, half[i], i));
    } else if (shape == Shape::cylinder) {
      turn(0, slope(0, half[0], 0) - slope(1, half[1], 0));
    }
  }

  /// Drag of the part that is wet: of a cylinder across and along by themselves, of a sphere by its speed.
  template <class T>
  Vec3<T> drag(const Place<T>& at, const WetShare<T>& wet) const {
    using std::sqrt;
    const Vec3<T> v = at.axes.transpose() * at.velocity;
    Vec3<T> along = Vec3<T>::Zero();
    const auto brake = [&](int first, int last) {  // by their common speed
      T square = T(0);
      for (int i = first; i <= last; ++i) square += v[i] * v[i];
      if (!(square > T(0))) return;
      const T speed = sqrt(square) * wet.share;
      for (int i = first; i <= last; ++i) along[i] = T(-d.drag[i]) * speed * v[i];
    };
    if (shape == Shape::sphere) {
      brake(0, 2);
    } else if (shape == Shape::cylinder) {
      brake(0, 0);
      brake(1, 2);
    } else {
      for (int i = 0; i < 3; ++i) brake(i, i);
    }
    return at.axes * along;
  }

  template <class T>
  Carried<T> carried(const Place<T>& at) const {
    Carried<T> out;
    const auto here = added.at(at.depth);
    const auto local = [&](const Vec3<T>& x) -> Vec3<T> { return at.axes.transpose() * x; };
    const Vec3<T> v = local(at.velocity), own = local(at.own);
    const Vec3<T> momentum = at.axes * here.value.cwiseProduct(v);
    const Vec3<T> swept = cross<T>(at.turning, cross<T>(at.turning, at.lever));
    const Vec3<T> swing = swept - cross<T>(at.turning, at.velocity) - at.flow.acceleration;
    Vec3<T> along = here.value.cwiseProduct(local(swing));
    T stored = T(0);  // what the ledger's energy of A gains beside that of A a
    const Vec3<T> turned = here.value.cwiseProduct(local(swept - cross<T>(at.turning, at.own)));
    for (int i = 0; i < 3; ++i) {
      const T gain = at.rate * here.slope[i];
      const bool enters = gain > T(0);
      if (enters) along[i] += gain * v[i];
      const T power = T(0.5) * gain * v[i] * v[i];
      out.loss += enters ? power : T(-power);
      stored += own[i] * (turned[i] + T(0.5) * gain * own[i]);
    }
    out.force = -(at.axes * along + cross<T>(at.turning, momentum));
    out.moment = -cross<T>(at.velocity, momentum);
    out.power = out.force.dot(at.own) + out.moment.dot(at.turning) + stored;
    return out;
  }

  static Shape shape_of(const Description& d) {
    if (d.is("cylinder")) return Shape::cylinder;
    if (d.is("sphere")) return Shape::sphere;
    return d.is("table") ? Shape::table : Shape::box;
  }
  static double volume_of(const Description& d) {
    using std::numbers::pi;
    if (d.is("cylinder")) return pi / 4.0 * d.size[0] * d.size[1] * d.size[1];
    if (d.is("sphere")) return pi / 6.0 * std::pow(d.size[0], 3);
    return d.is("table") ? d.volumes.back() : d.size.prod();
  }
  static std::vector<Eigen::Matrix<double, 1, 1>> rows(const std::vector<double>& values) {
    std::vector<Eigen::Matrix<double, 1, 1>> out;
    for (const double v : values) out.emplace_back(v);
    return out;
  }

  static void check_size(const Description& d, const Check& c) {
    if (d.size.minCoeff() < 0.0 || d.size.maxCoeff() <= 0.0) {
      c.fail("size holds " + to_text(d.size.minCoeff()) + " m; give lengths of which one is above 0 m");
    }
    if (d.is("cylinder") && d.size[1] != d.size[2]) {
      c.fail("a cylinder's size is its length and twice its diameter; y and z differ");
    }
    if (d.is("sphere") && (d.size[0] != d.size[1] || d.size[0] != d.size[2])) {
      c.fail("a sphere's size is its diameter three times; its numbers differ");
    }
  }

  /// A table that falls would give slam a wrong sign.
  template <class Row>
  static void check_growth(const char* what, const std::vector<Row>& values, const Description& d,
                           const Check& c) {
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
      if ((values[i + 1] - values[i]).minCoeff() >= 0.0) continue;
      c.fail(std::string(what) + " fall between " + to_text(d.depths[i]) + " and " +
             to_text(d.depths[i + 1]) + " m of depth; give values that grow");
    }
  }
};

}  // namespace seacrane
