#pragma once

#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "seacrane/elements/field.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct HydraulicValveDescription {
  double pump_pressure = 0.0, tank_pressure = kAtmosphere;
  double rated_flow = 0.0, rated_flow_rod = 0.0, rated_drop = 3.5e6, laminar_drop = 2e5;
  double overlap = 0.0, spool_lag = 4.547e-3;
  bool pump_check = false;
  double makeup_flow = 0.0;
  double relief_pressure = 0.0, relief_pressure_rod = 0.0, relief_flow = 0.0, relief_override = 1e6;
  double counterbalance_pressure = 0.0, counterbalance_pressure_rod = 0.0, counterbalance_flow = 0.0;
  double counterbalance_range = 5e6, pilot_ratio = 4.0;

  static constexpr auto fields() {
    using D = HydraulicValveDescription;
    return std::tuple(
        optional("pump_pressure", &D::pump_pressure, "Pa", "of the supply, absolute; 0: no pump")
            .not_negative()
            .usually(3e5, 2e8),
        optional("tank_pressure", &D::tank_pressure, "Pa", "absolute").positive().usually(1e4, 5e6),
        optional("rated_flow", &D::rated_flow, "m3/s",
                 "of the valve's edges to the full side, open, at `rated_drop`; 0: no valve")
            .not_negative(),
        optional("rated_flow_rod", &D::rated_flow_rod, "m3/s", "of those to the rod side; 0: the same")
            .not_negative(),
        optional("rated_drop", &D::rated_drop, "Pa", "at which flows are rated").positive().usually(1e4, 1e8),
        optional("laminar_drop", &D::laminar_drop, "Pa", "about which flow turns from linear to square root")
            .positive()
            .usually(1e3, 1e7),
        optional("overlap", &D::overlap, "", "share of the spool's travel before an edge opens")
            .must_be({.minimum = 0.0, .maximum = 1.0, .below = true})
            .usually(0.0, 0.5),
        optional("spool_lag", &D::spool_lag, "s", "of the spool behind its command, first order; 0: none")
            .not_negative()
            .usually(1e-4, 1.0),
        optional("pump_check", &D::pump_check, "", "whether a check valve keeps oil from the pump"),
        optional("makeup_flow", &D::makeup_flow, "m3/s",
                 "of the check valves from the tank at `rated_drop`; 0: none")
            .not_negative(),
        optional("relief_pressure", &D::relief_pressure, "Pa",
                 "at which the full side's relief valve opens; 0: none")
            .not_negative()
            .usually(3e5, 2e8),
        optional("relief_pressure_rod", &D::relief_pressure_rod, "Pa", "the rod side's; 0: none")
            .not_negative()
            .usually(3e5, 2e8),
        optional("relief_flow", &D::relief_flow, "m3/s", "of a relief valve at `relief_override`")
            .not_negative(),
        optional("relief_override", &D::relief_override, "Pa", "above the opening")
            .positive()
            .usually(5e3, 1e8),
        optional("counterbalance_pressure", &D::counterbalance_pressure, "Pa",
                 "at which the full side's load-holding valve opens without pilot; 0: none")
            .not_negative()
            .usually(3e5, 2e8),
        optional("counterbalance_pressure_rod", &D::counterbalance_pressure_rod, "Pa",
                 "the rod side's; 0: none")
            .not_negative()
            .usually(3e5, 2e8),
        optional("counterbalance_flow", &D::counterbalance_flow, "m3/s",
                 "of a load-holding valve, open, at `rated_drop`")
            .not_negative(),
        optional("counterbalance_range", &D::counterbalance_range, "Pa", "from its opening to fully open")
            .positive()
            .usually(1e4, 1e8),
        optional("pilot_ratio", &D::pilot_ratio, "", "of the other side's pressure in its opening")
            .not_negative()
            .usually(0.1, 50.0));
  }
};

/// The valves of a cylinder, whose sides are 0, full, and 1, rod. Flow through an orifice of conductance C:
///
///   q = C dp / (dp^2 + laminar_drop^2)^(1/4),   C = rated_flow / sqrt(rated_drop),
///
/// sqrt(dp) far above the laminar drop and linear far below. A spool at u > 0 joins the pump with the full
/// side and the rod side with the tank, at u < 0 the other way round. A load-holding valve lets oil in
/// freely, and out with the share x of its conductance:
///
///   x = 3 y^2 - 2 y^3,   y = (p + pilot_ratio p_other - opening) / range within 0 and 1,
///
/// in series with the edge: 1 / C^2 = 1 / C_edge^2 + 1 / C_valve^2, no volume between.
struct HydraulicValve {
  HydraulicValveDescription d;
  std::array<double, 2> edge{}, relief_pressure{}, holding_pressure{};  // m3/s/sqrt(Pa), Pa; 0: none
  double relief_slope = 0.0;                                            // m3/s/Pa
  double holding = 0.0, makeup = 0.0;                                   // m3/s/sqrt(Pa)

  static void check(const HydraulicValveDescription& d, const Check& c) {
    if (d.rated_flow == 0.0 && d.rated_flow_rod > 0.0) {
      c.fail("has a rated_flow_rod and no rated_flow; give rated_flow, m3/s at rated_drop");
    }
    if (d.rated_flow > 0.0 && d.pump_pressure == 0.0) {
      c.fail("has a spool and no pump; give pump_pressure, such as 25e6 Pa, or leave rated_flow out");
    }
    if (d.pump_pressure > 0.0 && !(d.pump_pressure > d.tank_pressure)) {
      c.fail("pump_pressure is " + to_text(d.pump_pressure) + " Pa, not above the tank's " +
             to_text(d.tank_pressure) + " Pa; make it larger, or leave it out");
    }
    check_pair(c, "relief_pressure", d.relief_pressure + d.relief_pressure_rod, "relief_flow", d.relief_flow);
    check_pair(c, "counterbalance_pressure", d.counterbalance_pressure + d.counterbalance_pressure_rod,
               "counterbalance_flow", d.counterbalance_flow);
  }

  static HydraulicValve compile(const HydraulicValveDescription& d) {
    const double root = std::sqrt(d.rated_drop);
    return {d,
            {d.rated_flow / root, (d.rated_flow_rod > 0.0 ? d.rated_flow_rod : d.rated_flow) / root},
            {d.relief_pressure, d.relief_pressure_rod},
            {d.counterbalance_pressure, d.counterbalance_pressure_rod},
            d.relief_flow / d.relief_override,
            d.counterbalance_flow / root,
            d.makeup_flow / root};
  }

  /// Through an orifice of conductance 1.
  template <class T>
  T through(const T& drop) const {
    using std::sqrt;
    return drop / sqrt(T(sqrt(T(drop * drop + T(d.laminar_drop * d.laminar_drop)))));
  }
  template <class T>
  static T in_series(const T& first, const T& second) {
    using std::sqrt;
    const T square = first * first + second * second;
    return first * second / sqrt(select(square > T(kClosed), square, T(kClosed)));
  }

  /// What a side's edges do at a spool position.
  template <class T>
  struct Port {
    T conductance, source;
    bool to_pump;
  };
  template <class T>
  Port<T> port(std::size_t side, const T& spool) const {
    const T in = side == 0 ? spool : T(-spool), out = -in;
    const bool to_pump = in > T(0);
    const T travel = select(to_pump, in, out) - T(d.overlap);
    const T open = select(travel > T(0), T(travel / T(1.0 - d.overlap)), T(0));
    return {T(edge[side]) * open, select(to_pump, T(d.pump_pressure), T(d.tank_pressure)), to_pump};
  }
  bool holds(std::size_t side) const { return holding_pressure[side] > 0.0; }
  /// x times the conductance of the load-holding valve.
  template <class T>
  T held(std::size_t side, const T& pressure, const T& other) const {
    const T raw =
        (pressure + T(d.pilot_ratio) * other - T(holding_pressure[side])) / T(d.counterbalance_range);
    const T y = clamped(raw, T(0), T(1));
    return T(holding) * y * y * (T(3) - T(2) * y);
  }
  /// Into the side through its port.
  template <class T>
  T inflow(std::size_t side, const Port<T>& at, const T& pressure, const T& other) const {
    const T drop = at.source - pressure;
    const T back = holds(side) ? in_series(at.conductance, held(side, pressure, other)) : at.conductance;
    const T out = select(d.pump_check && at.to_pump, T(0), back);
    return select(drop > T(0), at.conductance, out) * through(drop);
  }
  /// Out of the side through its relief valve.
  template <class T>
  T relieved(std::size_t side, const T& pressure) const {
    if (relief_pressure[side] == 0.0) return T(0);
    const T over = pressure - T(relief_pressure[side]);
    return select(over > T(0), T(T(relief_slope) * over), T(0));
  }
  /// From the tank through the check valves.
  template <class T>
  T made_up(const T& pressure) const {
    if (makeup == 0.0) return T(0);
    const T drop = T(d.tank_pressure) - pressure;
    return select(drop > T(0), T(T(makeup) * through(drop)), T(0));
  }

 private:
  static constexpr double kClosed = 1e-60;  // of a conductance's square: below, it is none

  static void check_pair(const Check& c, const char* what, double pressure, const char* flow, double given) {
    if ((pressure > 0.0) == (given > 0.0)) return;
    c.fail(std::string("has ") + (pressure > 0.0 ? what : flow) + " without " +
           (pressure > 0.0 ? flow : what) + "; give both, or neither");
  }
};

}  // namespace seacrane
