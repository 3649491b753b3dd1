#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/heave_signal.hpp"

namespace seacrane {

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
        optional("ratio", &D::ratio, "", "of what follows to the stroke: m/m, or rad/m"),
        optional("gain", &D::gain, "", "of the stroke to the motion").usually(0.01, 10.0),
        optional("high_pass", &D::high_pass, "Hz", "corner of the filter; 0: none").usually(1e-4, 2.0),
        optional("lag", &D::lag, "s", "of the measured motion").usually(1e-3, 20.0),
        optional("lag_order", &D::lag_order, "", "1, or 2: nearer to a pure delay"),
        optional("actuator_frequency", &D::actuator_frequency, "Hz",
                 "natural frequency of the drive, second order; 0: none")
            .usually(0.02, 200.0),
        optional("actuator_damping", &D::actuator_damping, "", "of critical damping of the drive")
            .usually(0.03, 10.0),
        optional("maximum_rate", &D::maximum_rate, "m/s", "of the stroke; at 1e7 there is none")
            .usually(0.01, 50.0),
        optional("maximum_stroke", &D::maximum_stroke, "m",
                 "of the stroke in both directions; at 1e7 there is none")
            .usually(0.01, 100.0),
        optional("settling", &D::settling, "s",
                 "in which the stroke returns to the motion after a bound, and brakes before its own")
            .usually(2e-3, 20.0));
  }
};

/// Active heave compensation: states without a force. What it does stands with HeaveSignal.
struct HeaveCompensator {
  static constexpr const char* kind = "heave compensator";
  using Description = HeaveCompensatorDescription;

  std::string name;
  HeaveSignal signal;
  StateRange states;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body, true);
    c.near("point", d.point);
    c.finite("direction", d.direction);
    if (!(d.direction.norm() > 0.0)) c.fail("direction is zero; give one, such as (0, 0, 1) for up");
    if (!d.winch.empty() && !d.actuator.empty()) {
      c.fail("moves winch '" + d.winch + "' and actuator '" + d.actuator + "'; give each its own");
    }
    c.finite("ratio", d.ratio);
    if (d.ratio == 0.0) c.fail("ratio is 0, which moves nothing; give that of what follows to the stroke");
    c.finite("gain", d.gain);
    for (const auto& [what, value] : {std::pair{"high_pass", d.high_pass}, std::pair{"lag", d.lag},
                                      std::pair{"actuator_frequency", d.actuator_frequency},
                                      std::pair{"actuator_damping", d.actuator_damping}}) {
      c.not_negative(what, value);
    }
    for (const auto& [what, value] :
         {std::pair{"maximum_rate", d.maximum_rate}, std::pair{"maximum_stroke", d.maximum_stroke},
          std::pair{"settling", d.settling}}) {
      c.finite(what, value);
      if (!(value > 0.0)) c.fail(std::string(what) + " is " + to_text(value) + "; it must be positive");
    }
    if (d.lag_order != 1.0 && d.lag_order != 2.0) {
      c.fail("lag_order is " + to_text(d.lag_order) + "; choose 1 or 2");
    }
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.body = "second";
    d.point = {0.4, -0.3, 1.0};
    d.direction = {0.2, 0.1, 1.0};
    d.gain = 0.9;
    d.high_pass = 0.1;
    d.lag = 0.3;
    d.lag_order = 2.0;
    d.actuator_frequency = 0.8;
    d.maximum_rate = 20.0;
    d.maximum_stroke = 10.0;
    return d;
  }

  template <class Context>
  static HeaveCompensator compile(const Description& d, Context& context) {
    const Attachment at = context.attach(d.body, d.point);
    HeaveSignal s;
    s.body = at.body;
    s.point = at.point;
    s.direction = d.direction.normalized();
    s.corner = 2.0 * std::numbers::pi * d.high_pass;
    s.lag = d.lag;
    s.second_order = d.lag_order == 2.0;
    s.actuator = 2.0 * std::numbers::pi * d.actuator_frequency;
    s.actuator_damping = d.actuator_damping;
    s.gain = d.gain;
    s.settling = d.settling;
    s.maximum_rate = d.maximum_rate;
    s.maximum_stroke = d.maximum_stroke;
    const double scale = context.length_scale();
    const auto state = [&](const char* what, const char* unit) {
      return context.state({d.name + "." + what, unit, 0.0, scale});
    };
    s.states = {state("motion", "m"), s.count()};
    if (s.lag > 0.0) state("lagged", "m");
    if (s.lag > 0.0 && s.second_order) state("lagged_rate", "m/s");
    if (s.actuator > 0.0) {
      state("drive", "m");
      state("drive_rate", "m/s");
    }
    state("stroke", "m");
    return {d.name, s, s.states};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  /// What it leads: as what, and by its name.
  static std::vector<std::pair<const char*, std::string>> leads(const Description& d) {
    if (!d.winch.empty()) return {{"winch", d.winch}};
    if (!d.actuator.empty()) return {{"actuator", d.actuator}};
    return {};
  }

  std::array<int, 1> bodies() const { return {signal.body}; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    signal.motion(in, out.state_rates);
  }

  bool has_sides() const { return signal.maximum_rate < kFarthest || signal.maximum_stroke < kFarthest; }
  /// 0 within the bounds; 1 at that on the rate, 2 at that on the stroke; negative: downwards.
  int side(const LoadInput<double>& in) const {
    const HeaveSignal::Motion<double> now = signal.motion(in);
    if (now.wanted > now.high) return now.high < signal.maximum_rate ? 2 : 1;
    if (now.wanted < now.low) return now.low > -signal.maximum_rate ? -2 : -1;
    return 0;
  }
  double across(const LoadInput<double>& in, int from, int to) const {
    const HeaveSignal::Motion<double> now = signal.motion(in);
    const bool up = from > 0 || (from == 0 && to > 0);
    if (from * to > 0) {
      const double left = signal.maximum_stroke + (up ? -now.stroke : now.stroke);
      return left / signal.settling - signal.maximum_rate;
    }
    return up ? now.high - now.wanted : now.wanted - now.low;
  }
  /// What is reached where it changes its side; empty: nothing.
  std::string reached(int from, int to) const {
    if (to == 0 || to == from) return "";
    return name + (std::abs(to) == 1 ? ".rate" : ".stroke");
  }
};

}  // namespace seacrane
