#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "seacrane/elements/loads/immersed_attitude.hpp"
#include "seacrane/elements/loads/immersed_part_description.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/elements/loads/water_by_cause.hpp"
#include "seacrane/elements/loads/wet_volume.hpp"
#include "seacrane/math/lever_masses.hpp"
#include "seacrane/math/monotone_spline.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

/// Water on a part of a body with frame at its centre P, its lowest point at a depth h below the surface at
/// P. With u the undisturbed flow, its mean over the part, v the velocity of P over it, A(h) the added mass
/// along the part's axes, V the volume that is wet,
///
///   F = rho V (Du/Dt + g e_z) - A (a - Du/Dt) - s A' h' v - (d/dt of A by turning) v - drag,
///   M = -v x (A v) and the moment of buoyancy,   s = 1 on entry (h' > 0), 0 on exit.
///
/// The added mass of a cylinder is the mean over its length of that of its circles, and each of them meets
/// the surface in its own plane: at a depth of its centre of s the surface is s / cos(inclination) away. So a
/// cylinder that lies has A(h) of a circle, an upright one as much as of its length is wet (Morison), and
/// each between has what its strips have, however many. The end of a cylinder, a disc, likewise: see
/// ImmersedAttitude.
///
/// Momentum A v is brought in on entry; half of |A' h'| v^2 goes with the jet, and as much remains in the
/// water on exit. The moment is Munk's (Kirchhoff's equations; H. Lamb, Hydrodynamics, art. 124).
///
/// The energies of the ledger are those of still water: v_b^T A v_b / 2 with the body's own velocity v_b, and
/// that of buoyancy at the depth; the power of the sea is what changes them.
struct ImmersedPart {
  static constexpr const char* kind = "immersed part";
  using Description = ImmersedPartDescription;
  using Shape = Description::Shape;

  Description d;
  Shape shape = Shape::box;
  int body = 0;
  Vec3d point;              // from the state point, body axes
  Vec3d arm;                // the same in its own axes
  Vec3d first_point, step;  // of its row
  Mat3d axes;
  double whole = 0.0, volume = 0.0;  // m3; and of it, what keeps water out; whole is 1 of a table of none
  double weight = 0.0;               // of the water that it keeps out, N
  double edge = 0.0;                 // m, by which edges are round: no attitude is singular
  MonotoneSpline<3> added;
  MonotoneSpline<1> wet_volume;  // of a table
  int place_in_row = 0;
  StateRange states;             // what slam has taken, J
  Mat3d widths = Mat3d::Zero();  // columns: over which the flow is averaged, its axes
  int stencil = -1;              // its point in the sea

  static void check(const Description& d, const Check& c, SceneNames& names) { d.check(c, names); }
  static Description example() { return Description::example(); }

  template <class Context>
  static ImmersedPart compile(const Description& d, Context& context) {
    const Attachment on = context.attach(d.body, d.point);
    ImmersedPart out;
    out.d = d;
    out.shape = d.form();
    out.body = on.body;
    out.point = on.point;
    out.first_point = snapped(context.attach(d.body, d.point - d.place * d.step).point);
    out.step = on.axes * d.step;
    out.place_in_row = static_cast<int>(d.place);
    out.axes = on.axes * d.axes;
    out.arm = out.axes.transpose() * out.point;
    out.whole = d.volume();
    out.volume = d.fill * d.volume();
    out.weight = d.density * context.gravity() * out.volume;
    out.edge = (out.shape == Shape::box ? kRoundedShare : 0.1 * kRoundedShare) * 0.5 * d.size.maxCoeff();
    out.added = MonotoneSpline<3>(d.depths, d.added_masses);
    if (d.is("table")) out.wet_volume = MonotoneSpline<1>(d.depths, d.volume_rows());
    if (d.is("table") && out.whole == 0.0) {  // it is wet, and braked, by its height
      using One = Eigen::Matrix<double, 1, 1>;
      out.wet_volume = MonotoneSpline<1>({0.0, d.size[2]}, {One(0.0), One(1.0)});
      out.whole = 1.0;
    }
    const double largest = d.added_masses.back().maxCoeff();
    const double scale = (largest > 0.0 ? largest : 1.0) * context.length_scale();  // at 1 m/s
    const Vec3d size = d.widths();
    out.widths = size.asDiagonal();
    out.stencil = context.stencil({.name = "immersed part '" + (d.row.empty() ? d.name : d.row) + "'",
                                   .count = static_cast<std::size_t>(d.count),
                                   .waves = d.wave_factor,
                                   .reach = 0.5 * ((d.count - 1.0) * d.step.norm() + size.norm()),
                                   .width = size.maxCoeff()});
    out.states = {context.state({d.name + ".slam_loss", "J", 0.0, scale}), 1};
    return out;
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 1> bodies() const { return {body}; }

  /// What strips of a row have in common, and what they add up to about the state point, axes of the part.
  template <class T>
  struct Shared {
    ImmersedAttitude<T> lie;
    Vec3<T> velocity, turning;  // of the body at its state point
    Vec3<T> swirl;              // turning x velocity
    FlowPlace<T> first;         // of the row, and what comes from strip to strip
    Vec3<T> step;
    std::span<const LocalFlow<double>> row;  // of a double, where a wave reaches it
    LeverMasses<T> mass;
    Vec3<T> force = Vec3<T>::Zero(), moment = Vec3<T>::Zero();
    T lift = T(0);                         // upwards
    Vec3<T> lifted = Vec3<T>::Zero();      // and its first moments
    Vec3<T> over_width = Vec3<T>::Zero();  // slopes of the energy of buoyancy in the half widths

    explicit Shared(const ImmersedAttitude<T>& lie) : lie(lie) {}
  };

  bool shares(const ImmersedPart& other) const {
    return stencil == other.stencil && body == other.body && shape == other.shape && d.size == other.d.size &&
           axes == other.axes && step == other.step;
  }

  template <class T>
  Shared<T> shared(const LoadInput<T>& in) const {
    using std::sqrt;
    const auto& k = in.bodies[body];
    const Mat3<T> own = times<T>(k.rotation, axes);
    Shared<T> out(ImmersedAttitude<T>(shape, d.size, edge, own, k.angular_velocity));
    out.velocity = times_transposed<T>(own, k.velocity);
    out.turning = times_transposed<T>(own, k.angular_velocity);
    out.swirl = cross<T>(out.turning, out.velocity);
    out.first = {k.position + times<T>(k.rotation, first_point), times<T>(own, widths), k.angular_velocity,
                 T(0)};
    out.first.height =
        sqrt(out.first.extents.row(2).squaredNorm() + T(edge * edge));  // plates have slopes too
    out.step = times<T>(k.rotation, step);
    if constexpr (std::is_same_v<T, double>) {
      const double last = out.first.position.z() + (d.count - 1.0) * out.step.z();
      if (std::min(out.first.position.z(), last) - out.lie.below < in.sea->crest(stencil))
        out.row = in.sea->row(stencil, in.time, out.first, out.step);
    }
    return out;
  }

  template <class T>
  void add_inertia(const LoadInput<T>& in, Shared<T>& as) const {
    T center = -height(in, as);
    meet(in, as, [&](const LocalFlow<T>& flow) { center += flow.elevation; });
    if (moves_water(as, center)) as.mass.add(arm, added_at(as, center).mass);
  }
  template <class T>
  void put(const Shared<T>& as, Mat6<T>* mass) const {
    as.mass.add_to(as.lie.axes, mass[body]);
  }
  template <class T>
  void add_inertia(const LoadInput<T>& in, Mat6<T>* mass) const {
    Shared<T> as = shared(in);
    add_inertia(in, as);
    put(as, mass);
  }

  template <class T>
  void apply(const LoadInput<T>& in, Shared<T>& as, LoadSum<T>& out) const {
    const Place<T> at = place(in, as);
    T& slam = out.state_rates[states.first];
    slam = T(0);
    const WetShare<T> wet = wet_share(as, at);
    Vec3<T> force = Vec3<T>::Zero();  // at its centre
    if (wet.share > T(0)) {
      const T up = T(weight) * wet.share;
      const Vec3<T> pushed = at.pulled * (T(d.density * volume) * wet.share);  // the pressure of the flow
      const Vec3<T> braked = drag(at, wet);
      as.lift += up;
      as.lifted += up * arm.cast<T>();
      as.over_width += wet.over_width * T(weight);
      force = pushed + braked;
      out.add_power(up * at.rise + dot<T>(pushed, at.own));
      out.add_power(dot<T>(braked, at.own));
    }
    if (moves_water(as, at.center)) {
      const Carried<T> water = carried(as, at);
      force += water.force;
      as.moment += water.moment;
      out.add_power(water.power);
      slam = water.loss;
    }
    as.force += force;
    as.moment += moment_of(force);
  }
  /// Buoyancy is the gradient of its energy: it also turns.
  template <class T>
  void put(const Shared<T>& as, LoadSum<T>& out) const {
    const ImmersedAttitude<T>& lie = as.lie;
    BodyLoad<T>& to = out.wrench[body];
    const Vec3<T> lever = times<T>(lie.axes, as.lifted);
    Vec3<T> moment(lever.y(), -lever.x(), T(0));
    const auto turn = [&](int i, const T& over_cosine) {  // times axis x e_z
      moment[0] -= over_cosine * lie.axes(1, i);
      moment[1] += over_cosine * lie.axes(0, i);
    };
    const auto slope = [&](int i, int axis) -> T {
      const double width = 0.5 * d.size[i];
      return as.over_width[i] * T(width * width) * lie.axes(2, axis) / lie.half[i];
    };
    if (shape == Shape::box) {
      for (int i = 0; i < 3; ++i) turn(i, slope(i, i));
    } else if (shape == Shape::cylinder) {
      turn(0, slope(0, 0) - slope(1, 0));
    }
    to.force += times<T>(lie.axes, as.force);
    to.force[2] += as.lift;
    to.moment += times<T>(lie.axes, as.moment) + moment;
  }
  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    Shared<T> as = shared(in);
    apply(in, as, out);
    put(as, out);
  }

  /// By cause, with an acceleration of its body (state point, inertial axes).
  WaterByCause by_cause(const LoadInput<double>& in, const Vec6d& acceleration) const {
    using Cause = WaterCause;
    const Shared<double> as = shared(in);
    const Place<double> at = place(in, as);
    const WetShare<double> wet = wet_share(as, at);
    const Mat3d& axes = as.lie.axes;
    WaterByCause out;
    const auto add = [&](Cause cause, const Vec3d& along) {
      out.force(cause) += axes * along;
      return along.dot(at.own);
    };
    if (wet.share > 0.0) {
      out.force(Cause::buoyancy).z() = weight * wet.share;
      out.power(Cause::waves) =
          weight * wet.share * at.rise + add(Cause::waves, at.pulled * (d.density * volume * wet.share));
      out.power(Cause::drag) = add(Cause::drag, drag(at, wet));
    }
    if (!moves_water(as, at.center)) return out;
    const Added<double> here = added_at(as, at.center, at.rate);
    const Carried<double> water = carried(as, at);
    const Vec3d driven = here.mass.cwiseProduct(at.pulled);
    const Vec3d slam = -here.gain.cwiseMax(0.0).cwiseProduct(at.velocity);
    const Vec3d turning = axes.transpose() * acceleration.tail<3>();
    const Vec3d accelerated = axes.transpose() * acceleration.head<3>() + turning.cross(arm);
    const Vec3d opposed = here.mass.cwiseProduct(accelerated);
    add(Cause::waves, driven);
    add(Cause::slam, slam);
    add(Cause::added_mass, water.force - slam - driven - opposed);
    out.power(Cause::slam) = -water.loss;
    out.power(Cause::waves) += water.power + water.loss;
    out.momentum = axes * here.mass.cwiseProduct(at.velocity);
    out.shed = -(axes * here.gain.cwiseMin(0.0).cwiseProduct(at.velocity));
    return out;
  }

  double potential(const LoadInput<double>& in) const {
    const Shared<double> as = shared(in);
    const Place<double> at = place(in, as);
    if (shape != Shape::table) return weight * wet_share(as, at).integral;
    return at.depth > 0.0 ? weight / whole * wet_volume.integral(at.depth)[0] : 0.0;
  }

  std::vector<std::string> reached(const Side& from, const Side& to) const {
    return bounds_met(d.name, std::array<Margin, 2>{{{"touch"}, {"awash"}}}, from, to);
  }
  Margins margins(const LoadInput<double>& in) const {
    const Shared<double> as = shared(in);
    const Place<double> at = place(in, as);
    return Margins(std::array<Margin, 2>{{{"touch", -at.depth}, {"awash", as.lie.below - at.center}}});
  }
  /// A part above all crests has these to come down to; others see the water where they are.
  Sight look(const LoadInput<double>& in) const {
    constexpr std::size_t touch = 0, awash = 1;  // as margins() has them
    const Margins margins = this->margins(in);
    const auto& k = in.bodies[body];
    Sight out{.side = margins.side(), .watched = side_of({touch, awash})};
    out.clear = margins.across(out.side, out.side ^ out.watched);
    out.at[0] = out.side[touch] ? -out.clear : out.clear;
    const double crest = in.sea->crest(stencil);
    if (!out.side[touch] && out.clear > crest) out.clear -= crest;
    out.pace = velocity_of(k, point).norm() + k.angular_velocity.norm() * d.size.norm();
    return out;
  }

 private:
  /// Where a part is.
  template <class T>
  struct Place {
    Vec3<T> own;                       // velocity of its centre, its axes
    Vec3<T> velocity;                  // and over the water
    Vec3<T> pulled = Vec3<T>::Zero();  // acceleration of the water, its axes
    T rise = T(0);                     // how fast the surface above its centre rises
    T center, depth, rate;  // depths of its centre, of its lowest point, and how fast that one sinks
  };

  /// Along its axes, and its rate.
  template <class T>
  struct Added {
    Vec3<T> mass, gain;
  };

  /// What the added mass does to a part beside -A a.
  template <class T>
  struct Carried {
    Vec3<T> force, moment;        // about its centre, its axes
    T loss = T(0), power = T(0);  // by slam, and into the energy of the ledger
  };

  bool round() const { return shape == Shape::cylinder || shape == Shape::disc; }

  /// Its moment about the state point, at the centre, axes of the part.
  template <class T>
  Vec3<T> moment_of(const Vec3<T>& force) const {
    const double x = arm.x(), y = arm.y(), z = arm.z();
    return {y * force.z() - z * force.y(), z * force.x() - x * force.z(), x * force.y() - y * force.x()};
  }

  /// Of its centre over the still water.
  template <class T>
  T height(const LoadInput<T>& in, const Shared<T>& as) const {
    const Mat3<T>& axes = as.lie.axes;
    return in.bodies[body].position.z() +
           (arm.x() * axes(2, 0) + arm.y() * axes(2, 1) + arm.z() * axes(2, 2));
  }

  /// f(flow), unless it is above all crests.
  template <class T, class F>
  void meet(const LoadInput<T>& in, const Shared<T>& as, F&& f) const {
    if constexpr (std::is_same_v<T, double>) {
      if (!as.row.empty()) f(as.row[idx(place_in_row)]);
    } else if (in.sea->field() && height(in, as) - as.lie.below < T(in.sea->crest(stencil))) {
      f(in.sea->template in_row<T>(stencil, place_in_row, in.time, as.first, as.step));
    }
  }

  /// Whether it has added mass at a depth of its centre.
  template <class T>
  bool moves_water(const Shared<T>& as, const T& center) const {
    const ImmersedAttitude<T>& lie = as.lie;
    return center + (round() ? lie.shift + lie.along + lie.across : lie.below) > T(0);
  }

  template <class T>
  Added<T> added_at(const Shared<T>& as, const T& at_center, const T& rate = T(0)) const {
    const ImmersedAttitude<T>& lie = as.lie;
    if (!round()) {
      const auto here = added.at(T(at_center + lie.below));
      return {here.value, here.slope * rate};
    }
    const T center = at_center + lie.shift, radius = T(0.5 * d.size[1]), scale = radius / lie.across;
    const auto here =
        added.over(T(radius + (center - lie.along) * scale), T(radius + (center + lie.along) * scale));
    const T sinks = rate - lie.reaches + lie.shift_rate, widens = lie.across_rate / lie.across;
    const T by_chord = scale * (sinks - center * widens);
    const T by_bend = T(2) * scale * (lie.along_rate - lie.along * widens);
    return {here.mean, by_chord * here.chord + by_bend * here.bend};
  }

  template <class T>
  Place<T> place(const LoadInput<T>& in, const Shared<T>& as) const {
    const ImmersedAttitude<T>& lie = as.lie;
    Place<T> at;
    at.own = as.velocity - moment_of(as.turning);
    at.velocity = at.own;
    at.center = -height(in, as);
    const Vec3<T> own = times<T>(lie.axes, at.own);
    meet(in, as, [&](const LocalFlow<T>& flow) {
      at.velocity -= times_transposed<T>(lie.axes, flow.velocity);
      at.pulled = times_transposed<T>(lie.axes, flow.acceleration);
      at.rise = flow.elevation_rate + flow.slope[0] * own.x() + flow.slope[1] * own.y();
      at.center += flow.elevation;
    });
    at.depth = at.center + lie.below;
    at.rate = lie.reaches - own.z() + at.rise;
    return at;
  }

  template <class T>
  WetShare<T> wet_share(const Shared<T>& as, const Place<T>& at) const {
    switch (shape) {
      case Shape::box:
        return wet_box<T>(at.center, as.lie.half);
      case Shape::cylinder:
      case Shape::disc:
        return wet_cylinder<T>(at.center, as.lie.half);
      case Shape::sphere:
        return wet_sphere<T>(at.center, 0.5 * d.size[0]);
      case Shape::table:
        break;
    }
    WetShare<T> out;
    if (at.depth > T(0)) out.share = wet_volume.at(at.depth).value[0] / T(whole);
    return out;
  }

  /// Drag of the part that is wet: of a cylinder across and along by themselves, of a sphere by its speed.
  template <class T>
  Vec3<T> drag(const Place<T>& at, const WetShare<T>& wet) const {
    using std::sqrt;
    const Vec3<T>& v = at.velocity;
    Vec3<T> along = Vec3<T>::Zero();
    const auto brake = [&](int i, const T& speed) { along[i] = T(-d.drag[i]) * (speed * wet.share) * v[i]; };
    const auto brake_alone = [&](int i) { brake(i, v[i] > T(0) ? v[i] : -v[i]); };
    const auto brake_from = [&](int first) {  // by their common speed
      T square = T(0);
      for (int i = first; i < 3; ++i) square += v[i] * v[i];
      if (!(square > T(0))) return;
      const T speed = sqrt(square);
      for (int i = first; i < 3; ++i) brake(i, speed);
    };
    if (shape == Shape::sphere) {
      brake_from(0);
    } else if (shape == Shape::cylinder) {
      brake_alone(0);
      brake_from(1);
    } else {
      for (int i = 0; i < 3; ++i) brake_alone(i);
    }
    return along;
  }

  template <class T>
  Carried<T> carried(const Shared<T>& as, const Place<T>& at) const {
    Carried<T> out;
    const Added<T> here = added_at(as, at.center, at.rate);
    const Vec3<T>&v = at.velocity, &own = at.own, &turning = as.turning;
    const Vec3<T> momentum = here.mass.cwiseProduct(v);
    const Vec3<T> passed = cross<T>(turning, own - v);  // the motion of the water, turned
    Vec3<T> along = here.mass.cwiseProduct(passed - as.swirl - at.pulled);
    out.power = dot<T>(passed, momentum);
    for (int i = 0; i < 3; ++i) {
      const T& gain = here.gain[i];
      const bool enters = gain > T(0);
      if (enters) along[i] += gain * v[i];
      const T power = T(0.5) * gain * v[i] * v[i];
      out.loss += enters ? power : T(-power);
      // The ledger's energy of A gains own (gain own / 2 - A swirl) beside that of A a.
      out.power += own[i] * (T(0.5) * gain * own[i] - here.mass[i] * as.swirl[i] - along[i]);
    }
    out.force = -(along + cross<T>(turning, momentum));
    out.moment = -cross<T>(v, momentum);
    return out;
  }

  /// Rounded, so that strips of a row agree on its first point to the last bit: the sea is then summed once.
  static Vec3d snapped(const Vec3d& point) {
    constexpr double grid = 0x1p-36;  // 1.5e-11 m
    return (point / grid).array().round() * grid;
  }
};

}  // namespace seacrane
