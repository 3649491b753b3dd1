#pragma once

#include <array>
#include <string>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/joint_coordinate.hpp"
#include "seacrane/elements/loads/heave_signal.hpp"
#include "seacrane/math/curve.hpp"

namespace seacrane {

struct ActuatorDescription {
  std::string name;
  CoordinateDescription coordinate;
  double stiffness = 0.0, damping = 0.0;
  Curve feed_forward, reference;

  static constexpr const char* type = "Actuator";
  static constexpr const char* text =
      "State feedback on a joint coordinate q: feed_forward + stiffness (reference - q) + damping (reference "
      "rate - q rate), N (N/m, N s/m) or N m (N m/rad, N m s/rad).";
  static constexpr auto fields() {
    using D = ActuatorDescription;
    return std::tuple_cat(
        on_coordinate<D>(),
        std::tuple(optional("stiffness", &D::stiffness, "N/m or N m/rad", "").not_negative(),
                   optional("damping", &D::damping, "N s/m or N m s/rad", "").not_negative(),
                   optional("feed_forward", &D::feed_forward, "N or N m", ""),
                   optional("reference", &D::reference, "m or rad", "")));
  }
};

/// State feedback on a joint coordinate: force = feed_forward + stiffness (reference - q) +
/// damping (reference rate - q rate), along the coordinate, on both bodies; N or N m. An angle is known to
/// whole turns only: the turn nearest to the reference counts. The stroke of a heave compensator adds to the
/// reference, and its rate to the reference's.
struct Actuator {
  static constexpr const char* kind = "actuator";
  static constexpr const char* follows_as = "actuator";
  static constexpr bool packs = true;
  using Description = ActuatorDescription;

  Description d;
  CoordinateData coordinate;
  int slot = 0;  // inputs: [force added, reference added, its rate]
  Followed follows;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.coordinate(c, d.coordinate);
    names.input(c, kind, d.name);
  }

  static Description example() {
    return {"load", {"joint", "angle"}, 20.0, 3.0, Curve::constant(9.0), Curve::quintic(0.0, 2.0, 0.0, 1.0)};
  }

  template <class Context>
  static Actuator compile(const Description& d, Context& context) {
    const int force = context.input(d.name + ".force");
    context.input(d.name + ".reference");
    context.input(d.name + ".reference_rate");
    return {d, context.coordinate(d.coordinate), force, context.followed(kind, d.name)};
  }

  std::vector<LoadKinks> kinks() const {
    return {kinks_of(d.reference, d.stiffness, d.damping), kinks_of(d.feed_forward, 1.0)};
  }

  void add_unit(int /*component*/, const LoadInput<double>& in, Vec6d* wrenches) const {
    const int a = coordinate.joint.first, b = coordinate.joint.second;
    const CoordinateRow<double> row = evaluate_coordinate<double>(coordinate, in.bodies[a], in.bodies[b]);
    wrenches[a] += row.da;
    wrenches[b] += row.db;
  }

  /// Along the coordinate, at its value and rate.
  template <class T>
  T force(const LoadInput<T>& in, const T& value, const T& rate) const {
    const CurveValue ref = d.reference.at(in.time, in.curve_limit);
    const T error = T(ref.value + in.slots[slot + 1]) + follows.stroke(in) - value;
    const T wrapped = is_angular(coordinate.kind) ? wrap_angle<T>(error) : error;
    return T(d.feed_forward.at(in.time, in.curve_limit).value + in.slots[slot]) + T(d.stiffness) * wrapped +
           T(d.damping) * (T(ref.rate + in.slots[slot + 2]) + follows.rate(in) - rate);
  }

  template <class T>
  T force(const LoadInput<T>& in) const {
    const BodyKinematics<T>&a = in.bodies[coordinate.joint.first], &b = in.bodies[coordinate.joint.second];
    const CoordinateRow<T> row = evaluate_coordinate<T>(coordinate, a, b);
    return force(in, row.value, coordinate_rate<T>(row, a, b));
  }

  std::array<int, 3> bodies() const {
    const auto [first, second] = coordinate.bodies();
    return {follows.any() ? follows.signal.body : first, first, second};
  }
  StateRange followed() const { return follows.signal.states; }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const int a = coordinate.joint.first, b = coordinate.joint.second;
    const CoordinateRow<T> row = evaluate_coordinate<T>(coordinate, in.bodies[a], in.bodies[b]);
    const T rate = coordinate_rate<T>(row, in.bodies[a], in.bodies[b]);
    const T f = force(in, row.value, rate);
    out.wrench[a].force += row.da.template head<3>() * f;
    out.wrench[a].moment += row.da.template tail<3>() * f;
    out.wrench[b].force += row.db.template head<3>() * f;
    out.wrench[b].moment += row.db.template tail<3>() * f;
    out.add_power(f * rate);
  }
};

}  // namespace seacrane
