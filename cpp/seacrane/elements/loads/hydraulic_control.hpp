#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/heave_signal.hpp"
#include "seacrane/elements/loads/load.hpp"
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

}  // namespace seacrane
