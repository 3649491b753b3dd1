#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/hydraulic_control.hpp"
#include "seacrane/elements/loads/hydraulic_oil.hpp"
#include "seacrane/elements/loads/hydraulic_valve.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/dual.hpp"
#include "seacrane/math/power.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct HydraulicCylinderDescription : HydraulicOilDescription,
                                      HydraulicValveDescription,
                                      HydraulicControlDescription {
  std::string name, first, second;
  Vec3d first_point = Vec3d::Zero(), second_point = Vec3d::Zero();
  double full_area = 0.0, rod_side_area = 0.0, retracted_length = 0.0, stroke = 0.0;
  double pressure = 0.0, pressure_rod = 0.0;
  double hose_volume = 0.0, hose_volume_rod = 0.0;
  double internal_leakage = 0.0, external_leakage = 0.0;
  double viscous_friction = 0.0, friction = 0.0, friction_speed = 0.01;
  double stop_stiffness = 1e9;
  double accumulator_volume = 0.0, accumulator_pressure = 0.0, accumulator_flow = 0.0,
         accumulator_exponent = 1.4;
  double rupture_time = kFarthest, rupture_area = 0.0, discharge_coefficient = 0.6, oil_density = 870.0;
  bool rod_side_ruptures = false, refuse_void = false;

  static constexpr const char* type = "HydraulicCylinder";
  static constexpr const char* text =
      "A hydraulic cylinder between two body-fixed points, with the pressures of its chambers and its "
      "valves; "
      "see Scene.add_hydraulic_cylinder.";
  static constexpr auto fields() {
    using D = HydraulicCylinderDescription;
    return std::tuple_cat(
        std::tuple(
            on_body("first", &D::first), on_body("second", &D::second),
            optional("first_point", &D::first_point, "m", "coordinates of the first body"),
            optional("second_point", &D::second_point, "m", "coordinates of the second body"),
            required("full_area", &D::full_area, "m2", "of the piston, full side").usually(1e-4, 3.0),
            required("rod_side_area", &D::rod_side_area, "m2", "of the piston less the rod")
                .usually(1e-4, 3.0),
            required("retracted_length", &D::retracted_length, "m", "between the points at stroke 0")
                .usually(0.02, 100.0),
            required("stroke", &D::stroke, "m", "largest").usually(0.01, 100.0),
            required("pressure", &D::pressure, "Pa", "of the full side at the start, absolute")
                .usually(0.0, 2e8),
            required("pressure_rod", &D::pressure_rod, "Pa", "of the rod side, likewise").usually(0.0, 2e8),
            required("hose_volume", &D::hose_volume, "m3",
                     "of the full side: hose and what the stroke leaves"),
            required("hose_volume_rod", &D::hose_volume_rod, "m3", "of the rod side, likewise")),
        HydraulicOilDescription::fields(), HydraulicValveDescription::fields(),
        HydraulicControlDescription::fields(),
        std::tuple(
            optional("internal_leakage", &D::internal_leakage, "m3/s/Pa", "past the piston")
                .usually(0.0, 1e-9),
            optional("external_leakage", &D::external_leakage, "m3/s/Pa", "from each side to the tank")
                .usually(0.0, 1e-9),
            optional("viscous_friction", &D::viscous_friction, "N s/m", "of the seals"),
            optional("friction", &D::friction, "N", "of the seals, dry"),
            optional("friction_speed", &D::friction_speed, "m/s", "about which dry friction changes its sign")
                .usually(1e-4, 1.0),
            optional("stop_stiffness", &D::stop_stiffness, "N/m", "of the ends of the stroke"),
            optional("accumulator_volume", &D::accumulator_volume, "m3",
                     "of gas, without oil, in an accumulator on the full side; 0: none"),
            optional("accumulator_pressure", &D::accumulator_pressure, "Pa", "of its gas without oil")
                .usually(9e4, 2e8),
            optional("accumulator_flow", &D::accumulator_flow, "m3/s",
                     "through its throttle at `rated_drop`"),
            optional("accumulator_exponent", &D::accumulator_exponent, "", "of its gas: p V^exponent stays")
                .usually(0.9, 3.0),
            optional("rupture_time", &D::rupture_time, "s", "at which a hose bursts; at 1e7 none does"),
            optional("rupture_area", &D::rupture_area, "m2", "of the hole"),
            optional("rod_side_ruptures", &D::rod_side_ruptures, "", "in place of the full side"),
            optional("discharge_coefficient", &D::discharge_coefficient, "", "of the hole")
                .usually(0.05, 1.5),
            optional("oil_density", &D::oil_density, "kg/m3", "that leaves through the hole")
                .usually(300.0, 3000.0),
            optional("refuse_void", &D::refuse_void, "", "whether a run ends where oil boils")));
  }
};

/// A cylinder of stroke s, the distance of its points less the retracted length. It pushes with
///
///   F = p0 A0 - p1 A1 - (viscous s' + friction tanh(s' / speed)) + stops,
///
/// side 0 being the full and 1 the rod side, whose swept volumes are A0 s and A1 (stroke - s). States: p0,
/// p1, the spool u with u' = (asked - u) / lag unless it has no lag, and the gas volume of an accumulator.
/// All pressures are absolute.
///
/// At its vapour pressure pv oil boils, and a void of volume V opens: V' = A s' - Q at pv. Below pv the state
/// p tells that volume, V = c (pv - p), c being the compliance at mid-stroke, and the pressure is pv. Oil
/// that has become void has given its enthalpy: the chamber's energy is that at pv less h(pv) V.
///
/// A hole of area a passes discharge a sqrt(2 / density) times the orifice's flow, out of the side. Behind a
/// load-holding valve the hose is at the atmosphere then, and the hole in series with that valve.
struct HydraulicCylinder {
  static constexpr const char* kind = "hydraulic cylinder";
  static constexpr const char* follows_as = "actuator";
  using Description = HydraulicCylinderDescription;
  /// Where power enters and is lost: pump and tank give positive, all others take, negative.
  static constexpr std::array<const char*, 9> kPowers = {
      "pump", "tank", "valve", "relief", "makeup", "leakage", "accumulator", "rupture", "friction"};
  enum Power { pump, tank, edges, relief, makeup, leakage, throttle, rupture, seals };

  std::string name;
  int first = 0, second = 0;
  Vec3d first_point, second_point;  // from the state points, body axes
  std::array<double, 2> area{}, hose_volume{};
  double retracted = 0.0, longest = 0.0;
  HydraulicOil oil;
  HydraulicValve valve;
  HydraulicControl control;
  double spool_lag = 1.0, vapour = 0.0;
  std::array<double, 2> void_compliance{};  // m3/Pa, c
  bool refuse_void = false;
  double internal_leakage = 0.0, external_leakage = 0.0;
  double viscous = 0.0, friction = 0.0, friction_speed = 1.0, stop_stiffness = 0.0;
  double gas_volume = 0.0, gas_pressure = 0.0, gas_exponent = 1.0, gas_conductance = 0.0;
  Curve burst;  // share of the hole that is open
  double hole = 0.0;
  std::size_t bursting = 0;
  StateRange states;
  int gas = -1;                                 // its volume among the states; none: no accumulator
  double quickness = 0.0, bursting_jump = 0.0;  // N/s3, or N/s2 without a lag, for a spool; N/s

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.body(c, d.first, true);
    names.body(c, d.second, true);
    if (d.first == d.second) c.fail("joins '" + d.first + "' to itself; name two different bodies");
    c.near("first_point", d.first_point);
    c.near("second_point", d.second_point);
    names.input(c, kind, d.name);
    positive(c, {{"full_area", d.full_area},
                 {"rod_side_area", d.rod_side_area},
                 {"retracted_length", d.retracted_length},
                 {"stroke", d.stroke},
                 {"pressure", d.pressure},
                 {"pressure_rod", d.pressure_rod},
                 {"friction_speed", d.friction_speed},
                 {"stop_stiffness", d.stop_stiffness},
                 {"accumulator_exponent", d.accumulator_exponent},
                 {"discharge_coefficient", d.discharge_coefficient},
                 {"oil_density", d.oil_density}});
    for (const auto& [what, value] :
         {std::pair{"internal_leakage", d.internal_leakage},
          std::pair{"external_leakage", d.external_leakage},
          std::pair{"viscous_friction", d.viscous_friction}, std::pair{"friction", d.friction}}) {
      c.not_negative(what, value);
    }
    HydraulicOil::check(d, c);
    for (const auto& [what, value] :
         {std::pair{"pressure", d.pressure}, std::pair{"pressure_rod", d.pressure_rod}}) {
      if (value >= d.vapour_pressure) continue;
      c.fail(std::string(what) + " is " + to_text(value) + " Pa, below the vapour_pressure of " +
             to_text(d.vapour_pressure) + " Pa, where oil boils; pressures are absolute: give more");
    }
    HydraulicValve::check(d, c);
    HydraulicControl::check(d, d.rated_flow, c);
    check_volumes(d, c);
    check_reliefs(d, c);
    check_accumulator(d, c);
    check_rupture(d, c);
  }

  static Description example() {
    Description d;
    d.name = "load";
    d.first = "first";
    d.second = "second";
    d.first_point = {2.0, 0.5, -1.0};
    d.full_area = 0.8;
    d.rod_side_area = 0.5;
    d.retracted_length = 1.4;
    d.stroke = 3.0;
    d.pressure = 12.0;
    d.pressure_rod = 15.0;
    d.hose_volume = 0.3;
    d.hose_volume_rod = 0.4;
    d.oil_modulus = 90.0;
    d.hose_modulus = 50.0;
    d.cylinder_modulus = 400.0;
    d.vapour_pressure = 0.1;
    d.pump_pressure = 30.0;
    d.tank_pressure = 1.0;
    d.rated_flow = 0.3;
    d.rated_drop = 5.0;
    d.laminar_drop = 2.0;
    d.overlap = 0.1;
    d.spool_lag = 0.3;
    d.command = Curve::constant(0.4);
    d.reference = Curve::quintic(0.0, 2.0, 1.0, 1.5);
    d.gain = 0.2;
    d.rate_gain = 0.1;
    d.relief_pressure = 30.0;
    d.relief_pressure_rod = 15.02;
    d.relief_flow = 0.2;
    d.relief_override = 2.0;
    d.counterbalance_pressure_rod = 20.0;
    d.counterbalance_flow = 0.4;
    d.counterbalance_range = 30.0;
    d.pilot_ratio = 2.0;
    d.internal_leakage = 0.01;
    d.external_leakage = 0.005;
    d.viscous_friction = 0.4;
    d.friction = 0.3;
    d.friction_speed = 0.5;
    d.accumulator_volume = 2.0;
    d.accumulator_pressure = 8.0;
    d.accumulator_flow = 0.5;
    d.rupture_time = 0.5;
    d.rupture_area = 0.1;
    d.oil_density = 1.5;
    return d;
  }

  template <class Context>
  static HydraulicCylinder compile(const Description& d, Context& context) {
    const Attachment a = context.attach(d.first, d.first_point), b = context.attach(d.second, d.second_point);
    HydraulicCylinder out;
    out.name = d.name;
    out.first = a.body;
    out.second = b.body;
    out.first_point = a.point;
    out.second_point = b.point;
    out.area = {d.full_area, d.rod_side_area};
    out.hose_volume = {d.hose_volume, d.hose_volume_rod};
    out.retracted = d.retracted_length;
    out.longest = d.stroke;
    out.oil = HydraulicOil::compile(d);
    out.valve = HydraulicValve::compile(d);
    out.control.take(d, d.name, context);
    out.control.follows = context.followed(kind, d.name);
    out.spool_lag = d.spool_lag;
    out.vapour = d.vapour_pressure;
    for (std::size_t side = 0; side < 2; ++side) {
      out.void_compliance[side] =
          out.oil.compliance(out.vapour, 0.5 * out.longest * out.area[side], out.hose_volume[side]);
    }
    out.refuse_void = d.refuse_void;
    out.internal_leakage = d.internal_leakage;
    out.external_leakage = d.external_leakage;
    out.viscous = d.viscous_friction;
    out.friction = d.friction;
    out.friction_speed = d.friction_speed;
    out.stop_stiffness = d.stop_stiffness;
    out.gas_volume = d.accumulator_volume;
    out.gas_pressure = d.accumulator_pressure;
    out.gas_exponent = d.accumulator_exponent;
    out.gas_conductance = d.accumulator_flow / std::sqrt(d.rated_drop);
    if (d.rupture_time < kFarthest) {
      out.burst = Curve::constant(0.0).then(d.rupture_time, Curve::constant(1.0));
      out.hole = d.discharge_coefficient * d.rupture_area * std::sqrt(2.0 / d.oil_density);
      out.bursting = d.rod_side_ruptures ? 1 : 0;
    }
    out.add_states(d, context);
    out.measure_kinks(d);
    return out;
  }

  std::vector<LoadKinks> kinks() const {
    std::vector<LoadKinks> out = control.kinks(quickness, spool_lag > 0.0 ? 2 : 1);
    LoadKinks& opening = out.emplace_back();
    for (const CurveKink& kink : burst.kinks()) {
      opening.push_back({kink.time, Eigen::Matrix<double, 1, 4>::Zero()});
      opening.back().jump(0, 2) = bursting_jump;
    }
    return out;
  }
  void add_unit(int /*component*/, const LoadInput<double>& in, Vec6d* wrenches) const {
    const Motion<double> m = motion(in);
    const auto put = [&](int body, const Vec3d& lever, const Vec3d& force) {
      wrenches[body].head<3>() += force;
      wrenches[body].tail<3>() += lever.cross(force);
    };
    put(first, m.lever_first, -m.along);
    put(second, m.lever_second, m.along);
  }

  std::array<int, 3> bodies() const {
    return {control.follows.any() ? control.follows.signal.body : first, first, second};
  }
  StateRange followed() const { return control.follows.signal.states; }

  /// What it does at an instant. Flows are m3/s, powers W as in kPowers.
  template <class T>
  struct Motion {
    Vec3<T> along, lever_first, lever_second;
    T stroke, rate, force, spool, asked;
    std::array<T, 2> pressure, pressure_rate, swept, voids;
    std::array<T, 2> port, net;  // into the sides through their ports, and in all
    T pumped, returned, spilled, from_gas;
    std::array<T, kPowers.size()> power;
  };

  template <class T>
  Motion<T> motion(const LoadInput<T>& in) const {
    Motion<T> m = place(in);
    act(in.time, in.curve_limit, gas_volume > 0.0 ? in.states[gas] : T(0), m);
    return m;
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Motion<T> m = motion(in);
    const Vec3<T> push = m.along * m.force, back = -push;
    out.wrench[second].add(push, m.lever_second);
    out.wrench[first].add(back, m.lever_first);
    for (const T& p : m.power) out.add_power(p);
    T* rates = out.state_rates + states.first;
    rates[0] = m.pressure_rate[0];
    rates[1] = m.pressure_rate[1];
    if (spool_lag > 0.0) rates[2] = spool_rate(m);
    if (gas_volume > 0.0) out.state_rates[gas] = m.from_gas;
  }

  /// All of them: pressures, the spool where it has a lag, and the gas of an accumulator.
  StateRange stiff_states() const { return states; }
  StiffSlopes stiff_slopes(const LoadInput<double>& in) const {
    using S = Dual<5>;
    const Motion<double> here = place(in);
    Motion<S> m;
    m.stroke = here.stroke;
    m.asked = here.asked;
    m.rate = S::variable(here.rate, 0);
    for (std::size_t side = 0; side < 2; ++side) {
      m.swept[side] = here.swept[side];
      m.voids[side] = here.voids[side];
      m.pressure[side] = here.voids[side] > 0.0
                             ? S(here.pressure[side])
                             : S::variable(here.pressure[side], 1 + static_cast<int>(side));
    }
    m.spool = spool_lag > 0.0 ? S::variable(here.spool, 3) : S(here.spool);
    const int last = states.count;
    act(in.time, in.curve_limit, gas_volume > 0.0 ? S::variable(in.states[gas], last) : S(), m);
    std::array<S, 5> rows = {m.force, m.pressure_rate[0], m.pressure_rate[1]};
    if (spool_lag > 0.0) rows[3] = spool_rate(m);
    if (gas_volume > 0.0) rows[idx(last)] = m.from_gas;
    StiffSlopes out(last + 1, last + 1);
    for (int i = 0; i <= last; ++i) {
      for (int j = 0; j <= last; ++j) out(i, j) = rows[idx(i)].slope[idx(j)];
    }
    return out;
  }

  /// The energy stored in oil, ends of the stroke and gas.
  double potential(const LoadInput<double>& in) const {
    const Motion<double> m = place(in);
    const double depth = beyond(m.stroke);
    double sum = 0.5 * stop_stiffness * depth * depth;
    for (std::size_t side = 0; side < 2; ++side) {
      sum += oil.energy(m.pressure[side], m.swept[side], hose_volume[side]) -
             m.voids[side] * oil.enthalpy(m.pressure[side]);
    }
    if (gas_volume == 0.0) return sum;
    const double bounded = std::max(in.states[gas], kLeastGas * gas_volume), ratio = gas_volume / bounded;
    const double work = gas_exponent == 1.0
                            ? std::log(ratio)
                            : std::expm1((gas_exponent - 1.0) * std::log(ratio)) / (gas_exponent - 1.0);
    const double further = std::pow(ratio, gas_exponent) * (bounded - in.states[gas]);
    return sum + gas_pressure * (gas_volume * work + further);
  }

  static bool has_sides() { return true; }
  /// A bit for each margin that is positive.
  int side(const LoadInput<double>& in) const {
    const Margins now = margins(in);
    int out = 0;
    for (std::size_t i = 0; i < now.size(); ++i) out |= now[i] > 0.0 ? 1 << i : 0;
    return out;
  }
  /// The least of the margins that change, positive on the first side.
  double across(const LoadInput<double>& in, int from, int to) const {
    const Margins now = margins(in);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (((from ^ to) >> i & 1) != 0) least = std::min(least, (from >> i & 1) != 0 ? now[i] : -now[i]);
    }
    return least;
  }
  /// The bounds that are reached by a change of the side, such as "main.relief".
  std::vector<std::string> reached(int from, int to) const {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < kBounds.size(); ++i) {
      if ((from & ~to) >> i & 1) out.push_back(name + "." + kBounds[i]);
    }
    return out;
  }

  /// Why a run cannot go on at a side; empty: it can.
  std::string refused(int at) const {
    for (int side = 0; refuse_void && side < 2; ++side) {
      if ((at >> (2 + side) & 1) != 0) continue;
      return "hydraulic cylinder '" + name + "': its oil boils on the " + (side == 0 ? "full" : "rod") +
             " side, and refuse_void is set; give makeup_flow, a higher tank_pressure or a slower motion, "
             "or leave refuse_void out, and a void opens";
    }
    return "";
  }

 private:
  /// Named margins, each of a bound that is reached where it turns negative; the others follow.
  static constexpr std::array<const char*, 7> kBounds = {
      "relief", "relief_rod", "vapour", "vapour_rod", "retracted", "extended", "accumulator"};
  static constexpr std::size_t kKinks = kBounds.size() + 8;
  using Margins = std::array<double, kKinks>;
  /// 1/m: over the scale of lengths, of the highest pressure; with air of the pressure itself, as the volume
  /// of a gas is told by no less.
  static constexpr double kPressureScale = 10.0;
  static constexpr double kLeastResolved = 1e3;  // Pa: of a lower pressure errors count over this one

  using Values = std::initializer_list<std::pair<const char*, double>>;
  static void positive(const Check& c, Values values) {
    for (const auto& [what, value] : values) {
      c.finite(what, value);
      if (!(value > 0.0)) c.fail(std::string(what) + " is " + to_text(value) + "; it must be positive");
    }
  }

  static void check_volumes(const Description& d, const Check& c) {
    const double bore = std::sqrt(4.0 * d.full_area / std::numbers::pi);
    if (bore > d.retracted_length) {
      c.fail("full_area is " + to_text(d.full_area) + " m2, of a piston " + to_text(bore) +
             " m wide in a cylinder of " + to_text(d.retracted_length) + " m; give m2");
    }
    if (!(d.rod_side_area <= d.full_area)) {
      c.fail("rod_side_area is " + to_text(d.rod_side_area) + " m2, more than the full side's " +
             to_text(d.full_area) + " m2; give the piston's area less the rod's");
    }
    for (const auto& [what, volume, swept] :
         {std::tuple{"hose_volume", d.hose_volume, d.full_area * d.stroke},
          std::tuple{"hose_volume_rod", d.hose_volume_rod, d.rod_side_area * d.stroke}}) {
      c.finite(what, volume);
      if (volume >= kLeastVolume * swept) continue;
      c.fail(std::string(what) + " is " + to_text(volume) +
             " m3, and at an end of the stroke no oil is left: "
             "its pressure would have no rate; give " +
             to_text(kLeastVolume * swept) + " m3 or more");
    }
  }
  static void check_reliefs(const Description& d, const Check& c) {
    for (const auto& [what, opening, start] :
         {std::tuple{"relief_pressure", d.relief_pressure, d.pressure},
          std::tuple{"relief_pressure_rod", d.relief_pressure_rod, d.pressure_rod}}) {
      if (opening == 0.0 || opening > start) continue;
      c.fail(std::string(what) + " is " + to_text(opening) + " Pa, below the holding pressure of " +
             to_text(start) + " Pa: it could not hold its load; give a higher one");
    }
  }
  static void check_accumulator(const Description& d, const Check& c) {
    for (const auto& [what, value] : {std::pair{"accumulator_volume", d.accumulator_volume},
                                      std::pair{"accumulator_pressure", d.accumulator_pressure},
                                      std::pair{"accumulator_flow", d.accumulator_flow}}) {
      c.not_negative(what, value);
      if ((value > 0.0) == (d.accumulator_volume > 0.0)) continue;
      c.fail(std::string(what) + " is " + to_text(value) + " and accumulator_volume is " +
             to_text(d.accumulator_volume) +
             "; give accumulator_volume, accumulator_pressure and accumulator_flow, or none of them");
    }
    if (d.accumulator_volume > 0.0 && d.accumulator_pressure > d.pressure) {
      c.fail("accumulator_pressure is " + to_text(d.accumulator_pressure) +
             " Pa, above the holding pressure of " + to_text(d.pressure) +
             " Pa: it would be empty; give a lower one");
    }
    if (d.accumulator_volume == 0.0) return;
    const double left = std::pow(d.accumulator_pressure / d.pressure, 1.0 / d.accumulator_exponent);
    if (left >= kLeastCharge) return;
    c.fail("accumulator_pressure is " + to_text(d.accumulator_pressure) + " Pa: the holding pressure of " +
           to_text(d.pressure) + " Pa would squeeze its gas to " + to_text(left) +
           " of its volume; give more, in Pa: 1 bar is 1e5");
  }
  static void check_rupture(const Description& d, const Check& c) {
    c.finite("rupture_time", d.rupture_time);
    c.not_negative("rupture_area", d.rupture_area);
    if ((d.rupture_time < kFarthest) == (d.rupture_area > 0.0)) return;
    c.fail("rupture_time is " + to_text(d.rupture_time) + " s and rupture_area " + to_text(d.rupture_area) +
           " m2; give both, or neither");
  }
  static constexpr double kLeastVolume = 1e-4;  // of the swept volume
  static constexpr double kLeastCharge = 0.01;  // of the gas volume, at the start

  template <class Context>
  void add_states(const Description& d, Context& context) {
    const double most = std::max({d.pump_pressure, d.pressure, d.pressure_rod});
    const double scale = kPressureScale * context.length_scale();
    LoadState full{name + ".pressure", "Pa", d.pressure, scale * most};
    LoadState rod{name + ".pressure_rod", "Pa", d.pressure_rod, scale * most};
    if (oil.air > 0.0) {
      for (LoadState* one : {&full, &rod}) {
        one->scale = scale * std::max(vapour, kLeastResolved);
        one->growth = scale;
      }
    }
    states = {context.state(std::move(full)), 2};
    context.state(std::move(rod));
    if (spool_lag > 0.0) {
      context.state({name + ".spool", "", clamped(d.command.at(0.0).value, -1.0, 1.0), scale});
      ++states.count;
    }
    if (gas_volume == 0.0) return;
    const double start = gas_volume * std::pow(gas_pressure / d.pressure, 1.0 / gas_exponent);
    gas = context.state({name + ".gas_volume", "m3", start, context.length_scale() * area[0]});
    ++states.count;
  }

  /// What a jump of the spool's command, and the hole's opening, do to the force at mid-stroke.
  void measure_kinks(const Description& d) {
    for (std::size_t side = 0; side < 2; ++side) {
      const double p = side == 0 ? d.pressure : d.pressure_rod;
      const double gives = oil.compliance(p, 0.5 * longest * area[side], hose_volume[side]);
      quickness +=
          area[side] / gives * valve.edge[side] * std::sqrt(valve.pump) / (spool_lag > 0.0 ? spool_lag : 1.0);
      if (side == bursting) bursting_jump = area[side] / gives * hole * valve.through(p);
    }
  }

  /// Place, motion and pressures.
  template <class T>
  Motion<T> place(const LoadInput<T>& in) const {
    using std::sqrt;
    const auto &ka = in.bodies[first], &kb = in.bodies[second];
    Motion<T> m;
    m.lever_first = ka.rotation * first_point.cast<T>();
    m.lever_second = kb.rotation * second_point.cast<T>();
    const Vec3<T> d = kb.position + m.lever_second - ka.position - m.lever_first;
    const T length = sqrt(d.dot(d));
    m.along = d / length;
    m.rate = m.along.dot(kb.velocity + cross<T>(kb.angular_velocity, m.lever_second) - ka.velocity -
                         cross<T>(ka.angular_velocity, m.lever_first));
    m.stroke = length - T(retracted);
    m.asked = control.asked(in, m.stroke);
    m.spool = spool_lag > 0.0 ? in.states[states.first + 2] : clamped(m.asked, T(-1), T(1));
    m.swept = {T(area[0]) * m.stroke, T(area[1]) * (T(longest) - m.stroke)};
    for (std::size_t side = 0; side < 2; ++side) {
      const T& state = in.states[states.first + static_cast<int>(side)];
      const T below = T(vapour) - state;
      const bool boils = below > T(0);
      m.pressure[side] = select(boils, T(vapour), state);
      m.voids[side] = select(boils, T(T(void_compliance[side]) * below), T(0));
    }
    return m;
  }

  /// Flows, powers, force and rates of the pressures for a place, a motion, pressures and a spool.
  template <class T>
  void act(double time, double limit, const T& gas_now, Motion<T>& m) const {
    using std::tanh;
    m.power.fill(T(0));
    m.pumped = m.returned = m.spilled = m.from_gas = T(0);
    const std::array<T, 2> h = {oil.enthalpy(m.pressure[0]), oil.enthalpy(m.pressure[1])};
    for (std::size_t side = 0; side < 2; ++side) flow(time, limit, side, h, m);
    const T past = T(internal_leakage) * (m.pressure[0] - m.pressure[1]);
    m.net[0] -= past;
    m.net[1] += past;
    m.power[leakage] -= past * (h[0] - h[1]);
    if (gas_volume > 0.0) charge(gas_now, h[0], m);
    m.power[pump] = T(valve.pump - valve.tank) * m.pumped;
    m.power[tank] = T(valve.tank) * (m.pumped - m.returned);
    T drag = T(viscous) * m.rate;
    if (friction > 0.0) drag += T(friction) * tanh(T(m.rate / T(friction_speed)));
    m.power[seals] = -drag * m.rate;
    for (std::size_t side = 0; side < 2; ++side) {
      const T swept_rate = T(side == 0 ? area[0] : -area[1]) * m.rate;
      const T gives = oil.compliance(m.pressure[side], m.swept[side], hose_volume[side]);
      m.pressure_rate[side] =
          (m.net[side] - swept_rate) / select(m.voids[side] > T(0), T(void_compliance[side]), gives);
    }
    m.force =
        T(area[0]) * m.pressure[0] - T(area[1]) * m.pressure[1] - drag - T(stop_stiffness) * beyond(m.stroke);
  }
  template <class T>
  T spool_rate(const Motion<T>& m) const {
    return (clamped(m.asked, T(-1), T(1)) - m.spool) / T(spool_lag);
  }

  /// The flow into a side, but for what passes the piston.
  template <class T>
  void flow(double time, double limit, std::size_t side, const std::array<T, 2>& h, Motion<T>& m) const {
    const T &p = m.pressure[side], &other = m.pressure[1 - side];
    const auto port = valve.port(side, m.spool);
    const double open = hole > 0.0 && side == bursting ? burst.at(time, limit).value : 0.0;
    const double whole = valve.holds(side) ? 1.0 - open : 1.0;  // share of the port that leads to the side
    m.port[side] = T(whole) * valve.inflow(side, port, p, other);
    m.power[edges] -= m.port[side] * (port.source - h[side]);
    m.pumped += select(port.to_pump, m.port[side], T(0));
    m.returned -= select(port.to_pump, T(0), m.port[side]);
    m.net[side] = m.port[side];
    if (open > 0.0) spill(side, open, port, h[side], m);

    const T relieved = valve.relieved(side, p), drained = T(external_leakage) * (p - T(valve.tank));
    const T made_up = valve.made_up(p);
    m.power[relief] -= relieved * (h[side] - T(valve.tank));
    m.power[leakage] -= drained * (h[side] - T(valve.tank));
    m.power[makeup] -= made_up * (T(valve.tank) - h[side]);
    m.returned += relieved + drained - made_up;
    m.net[side] += made_up - relieved - drained;
  }

  /// Through the hole, and of the pump's into the open hose.
  template <class T>
  void spill(std::size_t side, double open, const HydraulicValve::Port<T>& port, const T& h,
             Motion<T>& m) const {
    const T& p = m.pressure[side];
    const T drop = p - T(kAtmosphere);
    T conductance(hole * open);
    if (valve.holds(side)) {
      conductance = HydraulicValve::in_series(conductance, valve.held(side, p, m.pressure[1 - side]));
      const T lost = select(
          port.to_pump, T(T(open) * port.conductance * valve.through(T(port.source - T(kAtmosphere)))), T(0));
      m.pumped += lost;
      m.spilled += lost;
      m.power[rupture] -= lost * port.source;
    }
    const T out = select(drop > T(0), T(conductance * valve.through(drop)), T(0));
    m.spilled += out;
    m.net[side] -= out;
    m.power[rupture] -= out * h;
  }

  /// Between the accumulator and the full side; an empty one gives none.
  template <class T>
  void charge(const T& volume, const T& h, Motion<T>& m) const {
    const T least(kLeastGas * gas_volume), bounded = select(volume > least, volume, least);
    const T p = T(gas_pressure) * power(T(T(gas_volume) / bounded), gas_exponent);
    const T q = T(gas_conductance) * valve.through(T(p - m.pressure[0]));
    m.from_gas = select(volume > T(gas_volume) && q > T(0), T(0), q);
    m.net[0] += m.from_gas;
    m.power[throttle] = -m.from_gas * (p - h);
  }
  static constexpr double kLeastGas = 1e-3;  // of the whole volume

  /// How far the stroke is beyond an end: positive when extended.
  template <class T>
  T beyond(const T& s) const {
    return select(s > T(longest), T(s - T(longest)), select(s < T(0), s, T(0)));
  }

  Margins margins(const LoadInput<double>& in) const {
    const Motion<double> m = place(in);
    Margins out;
    out.fill(1.0);
    for (std::size_t side = 0; side < 2; ++side) {
      const double p = m.pressure[side], opening = valve.relief_pressure[side];
      if (opening > 0.0) out[side] = opening - p;
      out[2 + side] = in.states[states.first + static_cast<int>(side)] - vapour;
      if (valve.makeup > 0.0) out[kBounds.size() + side] = p - valve.tank;
    }
    out[4] = m.stroke;
    out[5] = longest - m.stroke;
    if (gas_volume > 0.0) out[6] = gas_volume - in.states[gas];
    if (valve.edge[0] == 0.0) return out;
    double* rest = out.data() + kBounds.size() + 2;
    rest[0] = m.spool - valve.overlap;
    rest[1] = -m.spool - valve.overlap;
    rest[2] = 1.0 - m.asked;
    rest[3] = 1.0 + m.asked;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto port = valve.port(side, m.spool);
      const bool one_way = valve.holds(side) || (valve.pump_check && port.to_pump);
      if (one_way && port.conductance > 0.0) rest[4 + side] = port.source - m.pressure[side];
    }
    return out;
  }
};

}  // namespace seacrane
