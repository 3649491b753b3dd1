#pragma once

#include <memory>
#include <string>
#include <tuple>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct Line;

struct HeaveCompensatorDescription {
  std::string name, body;
  Vec3d point = Vec3d::Zero(), direction = Vec3d::UnitZ();
  std::string winch, actuator;
  double ratio = 1.0, gain = 1.0, high_pass = 0.03, lag = 0.0, lag_order = 1.0;
  double actuator_frequency = 0.0, actuator_damping = 0.7;
  double maximum_rate = kFarthest, maximum_stroke = kFarthest, settling = 0.2;

  static constexpr const char* type = "HeaveCompensator";
  static constexpr const char* text =
      "Active heave compensation: a stroke that follows the motion of a point, and that a winch or an "
      "actuator follows; see Scene.add_heave_compensation.";
  static constexpr auto fields() {
    using D = HeaveCompensatorDescription;
    return std::tuple(
        on_body("body", &D::body, "body whose motion is measured"),
        optional("point", &D::point, "m", "measured point, coordinates of the body"),
        optional("direction", &D::direction, "", "along which it is measured, inertial axes"),
        optional("winch", &D::winch, "", "line whose winch follows"),
        optional("actuator", &D::actuator, "", "actuator that follows, in place of a winch"),
        optional("ratio", &D::ratio, "", "of what follows to the stroke: m/m, or rad/m").not_zero(),
        optional("gain", &D::gain, "", "of the stroke to the motion").usually(0.01, 10.0),
        optional("high_pass", &D::high_pass, "Hz", "corner of the filter; 0: none")
            .not_negative()
            .usually(1e-4, 2.0),
        optional("lag", &D::lag, "s", "of the measured motion").not_negative().usually(1e-3, 20.0),
        optional("lag_order", &D::lag_order, "", "1, or 2: nearer to a pure delay"),
        optional("actuator_frequency", &D::actuator_frequency, "Hz",
                 "natural frequency of the drive, second order; 0: none")
            .not_negative()
            .usually(0.02, 200.0),
        optional("actuator_damping", &D::actuator_damping, "", "of critical damping of the drive")
            .not_negative()
            .usually(0.03, 10.0),
        optional("maximum_rate", &D::maximum_rate, "m/s", "of the stroke; at 1e7 there is none")
            .positive()
            .usually(0.01, 50.0),
        optional("maximum_stroke", &D::maximum_stroke, "m",
                 "of the stroke in both directions; at 1e7 there is none")
            .positive()
            .usually(0.01, 100.0),
        optional("settling", &D::settling, "s",
                 "in which the stroke returns to the motion after a bound, and brakes before its own")
            .positive()
            .usually(2e-3, 20.0));
  }
};

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

  HeaveCompensatorDescription d;
  int body = 0;
  Vec3d point, direction;               // from the state point, body axes; of unit length, inertial axes
  double corner = 0.0, actuator = 0.0;  // rad/s, 0: none
  StateRange states;                    // h, those of lag and actuator, s

  bool second_order() const { return d.lag_order == 2.0; }
  /// How many states it has.
  int count() const { return 2 + (d.lag > 0.0 ? (second_order() ? 2 : 1) : 0) + (actuator > 0.0 ? 2 : 0); }

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
    if (d.lag > 0.0 && second_order()) second(3.0 / (d.lag * d.lag), 3.0 / d.lag);
    if (d.lag > 0.0 && !second_order()) {
      now = {x[i], (now.value - x[i]) / T(d.lag)};
      put(now.rate);
    }
    if (actuator > 0.0) second(actuator * actuator, 2.0 * d.actuator_damping * actuator);
    Motion<T> out;
    out.reference = T(d.gain) * now.value;
    out.reference_rate = T(d.gain) * now.rate;
    out.stroke = x[i];
    out.wanted = out.reference_rate + (out.reference - out.stroke) / T(d.settling);
    const T up = (T(d.maximum_stroke) - out.stroke) / T(d.settling);
    const T down = (T(-d.maximum_stroke) - out.stroke) / T(d.settling);
    out.high = select(up < T(d.maximum_rate), up, T(d.maximum_rate));
    out.low = select(down > T(-d.maximum_rate), down, T(-d.maximum_rate));
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

/// The compensator that a winch or an actuator follows, and by how much of its stroke; or none. What is a
/// part of a line with mass follows the segment on the winch.
struct Followed {
  double ratio = 0.0;  // 0: none
  HeaveSignal signal;
  std::shared_ptr<const Line> segment = nullptr;

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
