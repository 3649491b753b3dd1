#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/heave_signal.hpp"
#include "seacrane/elements/loads/hydraulic_oil.hpp"
#include "seacrane/elements/loads/hydraulic_valve.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/span.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct HydraulicControlDescription {
  Curve command, reference;
  double gain = 0.0, rate_gain = 0.0;

  static constexpr auto fields() {
    using D = HydraulicControlDescription;
    return std::tuple(
        optional("command", &D::command, "", "of the spool, -1 (retracts) to 1 (extends)").usually(0.0, 1.0),
        optional("reference", &D::reference, "m", "stroke that the spool is to follow"),
        optional("gain", &D::gain, "1/m", "spool over the stroke that is missing; 0: open loop")
            .not_negative()
            .usually(0.05, 1e3),
        optional("rate_gain", &D::rate_gain, "s/m", "spool over the rate of the reference")
            .not_negative()
            .usually(0.02, 1e3));
  }
};

/// What asks for a spool position: command + gain (reference - stroke) + rate_gain reference rate, within -1
/// and 1. The stroke of a heave compensator adds to the reference.
struct HydraulicControl {
  HydraulicControlDescription d;
  int slot = 0;  // inputs: [command added, reference added, its rate]
  Followed follows;

  static void check(const HydraulicControlDescription& d, double rated_flow, const Check& c) {
    if (rated_flow > 0.0) return;
    if (d.gain > 0.0 || d.rate_gain > 0.0 || d.command.pieces().size() > 1 ||
        d.command.at(0.0).value != 0.0) {
      c.fail("has a command and no spool; give rated_flow and pump_pressure, or leave the command out");
    }
  }

  template <class Context>
  static HydraulicControl compile(const HydraulicControlDescription& d, const char* kind,
                                  const std::string& name, Context& context) {
    const int slot = context.input(name + ".command");
    context.input(name + ".reference");
    context.input(name + ".reference_rate");
    return {d, slot, context.followed(kind, name)};
  }

  /// Spool that is asked for, without bounds.
  template <class T>
  T asked(const LoadInput<T>& in, const T& stroke) const {
    const CurveValue ref = d.reference.at(in.time, in.curve_limit);
    const T open(d.command.at(in.time, in.curve_limit).value + in.slots[slot]);
    const T missing = T(ref.value + in.slots[slot + 1]) + follows.stroke(in) - stroke;
    return open + T(d.gain) * missing +
           T(d.rate_gain) * (T(ref.rate + in.slots[slot + 2]) + follows.rate(in));
  }

  /// Jumps of a force whose derivative of an order, 1 or 2, is `share` times what is asked for.
  std::vector<LoadKinks> kinks(double share, int order) const {
    std::vector<LoadKinks> all;
    const auto add = [&](const Curve& curve, double value, double rate) {
      LoadKinks& out = all.emplace_back();
      for (const CurveKink& kink : curve.kinks()) {
        out.push_back({kink.time, Eigen::Matrix<double, 1, 4>::Zero()});
        for (int p = order + 1; p <= 3; ++p) {
          const std::size_t derivative = idx(p - order - 1);
          out.back().jump(0, p) = share * (value * kink.jump(derivative) + rate * kink.jump(derivative + 1));
        }
      }
    };
    add(d.command, 1.0, 0.0);
    add(d.reference, d.gain, d.rate_gain);
    return all;
  }
};

struct HydraulicCylinderDescription : HydraulicOilDescription,
                                      HydraulicValveDescription,
                                      HydraulicControlDescription,
                                      SpanDescription {
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
        SpanDescription::fields(),
        std::tuple(required("full_area", &D::full_area, "m2", "of the piston, full side")
                       .positive()
                       .usually(1e-4, 3.0),
                   required("rod_side_area", &D::rod_side_area, "m2", "of the piston less the rod")
                       .positive()
                       .usually(1e-4, 3.0),
                   required("retracted_length", &D::retracted_length, "m", "between the points at stroke 0")
                       .positive()
                       .usually(0.02, 100.0),
                   required("stroke", &D::stroke, "m", "largest").positive().usually(0.01, 100.0),
                   required("pressure", &D::pressure, "Pa", "of the full side at the start, absolute")
                       .positive()
                       .usually(0.0, 2e8),
                   required("pressure_rod", &D::pressure_rod, "Pa", "of the rod side, likewise")
                       .positive()
                       .usually(0.0, 2e8),
                   required("hose_volume", &D::hose_volume, "m3",
                            "of the full side: hose and what the stroke leaves")
                       .not_negative(),
                   required("hose_volume_rod", &D::hose_volume_rod, "m3", "of the rod side, likewise")
                       .not_negative()),
        HydraulicOilDescription::fields(), HydraulicValveDescription::fields(),
        HydraulicControlDescription::fields(),
        std::tuple(
            optional("internal_leakage", &D::internal_leakage, "m3/s/Pa", "past the piston")
                .not_negative()
                .usually(0.0, 1e-9),
            optional("external_leakage", &D::external_leakage, "m3/s/Pa", "from each side to the tank")
                .not_negative()
                .usually(0.0, 1e-9),
            optional("viscous_friction", &D::viscous_friction, "N s/m", "of the seals").not_negative(),
            optional("friction", &D::friction, "N", "of the seals, dry").not_negative(),
            optional("friction_speed", &D::friction_speed, "m/s", "about which dry friction changes its sign")
                .positive()
                .usually(1e-4, 1.0),
            optional("stop_stiffness", &D::stop_stiffness, "N/m", "of the ends of the stroke").positive(),
            optional("accumulator_volume", &D::accumulator_volume, "m3",
                     "of gas, without oil, in an accumulator on the full side; 0: none")
                .not_negative(),
            optional("accumulator_pressure", &D::accumulator_pressure, "Pa", "of its gas without oil")
                .not_negative()
                .usually(9e4, 2e8),
            optional("accumulator_flow", &D::accumulator_flow, "m3/s", "through its throttle at `rated_drop`")
                .not_negative(),
            optional("accumulator_exponent", &D::accumulator_exponent, "", "of its gas: p V^exponent stays")
                .positive()
                .usually(0.9, 3.0),
            optional("rupture_time", &D::rupture_time, "s", "at which a hose bursts; at 1e7 none does"),
            optional("rupture_area", &D::rupture_area, "m2", "of the hole").not_negative(),
            optional("rod_side_ruptures", &D::rod_side_ruptures, "", "in place of the full side"),
            optional("discharge_coefficient", &D::discharge_coefficient, "", "of the hole")
                .positive()
                .usually(0.05, 1.5),
            optional("oil_density", &D::oil_density, "kg/m3", "that leaves through the hole")
                .positive()
                .usually(300.0, 3000.0),
            optional("refuse_void", &D::refuse_void, "", "whether a run ends where oil boils")));
  }

  void check(const Check& c, const SceneNames& names) const {
    SpanDescription::check(c, names);
    HydraulicOil::check(*this, c);
    for (const auto& [what, value] :
         {std::pair{"pressure", pressure}, std::pair{"pressure_rod", pressure_rod}}) {
      if (value >= vapour_pressure) continue;
      c.fail(std::string(what) + " is " + to_text(value) + " Pa, below the vapour_pressure of " +
             to_text(vapour_pressure) + " Pa, where oil boils; pressures are absolute: give more");
    }
    HydraulicValve::check(*this, c);
    HydraulicControl::check(*this, rated_flow, c);
    check_volumes(c);
    check_reliefs(c);
    check_accumulator(c);
    check_rupture(c);
  }

  static HydraulicCylinderDescription example() {
    auto d = example_span<HydraulicCylinderDescription>();
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

 private:
  void check_volumes(const Check& c) const {
    const double bore = std::sqrt(4.0 * full_area / std::numbers::pi);
    if (bore > retracted_length) {
      c.fail("full_area is " + to_text(full_area) + " m2, of a piston " + to_text(bore) +
             " m wide in a cylinder of " + to_text(retracted_length) + " m; give m2");
    }
    if (!(rod_side_area <= full_area)) {
      c.fail("rod_side_area is " + to_text(rod_side_area) + " m2, more than the full side's " +
             to_text(full_area) + " m2; give the piston's area less the rod's");
    }
    for (const auto& [what, volume, swept] :
         {std::tuple{"hose_volume", hose_volume, full_area * stroke},
          std::tuple{"hose_volume_rod", hose_volume_rod, rod_side_area * stroke}}) {
      if (volume >= kLeastVolume * swept) continue;
      c.fail(std::string(what) + " is " + to_text(volume) +
             " m3, and at an end of the stroke no oil is left: "
             "its pressure would have no rate; give " +
             to_text(kLeastVolume * swept) + " m3 or more");
    }
  }
  void check_reliefs(const Check& c) const {
    for (const auto& [what, opening, start] :
         {std::tuple{"relief_pressure", relief_pressure, pressure},
          std::tuple{"relief_pressure_rod", relief_pressure_rod, pressure_rod}}) {
      if (opening == 0.0 || opening > start) continue;
      c.fail(std::string(what) + " is " + to_text(opening) + " Pa, below the holding pressure of " +
             to_text(start) + " Pa: it could not hold its load; give a higher one");
    }
  }
  void check_accumulator(const Check& c) const {
    for (const auto& [what, value] : {std::pair{"accumulator_volume", accumulator_volume},
                                      std::pair{"accumulator_pressure", accumulator_pressure},
                                      std::pair{"accumulator_flow", accumulator_flow}}) {
      if ((value > 0.0) == (accumulator_volume > 0.0)) continue;
      c.fail(std::string(what) + " is " + to_text(value) + " and accumulator_volume is " +
             to_text(accumulator_volume) +
             "; give accumulator_volume, accumulator_pressure and accumulator_flow, or none of them");
    }
    if (accumulator_volume > 0.0 && accumulator_pressure > pressure) {
      c.fail("accumulator_pressure is " + to_text(accumulator_pressure) +
             " Pa, above the holding pressure of " + to_text(pressure) +
             " Pa: it would be empty; give a lower one");
    }
    if (accumulator_volume == 0.0) return;
    const double left = std::pow(accumulator_pressure / pressure, 1.0 / accumulator_exponent);
    if (left >= kLeastCharge) return;
    c.fail("accumulator_pressure is " + to_text(accumulator_pressure) + " Pa: the holding pressure of " +
           to_text(pressure) + " Pa would squeeze its gas to " + to_text(left) +
           " of its volume; give more, in Pa: 1 bar is 1e5");
  }
  void check_rupture(const Check& c) const {
    if ((rupture_time < kFarthest) == (rupture_area > 0.0)) return;
    c.fail("rupture_time is " + to_text(rupture_time) + " s and rupture_area " + to_text(rupture_area) +
           " m2; give both, or neither");
  }
  static constexpr double kLeastVolume = 1e-4;  // of the swept volume
  static constexpr double kLeastCharge = 0.01;  // of the gas volume, at the start
};

}  // namespace seacrane
