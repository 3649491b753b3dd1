#pragma once

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/constant_tension.hpp"
#include "seacrane/elements/loads/drum.hpp"
#include "seacrane/elements/loads/heave_signal.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct WinchDescription : ConstantTensionDescription, DrumDescription {
  bool winch = false;
  Curve rate;
  double maximum_rate = kFarthest, maximum_acceleration = kFarthest, lag = 0.0;
  double minimum_length = 0.1, maximum_length = kFarthest;

  static constexpr auto fields() {
    using D = WinchDescription;
    return std::tuple_cat(
        std::tuple(optional("winch", &D::winch, "", "whether the length is a state that `rate` drives"),
                   optional("rate", &D::rate, "m/s", "commanded, positive: pays out").usually(0.0, 20.0),
                   optional("maximum_rate", &D::maximum_rate, "m/s", "of the winch; at 1e7 there is none")
                       .positive()
                       .usually(1e-3, 50.0),
                   optional("maximum_acceleration", &D::maximum_acceleration, "m/s2", "likewise; needs a lag")
                       .positive()
                       .usually(1e-4, 50.0),
                   optional("lag", &D::lag, "s", "of the winch's rate behind the command")
                       .not_negative()
                       .usually(1e-3, 30.0),
                   optional("minimum_length", &D::minimum_length, "m", "at which hauling in stops")
                       .positive()
                       .usually(0.0, 50.0),
                   optional("maximum_length", &D::maximum_length, "m",
                            "that the drum holds: there paying out stops; at 1e7 there is no end")
                       .positive()
                       .usually(1.0, 2e4)),
        ConstantTensionDescription::fields(), DrumDescription::fields());
  }
};

/// What drives the unstretched length l0 of a line, a state, l0' = r. Its rate r is the command within its
/// bounds; with a lag it is a state too, from rest, r' = (command - r) / lag within bounds. A drum with
/// inertia follows that acceleration as its motor can.
///
/// `pull` is EA e, without damping: what the winch measures where it holds a tension.
struct Winch {
  WinchDescription d;
  int slot = 0;       // of the rate that is added to the command
  Followed follows;   // so is the rate of a heave compensator
  StateRange states;  // length, rate with a lag, and that of a drum's brake
  std::optional<ConstantTension> tension;
  std::optional<Drum> drum;

  using Drives = std::vector<std::pair<const Curve*, double>>;
  /// Bounds of the rate and the acceleration in both directions.
  static constexpr std::array<Margin, 4> kMargins = {
      {{"maximum_rate"}, {"maximum_rate"}, {"maximum_acceleration"}, {"maximum_acceleration"}}};
  static constexpr std::size_t kKinks = kMargins.size() + 2 + Drum::kMargins.size();

  /// `length` is that of a share of the line.
  static void check(const WinchDescription& d, const Curve& length, double share, const Check& c) {
    if (length.pieces().size() > 1 || length.at(0.0).value != length.at(1.0).value) {
      c.fail("length changes over time, and the winch does that; give the length at the start");
    }
    if (d.maximum_acceleration < kFarthest && d.lag == 0.0) {
      c.fail(
          "maximum_acceleration needs a lag: without one the rate is the command; give a lag, such as 0.1 s");
    }
    const double start = length.at(0.0).value / share;
    if (!(start > d.minimum_length)) {
      c.fail("starts with a length of " + to_text(start) + " m and a minimum_length of " +
             to_text(d.minimum_length) + " m; start with a longer line");
    }
    if (!(start < d.maximum_length)) {
      c.fail("starts with a length of " + to_text(start) + " m and a maximum_length of " +
             to_text(d.maximum_length) + " m; start with a shorter line");
    }
    ConstantTension::check(d, c);
    Drum::check(d, d.lag, c);
  }

  /// Compiles the winch of the line of this name, whose unstretched length is `start` at first.
  template <class Context>
  static Winch compile(const WinchDescription& d, const std::string& name, double start, Context& context) {
    Winch out;
    out.d = d;
    out.slot = context.input(name + ".rate");
    out.follows = context.followed("line", name);
    const double scale = context.length_scale();
    out.states = {context.state({name + ".length", "m", start, scale}), 1};
    if (d.lag > 0.0) {
      context.state({name + ".rate", "m/s", 0.0, scale});
      out.states.count = 2;
    }
    if (d.tension_gain > 0.0) out.tension = ConstantTension{d};
    if (d.drum_inertia > 0.0) {
      out.drum = Drum::compile(d, name, context);
      if (out.drum->has_brake()) ++out.states.count;
    }
    return out;
  }

  /// Curves that drive l0, each by a factor, after `integrations`.
  Drives driven_by() const {
    const double share = d.lag > 0.0 ? 1.0 / d.lag : 1.0;
    Drives out = {{&d.rate, share}};
    if (tension) out.emplace_back(&d.tension, d.tension_gain * share);
    if (drum && drum->has_brake()) out.emplace_back(&d.brake, d.brake_capacity / drum->mass);
    return out;
  }
  int integrations() const { return d.lag > 0.0 ? 2 : 1; }

  template <class T>
  T length(const LoadInput<T>& in) const {
    return in.states[states.first];
  }
  /// r.
  template <class T>
  T turning(const LoadInput<T>& in, const T& pull) const {
    return d.lag > 0.0 ? in.states[states.first + 1] : commanded(in, pull);
  }
  /// l0': r, but for going on beyond an end.
  template <class T>
  T rate(const LoadInput<T>& in, const T& pull) const {
    const T r = turning(in, pull);
    return select(beyond_end(in, r), T(0), r);
  }
  /// r' that is asked for, with a lag. A drum is stopped at an end.
  template <class T>
  T asked_acceleration(const LoadInput<T>& in, const T& pull) const {
    const T goal = commanded(in, pull);
    const bool ended = drum.has_value() && beyond_end(in, goal);
    const T asked = (select(ended, T(0), goal) - in.states[states.first + 1]) / T(d.lag);
    return clamped(asked, T(-d.maximum_acceleration), T(d.maximum_acceleration));
  }

  template <class T>
  void set_rates(const LoadInput<T>& in, const T& pull, const T& line_tension, T* state_rates) const {
    state_rates[states.first] = rate(in, pull);
    if (!(d.lag > 0.0)) return;
    const T asked = asked_acceleration(in, pull), r = turning(in, pull);
    state_rates[states.first + 1] = drum ? drum->acceleration(in, asked, line_tension, r) : asked;
    if (drum && drum->has_brake()) state_rates[drum->wound] = drum->winding(in, r);
  }

  /// The powers of motor and brake, and into the line that of the rope at the drum's rim; with a drum, what
  /// is left of the last beside the tension's is the strain energy that the rope carries.
  template <class T>
  void add_power(const LoadInput<T>& in, const T& pull, const T& line_tension, const T& into_line,
                 LoadSum<T>& out) const {
    if (!drum) return out.add_power(into_line);
    const T r = turning(in, pull);
    out.add_power(drum->motor(in, asked_acceleration(in, pull), line_tension, r) * r);
    out.add_power(drum->brake_power(in, r));
    out.add_power(line_tension * r + into_line);
  }

  /// Margins of the winch itself, of its dead band and of its drum.
  void add_margins(const LoadInput<double>& in, double pull, double line_tension, Margins& out) const {
    auto own = kMargins;
    const double asked = goal(in, pull), at_bound = (1.0 + kRounding) * d.maximum_rate;
    own[0].value = at_bound - asked;
    own[1].value = at_bound + asked;
    if (d.lag > 0.0) {
      const double change = (commanded(in, pull) - in.states[states.first + 1]) / d.lag,
                   most = (1.0 + kRounding) * d.maximum_acceleration;
      own[2].value = most - change;
      own[3].value = most + change;
    }
    out.add(own);
    out.add(tension ? tension->margins(in, pull) : std::array<Margin, 2>());
    out.add(drum ? drum->margins(in, asked_acceleration(in, pull), line_tension, turning(in, pull))
                 : Drum::kMargins);
  }

 private:
  static constexpr double kRounding = 1e-12;  // of a bound that is met and not exceeded

  /// What is commanded, before its bound.
  template <class T>
  T goal(const LoadInput<T>& in, const T& pull) const {
    const double given = d.rate.at(in.time, in.curve_limit).value + in.slots[slot];
    const T asked = T(given) + follows.rate(in);
    return tension ? T(asked + tension->rate(in, pull)) : asked;
  }
  template <class T>
  T commanded(const LoadInput<T>& in, const T& pull) const {
    return clamped(goal(in, pull), T(-d.maximum_rate), T(d.maximum_rate));
  }
  /// Whether a rate leads on from an end: at it, as where it was located.
  template <class T>
  bool beyond_end(const LoadInput<T>& in, const T& r) const {
    const T now = length(in);
    return (!(now > T(d.minimum_length)) && r < T(0)) || (!(now < T(d.maximum_length)) && r > T(0));
  }
};

}  // namespace seacrane
