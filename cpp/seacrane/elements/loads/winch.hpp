#pragma once

#include <string>
#include <tuple>
#include <utility>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct WinchDescription {
  bool winch = false;
  Curve rate;
  double maximum_rate = kFarthest, maximum_acceleration = kFarthest, lag = 0.0;
  double minimum_length = 0.1;

  static constexpr auto fields() {
    using D = WinchDescription;
    return std::tuple(
        optional("winch", &D::winch, "", "whether the length is a state that `rate` drives"),
        optional("rate", &D::rate, "m/s", "commanded, positive: pays out"),
        optional("maximum_rate", &D::maximum_rate, "m/s", "of the winch; at 1e7 there is none"),
        optional("maximum_acceleration", &D::maximum_acceleration, "m/s2", "likewise; needs a lag"),
        optional("lag", &D::lag, "s", "of the winch's rate behind the command"),
        optional("minimum_length", &D::minimum_length, "m", "at which hauling in stops"));
  }
};

/// What drives the unstretched length l0 of a line, a state, l0' = r. Its rate r is the command within its
/// bounds; with a lag it is a state too, from rest, r' = (command - r) / lag within bounds.
struct Winch {
  Curve command;
  double maximum_rate = 0.0, maximum_acceleration = 0.0, lag = 0.0, minimum_length = 0.0;
  int slot = 0;       // of the rate that is added to the command
  StateRange states;  // length, and rate with a lag

  static void check(const WinchDescription& d, const Curve& length, const Check& c) {
    if (length.pieces().size() > 1 || length.at(0.0).value != length.at(1.0).value) {
      c.fail("length changes over time, and the winch does that; give the length at the start");
    }
    for (const auto& [what, value] : {std::pair{"maximum_rate", d.maximum_rate},
                                      std::pair{"maximum_acceleration", d.maximum_acceleration},
                                      std::pair{"minimum_length", d.minimum_length}}) {
      c.finite(what, value);
      if (!(value > 0.0)) c.fail(std::string(what) + " is " + to_text(value) + "; it must be positive");
    }
    c.not_negative("lag", d.lag);
    if (d.maximum_acceleration < kFarthest && d.lag == 0.0) {
      c.fail(
          "maximum_acceleration needs a lag: without one the rate is the command; give a lag, such as 0.1 s");
    }
    if (!(length.at(0.0).value > d.minimum_length)) {
      c.fail("starts with a length of " + to_text(length.at(0.0).value) + " m and a minimum_length of " +
             to_text(d.minimum_length) + " m; start with a longer line");
    }
  }

  /// Of the line of this name, whose unstretched length is `start` at first.
  template <class Context>
  static Winch compile(const WinchDescription& d, const std::string& name, double start, Context& context) {
    Winch out;
    out.command = d.rate;
    out.maximum_rate = d.maximum_rate;
    out.maximum_acceleration = d.maximum_acceleration;
    out.lag = d.lag;
    out.minimum_length = d.minimum_length;
    out.slot = context.input(name + ".rate");
    const double scale = context.length_scale();
    out.states = {context.state({name + ".length", "m", start, scale}), 1};
    if (d.lag > 0.0) {
      context.state({name + ".rate", "m/s", 0.0, scale});
      out.states.count = 2;
    }
    return out;
  }

  template <class T>
  T length(const LoadInput<T>& in) const {
    return in.states[states.first];
  }
  /// l0'.
  template <class T>
  T rate(const LoadInput<T>& in) const {
    const T turning = lag > 0.0 ? in.states[states.first + 1] : commanded(in);
    const bool at_end = length(in) < T(minimum_length) && turning < T(0);
    return select(at_end, T(0), turning);
  }
  /// l0'', with a lag.
  template <class T>
  T acceleration(const LoadInput<T>& in) const {
    const T asked = (commanded(in) - in.states[states.first + 1]) / T(lag);
    return clamped(asked, T(-maximum_acceleration), T(maximum_acceleration));
  }

  template <class T>
  void set_rates(const LoadInput<T>& in, T* state_rates) const {
    state_rates[states.first] = rate(in);
    if (lag > 0.0) state_rates[states.first + 1] = acceleration(in);
  }

 private:
  template <class T>
  T commanded(const LoadInput<T>& in) const {
    const double asked = command.at(in.time, in.curve_limit).value + in.slots[slot];
    return T(clamped(asked, -maximum_rate, maximum_rate));
  }
};

}  // namespace seacrane
