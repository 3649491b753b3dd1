#pragma once

#include <cmath>

#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

/// The motion of a point along a direction, as a compensator hands it on: with v the speed of the point,
///
///   h' = v - corner h                       high-pass filter of first order,
///   y  = h behind a lag                     first order, or of second order (Bessel),
///   z  = y behind an actuator               second order,
///   s' = gain z' + (gain z - s) / settling  the stroke, within bounds on s' and on s.
///
/// Within the bounds s = gain z exactly. A bound on the stroke slows s' down to (bound - s) / settling.
struct HeaveSignal {
  template <class T>
  struct Motion {
    T reference, reference_rate;  // gain z
    T stroke, wanted;             // s, and s' without bounds
    T low, high;                  // bounds on s'
    T rate() const { return clamped(wanted, low, high); }
  };

  int body = 0;
  Vec3d point, direction;  // from the state point, body axes; of unit length, inertial axes
  double corner = 0.0;     // rad/s
  double lag = 0.0;        // s
  bool second_order = false;
  double actuator = 0.0, actuator_damping = 0.0;  // rad/s, 0: none; of critical damping
  double gain = 1.0, settling = 1.0;
  double maximum_rate = 0.0, maximum_stroke = 0.0;
  StateRange states;  // h, those of lag and actuator, s

  /// How many states it has.
  int count() const { return 2 + (lag > 0.0 ? (second_order ? 2 : 1) : 0) + (actuator > 0.0 ? 2 : 0); }

  /// With `rates`, those of its states are written there.
  template <class T>
  Motion<T> motion(const LoadInput<T>& in, T* rates = nullptr) const {
    const T* x = in.states + states.first;
    int i = 0;
    Pair<T> now{x[0], speed(in) - T(corner) * x[0]};
    const auto put = [&](const T& rate) {
      if (rates != nullptr) rates[states.first + i] = rate;
      ++i;
    };
    put(now.rate);
    const auto second = [&](double stiffness, double damping) {
      const T bend = T(stiffness) * (now.value - x[i]) - T(damping) * x[i + 1];
      now = {x[i], x[i + 1]};
      put(now.rate);
      put(bend);
    };
    if (lag > 0.0 && second_order) second(3.0 / (lag * lag), 3.0 / lag);
    if (lag > 0.0 && !second_order) {
      now = {x[i], (now.value - x[i]) / T(lag)};
      put(now.rate);
    }
    if (actuator > 0.0) second(actuator * actuator, 2.0 * actuator_damping * actuator);
    Motion<T> out;
    out.reference = T(gain) * now.value;
    out.reference_rate = T(gain) * now.rate;
    out.stroke = x[i];
    out.wanted = out.reference_rate + (out.reference - out.stroke) / T(settling);
    const T up = (T(maximum_stroke) - out.stroke) / T(settling);
    const T down = (T(-maximum_stroke) - out.stroke) / T(settling);
    out.high = select(up < T(maximum_rate), up, T(maximum_rate));
    out.low = select(down > T(-maximum_rate), down, T(-maximum_rate));
    put(out.rate());
    return out;
  }

 private:
  template <class T>
  struct Pair {
    T value, rate;
  };
  template <class T>
  T speed(const LoadInput<T>& in) const {
    const BodyKinematics<T>& k = in.bodies[body];
    const Vec3<T> lever = k.rotation * point.template cast<T>();
    const Vec3<T> velocity = k.velocity + cross<T>(k.angular_velocity, lever);
    return direction.template cast<T>().dot(velocity);
  }
};

/// The compensator that a winch or an actuator follows, and by how much of its stroke; or none.
struct Followed {
  double ratio = 0.0;  // 0: none
  HeaveSignal signal;

  bool any() const { return ratio != 0.0; }
  template <class T>
  T rate(const LoadInput<T>& in) const {
    return any() ? T(ratio) * signal.motion(in).rate() : T(0);
  }
  template <class T>
  T stroke(const LoadInput<T>& in) const {
    return any() ? T(ratio) * signal.motion(in).stroke : T(0);
  }
};

}  // namespace seacrane
