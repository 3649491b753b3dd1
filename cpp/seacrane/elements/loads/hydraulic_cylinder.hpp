#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "seacrane/elements/loads/hydraulic_cylinder_description.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/math/dual.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

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
  static constexpr bool holds = true;
  static constexpr const char* drawn = "cylinder";
  static constexpr const char* follows_as = "actuator";
  using Description = HydraulicCylinderDescription;
  /// Where power enters and is lost: pump and tank give positive, all others take, negative.
  static constexpr std::array<const char*, 9> kPowers = {
      "pump", "tank", "valve", "relief", "makeup", "leakage", "accumulator", "rupture", "friction"};
  enum Power { pump, tank, edges, relief, makeup, leakage, throttle, rupture, seals };

  Description d;
  Span span;
  std::array<double, 2> area{}, hose_volume{};
  HydraulicOil oil;
  HydraulicValve valve;
  HydraulicControl control;
  std::array<double, 2> void_compliance{};  // m3/Pa, c
  double gas_conductance = 0.0;             // m3/s/sqrt(Pa)
  Curve burst;                              // share of the hole that is open
  double hole = 0.0;                        // m3/s/sqrt(Pa)
  std::size_t bursting = 0;
  StateRange states;
  int gas = -1;                                 // its volume among the states; none: no accumulator
  double quickness = 0.0, bursting_jump = 0.0;  // N/s3, or N/s2 without a lag, for a spool; N/s

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.input(c, kind, d.name);
    d.check(c, names);
  }
  static Description example() { return Description::example(); }

  template <class Context>
  static HydraulicCylinder compile(const Description& d, Context& context) {
    HydraulicCylinder out;
    out.d = d;
    out.span = Span::compile(d, context);
    out.area = {d.full_area, d.rod_side_area};
    out.hose_volume = {d.hose_volume, d.hose_volume_rod};
    out.oil = HydraulicOil::compile(d);
    out.valve = HydraulicValve::compile(d);
    out.control = HydraulicControl::compile(d, kind, d.name, context);
    for (std::size_t side = 0; side < 2; ++side)
      out.void_compliance[side] = out.compliance(side, d.vapour_pressure);
    out.gas_conductance = d.accumulator_flow / std::sqrt(d.rated_drop);
    if (d.rupture_time < kFarthest) {
      out.burst = Curve::constant(0.0).then(d.rupture_time, Curve::constant(1.0));
      out.hole = d.discharge_coefficient * d.rupture_area * std::sqrt(2.0 / d.oil_density);
      out.bursting = d.rod_side_ruptures ? 1 : 0;
    }
    out.add_states(context);
    out.measure_kinks();
    return out;
  }

  std::vector<LoadKinks> kinks() const {
    std::vector<LoadKinks> out = control.kinks(quickness, d.spool_lag > 0.0 ? 2 : 1);
    LoadKinks& opening = out.emplace_back();
    for (const CurveKink& kink : burst.kinks()) {
      opening.push_back({kink.time, Eigen::Matrix<double, 1, 4>::Zero()});
      opening.back().jump(0, 2) = bursting_jump;
    }
    return out;
  }
  void add_unit(int /*component*/, const LoadInput<double>& in, Vec6d* wrenches) const {
    span.pull(span.motion(in), -1.0, wrenches);
  }

  std::array<int, 3> bodies() const {
    return {control.follows.any() ? control.follows.signal.body : span.first, span.first, span.second};
  }
  StateRange followed() const { return control.follows.signal.states; }

  /// What it does at an instant. Flows are m3/s, powers W as in kPowers.
  template <class T>
  struct Motion : SpanMotion<T> {
    T stroke, force, spool, asked;
    std::array<T, 2> pressure, pressure_rate, swept, voids;
    std::array<T, 2> port, net;  // into the sides through their ports, and in all
    T pumped, returned, spilled, from_gas;
    std::array<T, kPowers.size()> power;
  };

  template <class T>
  Motion<T> motion(const LoadInput<T>& in) const {
    Motion<T> m = place(in);
    act(in.time, in.curve_limit, d.accumulator_volume > 0.0 ? in.states[gas] : T(0), m);
    return m;
  }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const Motion<T> m = motion(in);
    span.pull(m, T(-m.force), out);
    for (const T& p : m.power) out.add_power(p);
    T* rates = out.state_rates + states.first;
    rates[0] = m.pressure_rate[0];
    rates[1] = m.pressure_rate[1];
    if (d.spool_lag > 0.0) rates[2] = spool_rate(m);
    if (d.accumulator_volume > 0.0) out.state_rates[gas] = m.from_gas;
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
    m.spool = d.spool_lag > 0.0 ? S::variable(here.spool, 3) : S(here.spool);
    const int last = states.count;
    act(in.time, in.curve_limit, d.accumulator_volume > 0.0 ? S::variable(in.states[gas], last) : S(), m);
    std::array<S, 5> rows = {m.force, m.pressure_rate[0], m.pressure_rate[1]};
    if (d.spool_lag > 0.0) rows[3] = spool_rate(m);
    if (d.accumulator_volume > 0.0) rows[idx(last)] = m.from_gas;
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
    double sum = 0.5 * d.stop_stiffness * depth * depth;
    for (std::size_t side = 0; side < 2; ++side) {
      sum += oil.energy(m.pressure[side], m.swept[side], hose_volume[side]) -
             m.voids[side] * oil.enthalpy(m.pressure[side]);
    }
    if (d.accumulator_volume == 0.0) return sum;
    const double bounded = std::max(in.states[gas], kLeastGas * d.accumulator_volume),
                 ratio = d.accumulator_volume / bounded;
    const double work =
        d.accumulator_exponent == 1.0
            ? std::log(ratio)
            : std::expm1((d.accumulator_exponent - 1.0) * std::log(ratio)) / (d.accumulator_exponent - 1.0);
    const double further = std::pow(ratio, d.accumulator_exponent) * (bounded - in.states[gas]);
    return sum + d.accumulator_pressure * (d.accumulator_volume * work + further);
  }

  /// Its end stops.
  Sight look(const LoadInput<double>& in) const {
    const Side ends = side_of({kRetracted, kExtended}), now = margins(in).side();
    if ((now & ends).any()) return {.side = now};
    const SpanMotion<double> m = span.motion(in);
    const double stroke = m.length - d.retracted_length;
    return {.side = now,
            .watched = ends,
            .clear = std::max(0.0, std::min(stroke, d.stroke - stroke)),
            .pace = std::abs(m.rate),
            .at = {stroke, 0.0, 0.0}};
  }
  std::vector<std::string> reached(const Side& from, const Side& to) const {
    return bounds_met(d.name, kMargins, from, to);
  }

  /// Why a run cannot go on at a side; empty: it can.
  std::string refused(const Side& at) const {
    for (std::size_t side = 0; d.refuse_void && side < 2; ++side) {
      if (!at[kVapour + side]) continue;
      return "hydraulic cylinder '" + d.name + "': its oil boils on the " + (side == 0 ? "full" : "rod") +
             " side, and refuse_void is set; give makeup_flow, a higher tank_pressure or a slower motion, "
             "or leave refuse_void out, and a void opens";
    }
    return "";
  }

  Margins margins(const LoadInput<double>& in) const {
    const Motion<double> m = place(in);
    auto out = kMargins;
    for (std::size_t side = 0; side < 2; ++side) {
      const double p = m.pressure[side], opening = valve.relief_pressure[side];
      if (opening > 0.0) out[kRelief + side].value = opening - p;
      out[kVapour + side].value = in.states[states.first + static_cast<int>(side)] - d.vapour_pressure;
      if (valve.makeup > 0.0) out[kMakeup + side].value = p - d.tank_pressure;
    }
    out[kRetracted].value = m.stroke;
    out[kExtended].value = d.stroke - m.stroke;
    if (d.accumulator_volume > 0.0) out[kAccumulator].value = d.accumulator_volume - in.states[gas];
    if (valve.edge[0] == 0.0) return Margins(out);
    out[kEdges].value = m.spool - d.overlap;
    out[kEdges + 1].value = -m.spool - d.overlap;
    out[kSpool].value = 1.0 - m.asked;
    out[kSpool + 1].value = 1.0 + m.asked;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto port = valve.port(side, m.spool);
      const bool one_way = valve.holds(side) || (d.pump_check && port.to_pump);
      if (one_way && port.conductance > 0.0) out[kOneWay + side].value = port.source - m.pressure[side];
    }
    return Margins(out);
  }

 private:
  static constexpr std::size_t kRelief = 0, kVapour = 2, kRetracted = 4, kExtended = 5, kAccumulator = 6,
                               kMakeup = 7, kEdges = 9, kSpool = 11, kOneWay = 13;
  /// Of both sides, or both directions, where two follow each other.
  static constexpr std::array<Margin, 15> kMargins = {
      {{"relief"}, {"relief_rod"}, {"vapour"}, {"vapour_rod"}, {"retracted"}, {"extended"}, {"accumulator"}}};
  /// 1/m: over the scale of lengths, of the highest pressure; with air of the pressure itself, as the volume
  /// of a gas is told by no less.
  static constexpr double kPressureScale = 10.0;
  static constexpr double kLeastResolved = 1e3;  // Pa: of a lower pressure errors count over this one

  template <class Context>
  void add_states(Context& context) {
    const double most = std::max({d.pump_pressure, d.pressure, d.pressure_rod});
    const double scale = kPressureScale * context.length_scale();
    LoadState full{d.name + ".pressure", "Pa", d.pressure, scale * most};
    LoadState rod{d.name + ".pressure_rod", "Pa", d.pressure_rod, scale * most};
    if (d.air > 0.0) {
      for (LoadState* one : {&full, &rod}) {
        one->scale = scale * std::max(d.vapour_pressure, kLeastResolved);
        one->growth = scale;
      }
    }
    states = {context.state(std::move(full)), 2};
    context.state(std::move(rod));
    if (d.spool_lag > 0.0) {
      context.state({d.name + ".spool", "", clamped(d.command.at(0.0).value, -1.0, 1.0), scale});
      ++states.count;
    }
    if (d.accumulator_volume == 0.0) return;
    const double start =
        d.accumulator_volume * std::pow(d.accumulator_pressure / d.pressure, 1.0 / d.accumulator_exponent);
    gas = context.state({d.name + ".gas_volume", "m3", start, context.length_scale() * area[0]});
    ++states.count;
  }

  /// At mid-stroke.
  double compliance(std::size_t side, double pressure) const {
    return oil.compliance(pressure, 0.5 * d.stroke * area[side], hose_volume[side]);
  }

  /// What a jump of the spool's command, and the hole's opening, do to the force at mid-stroke.
  void measure_kinks() {
    for (std::size_t side = 0; side < 2; ++side) {
      const double p = side == 0 ? d.pressure : d.pressure_rod;
      const double gives = compliance(side, p);
      quickness += area[side] / gives * valve.edge[side] * std::sqrt(d.pump_pressure) /
                   (d.spool_lag > 0.0 ? d.spool_lag : 1.0);
      if (side == bursting) bursting_jump = area[side] / gives * hole * valve.through(p);
    }
  }

  /// Place, motion and pressures.
  template <class T>
  Motion<T> place(const LoadInput<T>& in) const {
    Motion<T> m;
    static_cast<SpanMotion<T>&>(m) = span.motion(in);
    m.stroke = m.length - T(d.retracted_length);
    m.asked = control.asked(in, m.stroke);
    m.spool = d.spool_lag > 0.0 ? in.states[states.first + 2] : clamped(m.asked, T(-1), T(1));
    m.swept = {T(area[0]) * m.stroke, T(area[1]) * (T(d.stroke) - m.stroke)};
    for (std::size_t side = 0; side < 2; ++side) {
      const T& state = in.states[states.first + static_cast<int>(side)];
      const T below = T(d.vapour_pressure) - state;
      const bool boils = below > T(0);
      m.pressure[side] = select(boils, T(d.vapour_pressure), state);
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
    const T past = T(d.internal_leakage) * (m.pressure[0] - m.pressure[1]);
    m.net[0] -= past;
    m.net[1] += past;
    m.power[leakage] -= past * (h[0] - h[1]);
    if (d.accumulator_volume > 0.0) charge(gas_now, h[0], m);
    m.power[pump] = T(d.pump_pressure - d.tank_pressure) * m.pumped;
    m.power[tank] = T(d.tank_pressure) * (m.pumped - m.returned);
    T drag = T(d.viscous_friction) * m.rate;
    if (d.friction > 0.0) drag += T(d.friction) * tanh(T(m.rate / T(d.friction_speed)));
    m.power[seals] = -drag * m.rate;
    for (std::size_t side = 0; side < 2; ++side) {
      const T swept_rate = T(side == 0 ? area[0] : -area[1]) * m.rate;
      const T gives = oil.compliance(m.pressure[side], m.swept[side], hose_volume[side]);
      m.pressure_rate[side] =
          (m.net[side] - swept_rate) / select(m.voids[side] > T(0), T(void_compliance[side]), gives);
    }
    m.force = T(area[0]) * m.pressure[0] - T(area[1]) * m.pressure[1] - drag -
              T(d.stop_stiffness) * beyond(m.stroke);
  }
  template <class T>
  T spool_rate(const Motion<T>& m) const {
    return (clamped(m.asked, T(-1), T(1)) - m.spool) / T(d.spool_lag);
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

    const T relieved = valve.relieved(side, p), drained = T(d.external_leakage) * (p - T(d.tank_pressure));
    const T made_up = valve.made_up(p);
    m.power[relief] -= relieved * (h[side] - T(d.tank_pressure));
    m.power[leakage] -= drained * (h[side] - T(d.tank_pressure));
    m.power[makeup] -= made_up * (T(d.tank_pressure) - h[side]);
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
    const T least(kLeastGas * d.accumulator_volume), bounded = select(volume > least, volume, least);
    const T p =
        T(d.accumulator_pressure) * power(T(T(d.accumulator_volume) / bounded), d.accumulator_exponent);
    const T q = T(gas_conductance) * valve.through(T(p - m.pressure[0]));
    m.from_gas = select(volume > T(d.accumulator_volume) && q > T(0), T(0), q);
    m.net[0] += m.from_gas;
    m.power[throttle] = -m.from_gas * (p - h);
  }
  static constexpr double kLeastGas = 1e-3;  // of the whole volume

  /// How far the stroke is beyond an end: positive when extended.
  template <class T>
  T beyond(const T& s) const {
    return select(s > T(d.stroke), T(s - T(d.stroke)), select(s < T(0), s, T(0)));
  }
};

}  // namespace seacrane
