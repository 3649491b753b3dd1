#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/loads/paid_out.hpp"
#include "seacrane/elements/loads/span.hpp"
#include "seacrane/elements/loads/water_by_cause.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/spatial.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

struct ImmersedSpanDescription : SpanDescription {
  double density = 0.0, diameter = 0.0;
  Curve length;
  double added_mass_coefficient = 1.0, drag_coefficient = 0.0, drag_coefficient_along = 0.0;
  std::string source;
  std::string paid_out_by;
  double share = 1.0;

  static constexpr const char* type = "ImmersedSpan";
  static constexpr const char* text =
      "Water on a straight span of wire between two points: buoyancy, added mass, drag; see Scene.add_line.";
  static constexpr auto fields() {
    using D = ImmersedSpanDescription;
    return std::tuple_cat(
        SpanDescription::fields(),
        std::tuple(
            required("density", &D::density, "kg/m3", "of the water").positive().usually(900.0, 1100.0),
            required("diameter", &D::diameter, "m", "").positive().usually(5e-4, 3.0),
            required("length", &D::length, "m", "of wire in the span, a number or a Curve")
                .positive()
                .usually(0.0, 1e4),
            optional("added_mass_coefficient", &D::added_mass_coefficient, "",
                     "C_a: added mass across, over the water that it displaces")
                .not_negative()
                .usually(0.05, 10.0),
            required("drag_coefficient", &D::drag_coefficient, "", "across, over the diameter")
                .not_negative()
                .usually(0.05, 20.0),
            optional("drag_coefficient_along", &D::drag_coefficient_along, "", "along, over the skin")
                .not_negative()
                .usually(1e-3, 1.0),
            optional("source", &D::source, "", "where its coefficients are from"),
            optional("paid_out_by", &D::paid_out_by, "", "line with mass, on a winch, that it is a part of"),
            optional("share", &D::share, "", "of the length that this winch pays out")
                .must_be({.minimum = 0.0, .maximum = 1.0, .above = true})));
  }
};

/// Water on a straight span of wire. Half of the span belongs to either of its ends, which moves by v in
/// water that moves by u. With t along the span, d from its first end to the second, P = I - t t^T, w = v -
/// u, and s the share of the half that is below the surface, each end has
///
///   density V/2 s (Du/Dt + g e_z) - m P (a - Du/Dt) - m P' w - max(m', 0) P w - drag +- c,
///   m = s C_a density V/2,   c = d/dd of the sum of w^T m P w / 2 = -sum m (t . w) P w / |d|,
///
/// V the volume of the wire. P turns with d, so that the second end has c and the first -c: the moment of
/// Munk on a slender body (H. Lamb, Hydrodynamics, art. 124). As of a part (ImmersedPart), slam brings
/// momentum in on entry, and half of |m'| w^T P w is lost on entry and exit. There is no added mass along the
/// wire.
///
/// Drag is density/2 C_D D l/2 |P w| P w, and density/2 C_Dt pi D l/2 |t . w| (t . w) t along the skin.
///
/// The ledger counts v^T m P v / 2 as kinetic energy, and buoyancy as a power.
struct ImmersedSpan {
  static constexpr const char* kind = "immersed span";
  static constexpr const char* drawn = "";  // what it acts on is
  static constexpr bool from_outside = true;
  using Description = ImmersedSpanDescription;

  Description d;
  Span span;
  // Of one half, for each metre of the span:
  double displaced = 0.0, added = 0.0;  // mass of water, kg; and added mass across
  double weight = 0.0;                  // of that water, N
  double across = 0.0, along = 0.0;     // drag, N s2/m2
  std::array<int, 2> stencils = {-1, -1};
  PaidOut paid_out;

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names); }

  static Description example() {
    auto d = example_span<Description>({0.2, -0.3, 0.4});
    d.density = 0.1;
    d.diameter = 1.3;
    d.length = Curve::quintic(-1.0, 2.0, 8.0, 11.0);
    d.added_mass_coefficient = 0.8;
    d.drag_coefficient = 1.2;
    d.drag_coefficient_along = 0.3;
    return d;
  }

  template <class Context>
  static ImmersedSpan compile(const Description& d, Context& context) {
    using std::numbers::pi;
    ImmersedSpan out;
    out.d = d;
    out.span = Span::compile(d, context);
    out.displaced = d.density * pi / 8.0 * d.diameter * d.diameter;
    out.added = d.added_mass_coefficient * out.displaced;
    out.weight = context.gravity() * out.displaced;
    out.across = 0.25 * d.density * d.drag_coefficient * d.diameter;
    out.along = 0.25 * d.density * d.drag_coefficient_along * pi * d.diameter;
    out.stencils = {context.stencil(at_end(d.first, d.first_point)),
                    context.stencil(at_end(d.second, d.second_point))};
    out.paid_out = PaidOut::compile(d.length, d.paid_out_by, d.share, Check(kind, d.name), context);
    return out;
  }

  /// Those of the length are the line's own, to which they do far more.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return span.bodies(); }
  StateRange followed() const { return paid_out.followed(); }

  template <class T>
  void add_inertia(const LoadInput<T>& in, Mat6<T>* mass) const {
    const Place<T> at = place<false>(in);
    const Mat3<T> across_span = Mat3<T>::Identity() - at.direction * at.direction.transpose();
    for (const End<T>& end : at.ends) {
      if (!(end.wet > T(0))) continue;
      const Mat3<T> own = across_span * (T(added) * end.wet);
      if (end.at_state) {
        mass[end.body].template topLeftCorner<3, 3>() += own;
      } else {
        add_mass_at<T>(end.lever, own, mass[end.body]);
      }
    }
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Place<T> at = place<true>(in);
    if (!(at.ends[0].wet > T(0)) && !(at.ends[1].wet > T(0))) return;
    const Vec3<T> couple = this->couple(at);
    for (const End<T>& end : at.ends) {
      Vec3<T> force = end.second ? couple : Vec3<T>(-couple);
      force += flow_force(end) + drag(at, end);
      const T stored = add_momentum(at, end, force);
      if (end.at_state) {
        out.wrench[end.body].force += force;
      } else {
        out.wrench[end.body].add(force, end.lever);
      }
      out.add_power(force.dot(end.own) + stored);
    }
  }

  /// Its powers by cause: buoyancy is one here, and added mass is that of a span that grows.
  WaterByCause by_cause(const LoadInput<double>& in) const {
    using Cause = WaterCause;
    const Place<double> at = place<true>(in);
    WaterByCause out;
    if (!(at.ends[0].wet > 0.0) && !(at.ends[1].wet > 0.0)) return out;
    const Vec3d couple = this->couple(at);
    double all = 0.0;
    for (const End<double>& end : at.ends) {
      const Vec3d braked = drag(at, end);
      Vec3d force = flow_force(end) + braked + (end.second ? couple : Vec3d(-couple));
      const double stored = add_momentum(at, end, force);
      all += force.dot(end.own) + stored;
      const double square = end.side.squaredNorm();
      out.power(Cause::buoyancy) += weight * end.wet * end.own.z();
      out.power(Cause::drag) += braked.dot(end.own);
      out.power(Cause::slam) -= 0.5 * added * std::abs(end.dips) * square;
      out.power(Cause::added_mass) -= 0.5 * added * end.grows * square;
    }
    double told = 0.0;
    for (const double power : out.powers) told += power;
    out.power(Cause::waves) = all - told;
    return out;
  }

 private:
  /// One end with its half of the span, inertial axes.
  template <class T>
  struct End {
    int body = 0;
    bool second = false;
    bool at_state = false;  // without a lever, as at every node of a line with mass
    Vec3<T> lever, point;   // from the state point, and its place
    Vec3<T> own, swept;     // its velocity; its acceleration by turning of the body
    Vec3<T> velocity;       // over the water
    Vec3<T> side;           // and across the span
    T slide{0};             // and along it
    Vec3<T> water;          // acceleration of that, Du/Dt
    // m of the span below the surface, if both halves were as this one; and how fast that grows as it dips
    // in, and as the span itself does.
    T wet{0}, dips{0}, grows{0};
  };
  template <class T>
  struct Place {
    T length{0};
    Vec3<T> direction = Vec3<T>::Zero(), turning = Vec3<T>::Zero();  // t and its rate
    std::array<End<T>, 2> ends;

    Vec3<T> across(const Vec3<T>& x) const { return x - direction * direction.dot(x); }
    /// P' w.
    Vec3<T> across_rate(const End<T>& end) const {
      return -(turning * end.slide + direction * turning.dot(end.velocity));
    }
  };

  /// One for all spans that meet at a point: its flow is asked for once.
  static FlowStencil at_end(const std::string& body, const Vec3d& point) {
    std::string name = "immersed span at point (";
    for (int i = 0; i < 3; ++i) name += to_text(point[i]) + (i < 2 ? ", " : ")");
    return {.name = name + " of '" + body + "'", .surface = false, .reach = 0.0};
  }

  /// Of its added mass, which `moves` not, only what is below the surface.
  template <bool moves, class T>
  Place<T> place(const LoadInput<T>& in) const {
    using std::sqrt;
    Place<T> out;
    set_end(in, span.first, span.first_point, out.ends[0]);
    set_end(in, span.second, span.second_point, out.ends[1]);
    out.ends[1].second = true;
    const Vec3<T> apart = out.ends[1].point - out.ends[0].point;
    const T square = apart.dot(apart);
    if (!(square > T(0))) return out;  // no water on a wire without a direction
    out.length = sqrt(square);
    out.direction = apart / out.length;
    const Vec3<T> rate = out.ends[1].own - out.ends[0].own;
    if constexpr (moves) out.turning = out.across(rate) / out.length;
    const PaidOut::Length<T> wire = paid_out.length(in);
    const T half = T(0.5) * apart.z(), half_rate = T(0.5) * rate.z();
    dip<moves>(in, stencils[0], half, half_rate, wire, out.ends[0]);
    dip<moves>(in, stencils[1], T(-half), T(-half_rate), wire, out.ends[1]);
    for (End<T>& end : out.ends) {
      if constexpr (!moves) break;
      end.slide = out.direction.dot(end.velocity);
      end.side = end.velocity - out.direction * end.slide;
    }
    return out;
  }

  template <class T>
  static void set_end(const LoadInput<T>& in, int body, const Vec3d& point, End<T>& out) {
    const auto& k = in.bodies[body];
    out.body = body;
    out.at_state = point.isZero(0.0);
    out.lever = out.swept = out.water = Vec3<T>::Zero();
    out.point = k.position;
    out.own = k.velocity;
    if (!out.at_state) {
      out.lever = k.rotation * point.template cast<T>();
      const Vec3<T> around = cross<T>(k.angular_velocity, out.lever);
      out.point += out.lever;
      out.own += around;
      out.swept = cross<T>(k.angular_velocity, around);
    }
    out.velocity = out.own;
  }

  /// The sea at an end whose half of the span rises by `height`.
  template <bool moves, class T>
  void dip(const LoadInput<T>& in, int stencil, const T& height, const T& height_rate,
           const PaidOut::Length<T>& wire, End<T>& end) const {
    const T middle = end.point.z() + T(0.5) * height;
    const T reach = T(0.5) * (select(height < T(0), T(-height), height) + T(d.diameter));
    const T crest(in.sea->crest(stencil));
    if (!(middle - reach < crest)) return;
    const bool under = middle + reach < -crest;  // all troughs
    end.wet = wire.value;
    end.grows = wire.rate;
    if (under && !moves) return;
    const LocalFlow<T> flow = in.sea->template at_point<T>(stencil, in.time, end.point);
    end.velocity = end.own - flow.velocity;
    end.water = flow.acceleration;
    if (!under) emerge<moves>(flow, middle, height, height_rate, end);
  }

  /// Leaves an end its share below the surface. That is smooth up to the second derivative: it dips in over
  /// its height, and no less than the diameter.
  template <bool moves, class T>
  void emerge(const LocalFlow<T>& flow, const T& middle, const T& height, const T& height_rate,
              End<T>& end) const {
    using std::sqrt;
    const T over = sqrt(height * height + T(d.diameter * d.diameter));
    const T depth = flow.elevation - middle;
    const T part = clamped(T(T(0.5) + depth / over), T(0), T(1)), dry = T(1) - part;
    const T share = part * part * part * (T(10) + part * (T(6) * part - T(15)));
    const T length = end.wet;
    end.wet *= share;
    end.grows *= share;
    if (!moves || !(part < T(1))) return;
    const T rise = flow.elevation_rate + flow.slope[0] * end.own.x() + flow.slope[1] * end.own.y();
    const T sinks = rise - end.own.z() - T(0.5) * height_rate;
    const T part_rate = (sinks - depth * height * height_rate / (over * over)) / over;
    end.dips = T(30) * part * part * dry * dry * part_rate * length;
  }

  /// Buoyancy, and the force of the undisturbed flow.
  template <class T>
  Vec3<T> flow_force(const End<T>& end) const {
    Vec3<T> out = end.water * (T(displaced) * end.wet);
    out.z() += T(weight) * end.wet;
    return out;
  }

  template <class T>
  Vec3<T> drag(const Place<T>& at, const End<T>& end) const {
    using std::sqrt;
    const T speed = select(end.slide < T(0), T(-end.slide), end.slide);
    Vec3<T> out = at.direction * (T(-along) * end.wet * end.slide * speed);
    const T square = end.side.dot(end.side);
    if (square > T(0)) out -= end.side * (T(across) * end.wet * sqrt(square));  // else it has no direction
    return out;
  }

  /// On the second end; its opposite is on the first.
  template <class T>
  Vec3<T> couple(const Place<T>& at) const {
    Vec3<T> out = Vec3<T>::Zero();
    for (const End<T>& end : at.ends) {
      if (!(end.wet > T(0))) continue;
      out -= end.side * (T(added) * end.wet * end.slide / at.length);
    }
    return out;
  }

  /// What the added mass of an end does beside -m P a and the couple. Returns what the ledger's energy of it
  /// gains beside that of m P a.
  template <class T>
  T add_momentum(const Place<T>& at, const End<T>& end, Vec3<T>& force) const {
    const T mass = T(added) * end.wet, gain = T(added) * end.dips, grown = T(added) * end.grows;
    const Vec3<T> swing = end.swept - end.water, own = at.across(end.own);
    force -= (at.across(swing) + at.across_rate(end)) * mass;
    force -= end.side * (grown + select(gain > T(0), gain, T(0)));
    const T turned = own.dot(end.swept) - at.direction.dot(end.own) * at.turning.dot(end.own);
    return mass * turned + T(0.5) * (gain + grown) * own.dot(own);
  }
};

}  // namespace seacrane
