#pragma once

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/heave_signal.hpp"

namespace seacrane {

/// Active heave compensation: states without a force. What it does stands with HeaveSignal.
struct HeaveCompensator {
  static constexpr const char* kind = "heave compensator";
  using Description = HeaveCompensatorDescription;

  HeaveSignal signal;
  StateRange states;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.body, true);
    if (!(d.direction.norm() > 0.0)) c.fail("direction is zero; give one, such as (0, 0, 1) for up");
    if (!d.winch.empty() && !d.actuator.empty()) {
      c.fail("moves winch '" + d.winch + "' and actuator '" + d.actuator + "'; give each its own");
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
    s.d = d;
    s.body = at.body;
    s.point = at.point;
    s.direction = d.direction.normalized();
    s.corner = 2.0 * std::numbers::pi * d.high_pass;
    s.actuator = 2.0 * std::numbers::pi * d.actuator_frequency;
    const double scale = context.length_scale();
    const auto state = [&](const char* what, const char* unit) {
      return context.state({d.name + "." + what, unit, 0.0, scale});
    };
    s.states = {state("motion", "m"), s.count()};
    if (d.lag > 0.0) state("lagged", "m");
    if (d.lag > 0.0 && s.second_order()) state("lagged_rate", "m/s");
    if (s.actuator > 0.0) {
      state("drive", "m");
      state("drive_rate", "m/s");
    }
    state("stroke", "m");
    return {s, s.states};
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

  bool has_sides() const { return signal.d.maximum_rate < kFarthest || signal.d.maximum_stroke < kFarthest; }
  Side side(const LoadInput<double>& in) const {
    const HeaveSignal::Motion<double> now = signal.motion(in);
    if (now.wanted > now.high) return side_of({now.high < signal.d.maximum_rate ? kStroke : kRate});
    if (now.wanted < now.low) return side_of({now.low > -signal.d.maximum_rate ? kStroke : kRate, kDown});
    return {};
  }
  double across(const LoadInput<double>& in, const Side& from, const Side& to) const {
    const HeaveSignal::Motion<double> now = signal.motion(in);
    const bool up = !(from.any() ? from : to)[kDown];
    if (from.any() && to.any() && from[kDown] == to[kDown]) {
      const double left = signal.d.maximum_stroke + (up ? -now.stroke : now.stroke);
      return left / signal.d.settling - signal.d.maximum_rate;
    }
    return up ? now.high - now.wanted : now.wanted - now.low;
  }
  /// What is reached where it changes its side; empty: nothing.
  std::string reached(const Side& from, const Side& to) const {
    if (to.none() || to == from) return "";
    return signal.d.name + (to[kRate] ? ".rate" : ".stroke");
  }

 private:
  /// Bounds that hold it, and whether it is held downwards.
  static constexpr std::size_t kRate = 0, kStroke = 1, kDown = 2;
};

}  // namespace seacrane
