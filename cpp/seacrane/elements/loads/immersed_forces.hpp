#pragma once

#include <cmath>

#include "seacrane/elements/loads/immersed_attitude.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/wet_volume.hpp"
#include "seacrane/math/lever_masses.hpp"
#include "seacrane/math/monotone_spline.hpp"
#include "seacrane/sea/sea_field.hpp"

namespace seacrane {

/// What parts of a row have in common, and what they add up to about the state point, axes of the part.
template <class T>
struct ImmersedRow {
  ImmersedAttitude<T> lie;
  T height;                   // of the state point over the still water
  Vec3<T> velocity, turning;  // of the body at its state point
  Vec3<T> swirl;              // turning x velocity
  LeverMasses<T> mass;
  Vec3<T> force = Vec3<T>::Zero(), moment = Vec3<T>::Zero();
  T lift = T(0);                         // upwards
  Vec3<T> lifted = Vec3<T>::Zero();      // and its first moments
  Vec3<T> over_width = Vec3<T>::Zero();  // slopes of the energy of buoyancy in the half widths

  ImmersedRow(const ImmersedAttitude<T>& lie, const BodyKinematics<T>& k)
      : lie(lie),
        height(k.position.z()),
        velocity(times_transposed<T>(lie.axes, k.velocity)),
        turning(times_transposed<T>(lie.axes, k.angular_velocity)),
        swirl(cross<T>(turning, velocity)) {}
  /// For parts side by side, to which it is one.
  template <class S>
  explicit ImmersedRow(const ImmersedRow<S>& one)
      : lie(one.lie),
        height(one.height),
        velocity(one.velocity.template cast<T>()),
        turning(one.turning.template cast<T>()),
        swirl(one.swirl.template cast<T>()) {}

  /// What parts side by side have added.
  template <class P>
  void add_lanes(const ImmersedRow<P>& other) {
    mass.add_lanes(other.mass);
    for (int i = 0; i < 3; ++i) {
      force[i] += total(other.force[i]);
      moment[i] += total(other.moment[i]);
      lifted[i] += total(other.lifted[i]);
      over_width[i] += total(other.over_width[i]);
    }
    lift += total(other.lift);
  }
};

/// Water on a part: see ImmersedPart. T is a number, or a pack of parts that are alike but for their arms,
/// whose numbers are R: no branch is that of one of them.
struct ImmersedForces {
  using Shape = ImmersedPartDescription::Shape;

  Shape shape = Shape::box;
  Vec3d size, drag_factors;  // rho/2 C_D S
  double whole = 0.0;        // volume, m3; 1 of a table of none
  double displaced = 0.0;    // kg of water, of what keeps water out
  double weight = 0.0;       // of that, N
  MonotoneSpline<3> added;
  MonotoneSpline<1> wet_volume;  // of a table

  bool alike(const ImmersedForces& other) const {
    return shape == other.shape && size == other.size && drag_factors == other.drag_factors &&
           whole == other.whole && displaced == other.displaced && weight == other.weight &&
           added == other.added && wet_volume == other.wet_volume;
  }

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

  template <class T, class R>
  void add_inertia(const Vec3<R>& arm, const LocalFlow<T>* flow, ImmersedRow<T>& to) const {
    T center = -height(to, arm);
    if (flow) center += flow->elevation;
    const auto moves = moves_water(to, center);
    if (!any(moves)) return;
    Vec3<T> mass = added_at(to, center).mass;
    for (int i = 0; i < 3; ++i) mass[i] = select(moves, mass[i], T(0));
    to.mass.add(arm, mass);
  }

  /// Returns what slam takes.
  template <class T, class R>
  T apply(const Vec3<R>& arm, const LocalFlow<T>* flow, ImmersedRow<T>& to, LoadSum<T>& out) const {
    const Place<T> at = place(to, arm, flow);
    const WetShare<T> wet = wet_share(to, at);
    Vec3<T> force = Vec3<T>::Zero();  // at its centre
    if (any(wet.share > T(0))) {
      const T up = T(weight) * wet.share;
      const Vec3<T> pushed = at.pulled * (T(displaced) * wet.share);  // the pressure of the flow
      const Vec3<T> braked = drag(at, wet);
      to.lift += up;
      for (int i = 0; i < 3; ++i) to.lifted[i] += up * arm[i];
      to.over_width += wet.over_width * T(weight);
      force = pushed + braked;
      out.add_power(up * at.rise + dot<T>(pushed, at.own));
      out.add_power(dot<T>(braked, at.own));
    }
    T slam(0);
    const auto moves = moves_water(to, at.center);
    if (any(moves)) {
      const Carried<T> water = carried(to, at);
      for (int i = 0; i < 3; ++i) {
        force[i] += select(moves, water.force[i], T(0));
        to.moment[i] += select(moves, water.moment[i], T(0));
      }
      out.add_power(select(moves, water.power, T(0)));
      slam = select(moves, water.loss, T(0));
    }
    to.force += force;
    to.moment += moment_of(arm, force);
    return slam;
  }

  /// Of the centre over the still water.
  template <class T, class R>
  static T height(const ImmersedRow<T>& as, const Vec3<R>& arm) {
    const Mat3<T>& axes = as.lie.axes;
    return as.height + (arm.x() * axes(2, 0) + arm.y() * axes(2, 1) + arm.z() * axes(2, 2));
  }

  /// Whether a part has added mass at a depth of its centre.
  template <class T>
  auto moves_water(const ImmersedRow<T>& as, const T& center) const {
    const ImmersedAttitude<T>& lie = as.lie;
    return center + (round() ? T(lie.shift + lie.along + lie.across) : lie.below) > T(0);
  }

  template <class T>
  Added<T> added_at(const ImmersedRow<T>& as, const T& at_center, const T& rate = T(0)) const {
    const ImmersedAttitude<T>& lie = as.lie;
    if (!round()) {
      const auto here = added.at(T(at_center + lie.below));
      return {here.value, here.slope * rate};
    }
    const T center = at_center + lie.shift, radius = T(0.5 * size[1]), scale = radius / lie.across;
    const auto here =
        added.over(T(radius + (center - lie.along) * scale), T(radius + (center + lie.along) * scale));
    const T sinks = rate - lie.reaches + lie.shift_rate, widens = lie.across_rate / lie.across;
    const T by_chord = scale * (sinks - center * widens);
    const T by_bend = T(2) * scale * (lie.along_rate - lie.along * widens);
    return {here.mean, by_chord * here.chord + by_bend * here.bend};
  }

  template <class T, class R>
  Place<T> place(const ImmersedRow<T>& as, const Vec3<R>& arm, const LocalFlow<T>* flow) const {
    const ImmersedAttitude<T>& lie = as.lie;
    Place<T> at;
    at.own = as.velocity - moment_of(arm, as.turning);
    at.velocity = at.own;
    at.center = -height(as, arm);
    const Vec3<T> own = times<T>(lie.axes, at.own);
    if (flow) {
      at.velocity -= times_transposed<T>(lie.axes, flow->velocity);
      at.pulled = times_transposed<T>(lie.axes, flow->acceleration);
      at.rise = flow->elevation_rate + flow->slope[0] * own.x() + flow->slope[1] * own.y();
      at.center += flow->elevation;
    }
    at.depth = at.center + lie.below;
    at.rate = lie.reaches - own.z() + at.rise;
    return at;
  }

  template <class T>
  WetShare<T> wet_share(const ImmersedRow<T>& as, const Place<T>& at) const {
    switch (shape) {
      case Shape::box:
        return wet_box(at.center, as.lie.half);
      case Shape::cylinder:
      case Shape::disc:
        return wet_cylinder(at.center, as.lie.half);
      case Shape::sphere:
        return wet_sphere(at.center, 0.5 * size[0]);
      case Shape::table:
        break;
    }
    WetShare<T> out;
    const auto wet = at.depth > T(0);
    if (any(wet)) out.share = select(wet, T(wet_volume.at(at.depth).value[0] / T(whole)), T(0));
    return out;
  }

  /// Drag of the part that is wet: of a cylinder across and along by themselves, of a sphere by its speed.
  template <class T>
  Vec3<T> drag(const Place<T>& at, const WetShare<T>& wet) const {
    using std::sqrt;
    const Vec3<T>& v = at.velocity;
    Vec3<T> along = Vec3<T>::Zero();
    const auto brake = [&](int i, const T& speed) {
      along[i] = T(-drag_factors[i]) * (speed * wet.share) * v[i];
    };
    const auto brake_alone = [&](int i) { brake(i, select(v[i] > T(0), v[i], T(-v[i]))); };
    const auto brake_from = [&](int first) {  // by their common speed
      T square = T(0);
      for (int i = first; i < 3; ++i) square += v[i] * v[i];
      if (!any(square > T(0))) return;
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
  Carried<T> carried(const ImmersedRow<T>& as, const Place<T>& at) const {
    Carried<T> out;
    const Added<T> here = added_at(as, at.center, at.rate);
    const Vec3<T>&v = at.velocity, &own = at.own, &turning = as.turning;
    const Vec3<T> momentum = here.mass.cwiseProduct(v);
    const Vec3<T> passed = cross<T>(turning, own - v);  // the motion of the water, turned
    Vec3<T> along = here.mass.cwiseProduct(passed - as.swirl - at.pulled);
    out.power = dot<T>(passed, momentum);
    for (int i = 0; i < 3; ++i) {
      const T& gain = here.gain[i];
      const auto enters = gain > T(0);
      along[i] = select(enters, T(along[i] + gain * v[i]), along[i]);
      const T power = T(0.5) * gain * v[i] * v[i];
      out.loss += select(enters, power, T(-power));
      // The ledger's energy of A gains own (gain own / 2 - A swirl) beside that of A a.
      out.power += own[i] * (T(0.5) * gain * own[i] - here.mass[i] * as.swirl[i] - along[i]);
    }
    out.force = -(along + cross<T>(turning, momentum));
    out.moment = -cross<T>(v, momentum);
    return out;
  }

 private:
  bool round() const { return shape == Shape::cylinder || shape == Shape::disc; }

  /// Its moment about the state point, at the centre, axes of the part.
  template <class T, class R>
  static Vec3<T> moment_of(const Vec3<R>& arm, const Vec3<T>& force) {
    const R x = arm.x(), y = arm.y(), z = arm.z();
    return {y * force.z() - z * force.y(), z * force.x() - x * force.z(), x * force.y() - y * force.x()};
  }
};

}  // namespace seacrane
