#pragma once

#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/math/select.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

struct EntrappedWaterDescription {
  std::string name, body;
  Vec3d point = Vec3d::Zero();  // centre of its bottom, body coordinates
  double area = 0.0, height = 0.0;
  std::vector<Vec3d> opening_points;  // likewise
  std::vector<double> opening_areas;
  double discharge_coefficient = 0.6;
  double initial = 0.0;
  double density = 0.0;

  static constexpr const char* type = "EntrappedWater";
  static constexpr const char* text =
      "Water in a compartment of a body, which comes and goes through openings; see "
      "Scene.add_entrapped_water.";
  static constexpr auto fields() {
    using D = EntrappedWaterDescription;
    return std::tuple(
        on_body("body", &D::body),
        optional("point", &D::point, "m", "centre of its bottom, body coordinates"),
        required("area", &D::area, "m2", "of its section, the same at every height").positive(),
        required("height", &D::height, "m", "along the body's z").positive(),
        required("opening_points", &D::opening_points, "m", "centres of its openings, body coordinates"),
        required("opening_areas", &D::opening_areas, "m2", "of the openings").positive(),
        optional("discharge_coefficient", &D::discharge_coefficient, "",
                 "C_d: share of an opening's area that the jet fills")
            .must_be({.minimum = 0.0, .maximum = 1.0, .above = true}),
        optional("initial", &D::initial, "m3", "of water in it at the start").not_negative(),
        required("density", &D::density, "kg/m3", "of the water").positive().usually(900.0, 1100.0));
  }
};

/// Water in a prism along the z axis n of a body, of section A and height H, from its bottom at b. Its volume
/// V is a state. Through each opening
///
///   q = C_d A_o sqrt(2 g) dh / (dh^2 + e^2)^(1/4),   dh = max(p / (density g) - z_o, 0) - max(z_w - z_o, 0)
///
/// comes in, with z_o the opening's elevation, p / (density g) the pressure of the undisturbed sea there as
/// an elevation, and z_w that of the middle of the surface inside, at b + n V / A: a level surface that meets
/// walls alone is there at any heel. e rounds the root off. V' is the sum of q, held within 0 and A H.
///
/// The water moves with the body as a rod on the axis, from the bottom to V / A. A slice of it comes and goes
/// at its upper end: what comes in with a velocity u takes -density q (v - u) there, and what leaves has the
/// velocity v that it had. So no inertia of flow along the axis: openings are small against A.
///
/// Of its power, water that comes in brings g times the elevation outside and u^2 / 2. What is left of the
/// first over z_w, and (v - u)^2 / 2, are lost in its jet; both end as heat in the same eddies, in one state.
struct EntrappedWater {
  static constexpr const char* kind = "entrapped water";
  using Description = EntrappedWaterDescription;
  static constexpr std::size_t kMostOpenings = 12;
  static constexpr double kRoundedHead = 1e-3;  // m, e
  /// Of e: a level at which as much time has gone by as Torricelli's law takes to none, from any head above.
  static constexpr double kFilm = 0.17387212574195163;
  static constexpr double kWidest = 10.0;                 // roots of the area, beside the axis
  static constexpr double kUpright = 0.8660254037844386;  // cosine of 30 deg

  struct Opening {
    Vec3d point;  // from the state point, body axes
    double area = 0.0;
    int stencil = -1;  // its point in the sea
  };

  Description d;
  int body = 0;
  Vec3d point, axis;  // of the bottom, from the state point; body axes
  std::vector<Opening> openings;
  double gravity = 0.0, per_gravity = 0.0;  // m/s2; 1 over it, 0 where there is none
  StateRange states;                        // volume, and what is lost, J

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body);
    const std::size_t n = d.opening_points.size();
    if (n == 0 || n > kMostOpenings || d.opening_areas.size() != n) {
      c.fail("has " + std::to_string(n) + " opening_points and " + std::to_string(d.opening_areas.size()) +
             " opening_areas; give as many of both, 1 to " + std::to_string(kMostOpenings));
    }
    for (std::size_t i = 0; i < n; ++i) check_opening(d, i, c);
    if (d.initial > d.area * d.height) {
      c.fail("initial is " + to_text(d.initial) + " m3, and it holds " + to_text(d.area * d.height) +
             " m3; give at most that");
    }
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.body = "second";
    d.point = {0.2, -0.1, -3.0};
    d.area = 2.0;
    d.height = 5.0;
    d.opening_points = {{0.3, 0.2, -2.8}, {-0.4, 0.1, -2.5}};
    d.opening_areas = {0.05, 0.1};
    d.initial = 4.0;
    d.density = 0.1;
    return d;
  }

  template <class Context>
  static EntrappedWater compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, d.point);
    EntrappedWater out;
    out.d = d;
    out.body = on.body;
    out.point = on.point;
    out.axis = on.axes.col(2);
    for (std::size_t i = 0; i < d.opening_points.size(); ++i) {
      const std::string name = "opening " + std::to_string(i + 1) + " of entrapped water '" + d.name + "'";
      out.openings.push_back({context.attach(d.body, d.opening_points[i]).point, d.opening_areas[i],
                              context.stencil({name, 1})});
    }
    out.gravity = context.gravity();
    out.per_gravity = out.gravity > 0.0 ? 1.0 / out.gravity : 0.0;
    const double scale = context.length_scale() * d.area;
    const double lifted = d.density * (out.gravity > 0.0 ? out.gravity : 1.0) * d.height;
    out.states = {context.state({d.name + ".volume", "m3", d.initial, scale}), 2};
    context.state({d.name + ".flow_loss", "J", 0.0, lifted * scale});
    return out;
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 1> bodies() const { return {body}; }

  template <class T>
  void add_inertia(const LoadInput<T>& in, Mat6<T>* mass) const {
    const Column<T> water = column(in);
    const Mat3<T> lever = skew<T>(water.center);
    Mat6<T>& to = mass[body];
    for (int i = 0; i < 3; ++i) to(i, i) += water.mass;
    to.template bottomLeftCorner<3, 3>() += lever * water.mass;
    to.template topRightCorner<3, 3>() -= lever * water.mass;
    to.template bottomRightCorner<3, 3>() += turning_inertia(water);
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Column<T> water = column(in);
    const Vec3<T>& turning = in.bodies[body].angular_velocity;
    BodyLoad<T>& on = out.wrench[body];
    on.add(Vec3<T>(T(0), T(0), T(-gravity) * water.mass), water.center);
    on.force -= cross<T>(turning, cross<T>(turning, water.center)) * water.mass;
    on.moment -= cross<T>(turning, turning_inertia(water) * turning);
    T loss(0);
    Flows<T> flows;
    out.state_rates[states.first] = exchange(in, water, flows);
    for (std::size_t i = 0; i < openings.size(); ++i) loss += take_up(water, flows[i], out);
    out.state_rates[states.first + 1] = loss;
    out.add_power(-loss);
  }

  double potential(const LoadInput<double>& in) const {
    const Column<double> water = column(in);
    return gravity * water.mass * (in.bodies[body].position.z() + water.center.z());
  }

  std::vector<std::string> reached(int from, int to) const { return bounds_met(d.name, kMargins, from, to); }
  static bool has_sides() { return true; }
  int side(const LoadInput<double>& in) const { return margins(in).side(); }
  double across(const LoadInput<double>& in, int from, int to) const { return margins(in).across(from, to); }

 private:
  /// Events; and where the bottom is dry, beyond which nothing leaves.
  static constexpr std::array<Margin, 4> kMargins = {{{"full"}, {"empty"}, {"leans"}, {}}};

  /// The water, inertial axes.
  template <class T>
  struct Column {
    T volume, mass, height;
    Vec3<T> axis, center, top;  // levers from the state point
    T level;                    // elevation of its surface
    Vec3<T> velocity;           // of its upper end
  };
  /// What comes in through one opening.
  template <class T>
  struct Flow {
    T rate{0};                           // m3/s
    T elevation{0};                      // to which the sea stands outside, the opening's own in air
    Vec3<T> velocity = Vec3<T>::Zero();  // of the sea there
  };
  template <class T>
  using Flows = std::array<Flow<T>, kMostOpenings>;

  template <class T>
  Column<T> column(const LoadInput<T>& in) const {
    const auto& k = in.bodies[body];
    Column<T> out;
    out.volume = in.states[states.first];
    out.mass = T(d.density) * out.volume;
    out.height = out.volume * T(1.0 / d.area);
    out.axis = k.rotation * axis.cast<T>();
    const Vec3<T> bottom = k.rotation * point.cast<T>();
    out.center = bottom + out.axis * (T(0.5) * out.height);
    out.top = bottom + out.axis * out.height;
    out.level = k.position.z() + out.top.z();
    out.velocity = k.velocity + cross<T>(k.angular_velocity, out.top);
    return out;
  }

  /// Of a rod about the state point.
  template <class T>
  static Mat3<T> turning_inertia(const Column<T>& water) {
    const Mat3<T> lever = skew<T>(water.center), along = skew<T>(water.axis);
    const T own = water.mass * water.height * water.height * T(1.0 / 12.0);
    return -(lever * lever) * water.mass - (along * along) * own;
  }

  /// The sea at an opening.
  template <class T>
  LocalFlow<T> flow_at(const LoadInput<T>& in, int stencil, const Vec3<T>& place) const {
    if (!(place.z() < T(in.sea->crest()))) return {};  // above all crests there is none
    if constexpr (std::is_same_v<T, double>) {
      return in.sea->template in_row<double>(stencil, 0, in.time, {place}, Vec3d::Zero());
    } else {
      return in.sea->template at<T>(in.time, place);
    }
  }

  /// A head, zero in air.
  template <class T>
  static T head(const T& elevation, const T& opening) {
    return select(elevation > opening, T(elevation - opening), T(0));
  }

  template <class T>
  T through(double area, const T& heads) const {
    using std::sqrt;
    const T size = sqrt(heads * heads + T(kRoundedHead * kRoundedHead));
    return T(d.discharge_coefficient * area * std::sqrt(2.0 * gravity)) * heads / sqrt(size);
  }

  /// What comes in and goes out. Returns the rate of the volume: full, it takes no more than it gives; dry,
  /// it gives no more than it takes.
  template <class T>
  T exchange(const LoadInput<T>& in, const Column<T>& water, Flows<T>& out) const {
    const auto& k = in.bodies[body];
    T into(0), from(0);
    for (std::size_t i = 0; i < openings.size(); ++i) {
      const Vec3<T> place = k.position + k.rotation * openings[i].point.cast<T>();
      const LocalFlow<T> flow = flow_at(in, openings[i].stencil, place);
      const T outside = flow.pressure * T(per_gravity);
      out[i].elevation = select(outside > place.z(), outside, place.z());
      out[i].velocity = flow.velocity;
      out[i].rate = through(openings[i].area, T(head(outside, place.z()) - head(water.level, place.z())));
      (out[i].rate > T(0) ? into : from) += out[i].rate;
    }
    const bool full = !(water.volume < T(d.area * d.height)), dry = !(water.volume > T(0));
    const T sum = into + from;
    if (!(full && sum > T(0)) && !(dry && sum < T(0))) return sum;
    const T share = full ? T(-from / into) : T(-into / from);
    for (std::size_t i = 0; i < openings.size(); ++i) {
      if ((out[i].rate > T(0)) == full) out[i].rate *= share;
    }
    return T(0);
  }

  /// What the water through an opening does to the body and to the ledger. Returns the power that is lost.
  template <class T>
  T take_up(const Column<T>& water, const Flow<T>& flow, LoadSum<T>& out) const {
    const T mass = T(d.density) * flow.rate;
    const bool enters = mass > T(0);
    const Vec3<T>& own = enters ? flow.velocity : water.velocity;
    const Vec3<T> slip = water.velocity - own;
    out.wrench[body].add(Vec3<T>(slip * T(-mass)), water.top);
    out.add_power(mass * (T(gravity) * flow.elevation + T(0.5) * own.squaredNorm()));
    return mass * (T(gravity) * (flow.elevation - water.level) + T(0.5) * slip.squaredNorm());
  }

  Margins margins(const LoadInput<double>& in) const {
    const auto& k = in.bodies[body];
    const Column<double> water = column(in);
    auto own = kMargins;
    own[0].value = d.area * d.height - water.volume;
    own[1].value = water.volume - d.area * kFilm * kRoundedHead;
    own[2].value = water.axis.z() - kUpright;
    own[3].value = water.volume;
    Margins out(own);
    for (const Opening& one : openings) {
      const Vec3d place = k.position + k.rotation * one.point;
      const double outside = flow_at(in, one.stencil, place).pressure * per_gravity;
      out.add({nullptr, outside - place.z()});
      out.add({nullptr, water.level - place.z()});
    }
    return out;
  }

  static void check_opening(const Description& d, std::size_t i, const Check& c) {
    const Vec3d place = d.opening_points[i] - d.point;
    const std::string which = "opening " + std::to_string(i + 1);
    const double rounding = 1e-9 * d.height;
    if (place.z() < -rounding || place.z() > d.height + rounding) {
      c.fail(which + " is at " + to_text(place.z()) + " m over the bottom, and the height is " +
             to_text(d.height) + " m; give a point between bottom and top, in body coordinates");
    }
    if (place.head<2>().norm() > kWidest * std::sqrt(d.area)) {
      c.fail(which + " is " + to_text(place.head<2>().norm()) + " m beside the middle of a section of " +
             to_text(d.area) + " m2; give a point on its wall, in body coordinates");
    }
    if (d.opening_areas[i] > d.area) {
      c.fail(which + " has " + to_text(d.opening_areas[i]) + " m2, more than the section of " +
             to_text(d.area) + " m2; give the area of the opening");
    }
  }
};

}  // namespace seacrane
