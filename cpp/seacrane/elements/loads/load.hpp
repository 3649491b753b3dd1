#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "seacrane/elements/kinematics.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

/// What a load sees from the side that it is on: how far at least another one is that it may meet and leave
/// again within a step, and how fast that way is gone. Far: where it is closed or taut, whose force error
/// control sees, and of loads whose sides are no places: what is commanded, and pressures.
struct Sight {
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  Side side = {};
  Side watched = {};         // what changes of the side where the other one is met
  double clear = kFar;       // m or rad
  double pace = 0.0;         // m/s or rad/s
  double thin = kFar;        // m: no shorter way leads through what is met
  bool strikes = false;      // what is met throws it back
  bool presses = false;      // on what is thin
  Vec3d at = Vec3d::Zero();  // where that is which moves
};

/// What a load did as its side changed: "contact" of a point that touches, for one.
struct Happening {
  std::string name;
  const char* kind;
  double speed = 0.0;  // m/s, of what touches
};

/// Velocity of a point of a body, from its state point in its axes.
inline Vec3d velocity_of(const BodyKinematics<double>& k, const Vec3d& point) {
  return k.velocity + k.angular_velocity.cross(k.rotation * point);
}

class SeaView;

/// What a load may look at. `bodies` holds all bodies and, last, the ground.
template <class T>
struct LoadInput {
  double time;
  double curve_limit;  // curve pieces from here on are not used yet, see Curve::at
  const BodyKinematics<T>* bodies;
  const double* slots;               // zero-order-held inputs
  const T* states;                   // of all loads
  const double* inertial = nullptr;  // tensions that follow from accelerations, see InertialTensions
  const SeaView* sea = nullptr;      // of a run; see sea_view.hpp
};

/// A differential state that a load has of its own, which it asks its context for when it is compiled.
struct LoadState {
  std::string name, unit;  // the name is one in the scene, such as "hoist.length"
  double initial = 0.0;
  double scale = 1.0;   // typical magnitude: errors count over it
  double growth = 0.0;  // and over this times the magnitude that the state has
};

/// The states of a load: a load that has some has a member `states` of this type.
struct StateRange {
  int first = 0, count = 0;
};

/// Whether apply() takes packs: it compares values by select() alone, and says so by `packs`.
template <class Load>
concept TakesPacks = requires {
  requires Load::packs;
};

template <class Load>
concept HasStates = requires(const Load& load) {
  { load.states } -> std::convertible_to<StateRange>;
};

/// Slopes of a load with stiff states. Row 0 is its force along its direction, the other rows are the rates
/// of its stiff states. Column 0 is the slope in its rate along that direction, the others in those states.
using StiffSlopes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// A load that acts along one direction, add_unit(0, ...), and some of whose states, one after another and
/// five at most, are stiff: stiff_states(), and stiff_slopes(input) in them.
template <class Load>
concept StiffLoad = requires(const Load& load, const LoadInput<double>& in, Vec6d* wrenches) {
  { load.stiff_states() } -> std::convertible_to<StateRange>;
  { load.stiff_slopes(in) } -> std::convertible_to<StiffSlopes>;
  load.add_unit(0, in, wrenches);
};

/// A load that adds inertia to its bodies: a 6 x 6 mass about the state point, inertial axes, by body, which
/// may depend on poses, time and states. The wrench -mass * acceleration is then not a part of apply(); all
/// that goes with velocities is, and half of velocity^T (d mass/dt) velocity is a part of its power.
template <class Load>
concept AddsInertia = requires(const Load& load, const LoadInput<double>& in, Mat6d* mass) {
  load.template add_inertia<double>(in, mass);
};

/// Whether a load looks at some of the states from `first` to before `last`: its own, or those of what it
/// follows, which a load that follows something tells by followed().
template <class Load>
bool looks_at_states(const Load& load, int first, int last) {
  const auto within = [&](const StateRange& range) {
    return range.first < last && range.first + range.count > first && range.count > 0;
  };
  if constexpr (HasStates<Load>) {
    if (within(load.states)) return true;
  }
  if constexpr (requires { load.followed(); }) return within(load.followed());
  return false;
}

/// Where a load of a described body acts on the compiled body that carries it.
struct Attachment {
  int body = 0;
  Vec3d point;                     // from the state point, in axes of the compiled body
  Mat3d axes = Mat3d::Identity();  // of the described body, likewise
};

/// Where a load over time is not smooth. Column p: what its derivative of order p - 1 jumps by, a row per
/// component of the load; column 0 is for jumps of the velocities themselves, which only drivers make. Over a
/// step h such a jump is worth up to jump h^p / p! of velocity.
struct LoadKink {
  double time = 0.0;
  Eigen::Matrix<double, Eigen::Dynamic, 4> jump;
};

/// The kinks of one curve or table, by time. Every load has kinks(), a list of these by its curves, and,
/// where there are some, add_unit(component, input, wrenches), which adds what a unit of a component puts on
/// the bodies. A load that depends on time has no other way to be stopped at.
using LoadKinks = std::vector<LoadKink>;

/// The kinks of `value` times a curve plus `rate` times its rate.
inline LoadKinks kinks_of(const Curve& curve, double value, double rate = 0.0) {
  LoadKinks out;
  for (const CurveKink& kink : curve.kinks()) {
    LoadKink load{kink.time, Eigen::Matrix<double, 1, 4>::Zero()};
    for (const int p : {1, 2, 3}) load.jump(0, p) = value * kink.jump(idx(p - 1));
    for (const int p : {1, 2}) load.jump(0, p) += rate * kink.jump(idx(p));
    out.push_back(std::move(load));
  }
  return out;
}

/// The tension of a load that depends on accelerations, see InertialTensions.
struct InertialTension {
  /// At either end of a section.
  struct Pull {
    int body;
    BodyLoad<double> path;  // of 1 N all along
    double share;           // of that, by friction
    Wrench<double> unit() const { return {share * path.force, share * path.moment}; }
    void add_to(Vec6d& load, double tension) const {
      const Wrench<double> by = tension * unit();
      load.head<3>() += by.force();
      load.tail<3>() += by.moment();
    }
  };

  double mass = 0.0;     // how it falls with the acceleration along the load, kg
  double winding = 0.0;  // what each newton of it takes from a winch, m/s
  double still = 0.0;    // with accelerations of zero, N
  std::vector<Pull> pulls;

  /// Along the load, of accelerations by body, that of the ground zero.
  double along(const Vec6d* acceleration) const {
    double sum = 0.0;
    for (const auto& [body, path, share] : pulls) {
      const Vec6d& a = acceleration[body];
      sum += path.force.dot(a.head<3>()) + path.moment.dot(a.tail<3>());
    }
    return sum;
  }
};

/// What loads add up: one wrench per body (the ground's is discarded), and the power that comes into the
/// mechanical energy, potentials included, for the energy balance. Each load sets the rates of its own
/// states.
template <class T>
struct LoadSum {
  BodyLoad<T>* wrench;
  T* state_rates = nullptr;  // of all loads
  T power = T(0), absolute_power = T(0);
  InertialTension* inertial = nullptr;  // by place; null: not asked for

  void add_power(const T& p) {
    power += p;
    absolute_power += select(p < T(0), T(-p), p);
  }
};

}  // namespace seacrane
