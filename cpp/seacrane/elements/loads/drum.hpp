#pragma once

#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

inline constexpr double kStrongest = 1e12;  // N and W: a bound here is none

struct DrumDescription {
  double drum_inertia = 0.0, drum_radius = 0.0;
  double maximum_tension = kStrongest, maximum_power = kStrongest;
  Curve brake;
  double brake_capacity = 0.0, brake_give = 1e-3;

  static constexpr auto fields() {
    using D = DrumDescription;
    return std::tuple(
        optional("drum_inertia", &D::drum_inertia, "kg m2", "of drum, gear and motor at the drum; 0: none")
            .not_negative(),
        optional("drum_radius", &D::drum_radius, "m", "at which the rope runs")
            .not_negative()
            .usually(0.01, 10.0),
        optional("maximum_tension", &D::maximum_tension, "N", "of the motor, at the rope; 0: no motor")
            .not_negative(),
        optional("maximum_power", &D::maximum_power, "W", "that the motor gives").positive(),
        optional("brake", &D::brake, "", "share of its capacity that is applied, 0 (open) to 1")
            .within(0.0, 1.0)
            .usually(0.0, 1.0),
        optional("brake_capacity", &D::brake_capacity, "N", "of the brake, at the rope; 0: no brake")
            .not_negative(),
        optional("brake_give", &D::brake_give, "m", "of rope, before the brake bears its capacity")
            .positive()
            .usually(1e-5, 0.5));
  }
};

/// A drum with inertia, a motor within bounds and a brake, all of it as seen by the rope: with M = J /
/// radius^2, T the rope's tension and r the rate at which the drum pays out,
///
///   M r' = F + T - B,   F = (1 - b) (M a - T within maximum_tension and maximum_power).
///
/// a is what the winch asks for; the motor knows T. As the brake closes, b from 0 to 1, the motor lets go.
/// The brake is a spring k = capacity / give, critically damped with M, on a friction that slips at b
/// capacity:
///
///   B = k z + d r within b capacity,   z' = (B - k z) / d,
///
/// so that z' = r while it sticks: it holds without creep. All powers are those of the rope's rate.
struct Drum {
  /// What motor and brake do at an instant: N at the rope, m/s and W.
  struct Drive {
    double motor, brake, rate, brake_power;
  };

  DrumDescription d;
  double mass = 0.0, stiffness = 0.0, damping = 1.0;
  int wound = -1;  // z among the states; none: no brake

  static constexpr std::array<Margin, 6> kMargins = {
      {{"maximum_tension"}, {"maximum_tension"}, {"maximum_power"}, {}, {}, {"brake_capacity"}}};

  static void check(const DrumDescription& d, double lag, const Check& c) {
    if (d.drum_inertia == 0.0) return check_absent(d, c);
    if (d.drum_radius == 0.0) c.fail("has a drum_inertia and no drum_radius; give it, m");
    if (!(lag > 0.0))
      c.fail("a drum with inertia needs a lag, of its motor's speed; give one, such as 0.1 s");
    if (d.brake_capacity == 0.0 && is_given(d.brake)) {
      c.fail("has a brake without a capacity; give brake_capacity, N at the rope");
    }
  }

  template <class Context>
  static Drum compile(const DrumDescription& d, const std::string& line, Context& context) {
    Drum out{d, d.drum_inertia / (d.drum_radius * d.drum_radius)};
    if (d.brake_capacity == 0.0) return out;
    out.stiffness = d.brake_capacity / d.brake_give;
    out.damping = 2.0 * std::sqrt(out.stiffness * out.mass);
    out.wound = context.state({line + ".brake", "m", 0.0, d.brake_give});
    return out;
  }

  bool has_brake() const { return wound >= 0; }

  /// F, for the acceleration a that is asked for.
  template <class T>
  T motor(const LoadInput<T>& in, const T& asked, const T& tension, const T& rate) const {
    const T force = clamped(wanted(asked, tension), T(-d.maximum_tension), T(d.maximum_tension));
    const T speed = select(rate < T(0), T(-rate), rate);
    const T strongest = T(d.maximum_power) / select(speed > T(kSlowest), speed, T(kSlowest));
    const T given = select(force * rate > T(0), clamped(force, T(-strongest), strongest), force);
    return T(1.0 - applied(in)) * given;
  }
  /// B.
  template <class T>
  T braking(const LoadInput<T>& in, const T& rate) const {
    if (!has_brake()) return T(0);
    const T most(d.brake_capacity * applied(in));
    return clamped(grip(in, rate), T(-most), most);
  }
  /// r'.
  template <class T>
  T acceleration(const LoadInput<T>& in, const T& asked, const T& tension, const T& rate) const {
    return (motor(in, asked, tension, rate) + tension - braking(in, rate)) / T(mass);
  }
  /// z'.
  template <class T>
  T winding(const LoadInput<T>& in, const T& rate) const {
    return (braking(in, rate) - T(stiffness) * in.states[wound]) / T(damping);
  }
  /// The power of the brake into the drum and into its own spring: never positive.
  template <class T>
  T brake_power(const LoadInput<T>& in, const T& rate) const {
    if (!has_brake()) return T(0);
    return T(stiffness) * in.states[wound] * winding(in, rate) - braking(in, rate) * rate;
  }
  double stored(const LoadInput<double>& in, double rate) const {
    const double spring = has_brake() ? 0.5 * stiffness * in.states[wound] * in.states[wound] : 0.0;
    return spring + 0.5 * mass * rate * rate;
  }

  /// A motor that has let go, and a brake that is not closed, meet no bound.
  std::array<Margin, 6> margins(const LoadInput<double>& in, double asked, double tension,
                                double rate) const {
    auto out = kMargins;
    if (applied(in) < 1.0 && d.maximum_tension > 0.0) {
      const double force = wanted(asked, tension);
      out[0].value = d.maximum_tension - force;
      out[1].value = d.maximum_tension + force;
      out[2].value = d.maximum_power - clamped(force, -d.maximum_tension, d.maximum_tension) * rate;
    }
    if (has_brake()) {
      const double held = grip(in, rate), most = d.brake_capacity * applied(in);
      out[3].value = most - held;
      out[4].value = most + held;
      if (applied(in) >= 1.0) out[5].value = most - std::abs(held);
    }
    return out;
  }

 private:
  static constexpr double kSlowest = 1e-9;  // m/s: below, the power bounds nothing

  static void check_absent(const DrumDescription& d, const Check& c) {
    const auto needs_drum = [&](bool given, const char* what) {
      if (given)
        c.fail(std::string(what) + " needs a drum: give drum_inertia and drum_radius, or leave it out");
    };
    needs_drum(d.drum_radius != 0.0, "drum_radius");
    needs_drum(d.maximum_tension != kStrongest, "maximum_tension");
    needs_drum(d.maximum_power != kStrongest, "maximum_power");
    needs_drum(d.brake_capacity != 0.0, "brake_capacity");
    needs_drum(is_given(d.brake), "brake");
  }

  static bool is_given(const Curve& curve) { return curve.pieces().size() > 1 || curve.at(0.0).value != 0.0; }

  /// b.
  template <class T>
  double applied(const LoadInput<T>& in) const {
    return clamped(d.brake.at(in.time, in.curve_limit).value, 0.0, 1.0);
  }
  template <class T>
  T wanted(const T& asked, const T& tension) const {
    return T(mass) * asked - tension;
  }
  template <class T>
  T grip(const LoadInput<T>& in, const T& rate) const {
    return T(stiffness) * in.states[wound] + T(damping) * rate;
  }
};

}  // namespace seacrane
