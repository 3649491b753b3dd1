#pragma once

#include <algorithm>
#include <numbers>

#include "seacrane/elements/loads/friction.hpp"
#include "seacrane/elements/loads/surface_law.hpp"

namespace seacrane {

struct SoftStopDescription {
  std::string name;
  CoordinateDescription coordinate;
  double minimum = -kFarthest, maximum = kFarthest;
  double stiffness = 0.0, damping = 0.0;

  static constexpr const char* type = "SoftStop";
  static constexpr const char* text =
      "Compliant bounds of a joint coordinate: stiffness p (1 + damping p') back where it is beyond one by "
      "p, "
      "never a pull; see Scene.add_stop.";
  static constexpr auto fields() {
    using D = SoftStopDescription;
    return std::tuple_cat(
        on_coordinate<D>(),
        std::tuple(optional("minimum", &D::minimum, "m or rad", "at -1e7 there is none").usually(0.0, 500.0),
                   optional("maximum", &D::maximum, "m or rad", "at 1e7 there is none").usually(0.0, 500.0),
                   required("stiffness", &D::stiffness, "N/m or N m/rad", "").positive(),
                   optional("damping", &D::damping, "s/m or s/rad", "").not_negative().usually(0.0, 100.0)));
  }
};

/// Compliant bounds of a joint coordinate (hunt_crossley): stiffness p (1 + damping p') back, where the
/// coordinate is beyond a bound by p; never a pull. Load and power are continuous where it is touched.
struct SoftStop {
  static constexpr const char* kind = "soft stop";
  static constexpr bool passive = true, own_pace = true;  // holds no joint where it is; strikes
  using Description = SoftStopDescription;

  Description d;
  CoordinateData coordinate;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.coordinate(c, d.coordinate);
    const bool low = d.minimum > -kFarthest, high = d.maximum < kFarthest;
    if (!low && !high) c.fail("has neither minimum nor maximum; give at least one");
    if (!(d.minimum < d.maximum)) {
      c.fail("minimum is " + to_text(d.minimum) + " and maximum " + to_text(d.maximum) +
             "; the minimum must be below the maximum");
    }
    const std::string& q = d.coordinate.coordinate;
    const bool turns = q == "angle" || q == "roll" || q == "pitch" || q == "yaw";
    if (turns && !(d.minimum > -std::numbers::pi && d.maximum < std::numbers::pi)) {
      c.fail("bounds of an angle are " + to_text(d.minimum) + " and " + to_text(d.maximum) +
             " rad; give both, between -pi and pi: the other way round would reach them too");
    }
  }

  static Description example() { return {"load", {"joint", "angle"}, -3.0, -2.9, 7.0, 0.2}; }

  template <class Context>
  static SoftStop compile(const Description& d, Context& context) {
    return {d, context.coordinate(d.coordinate)};
  }

  /// Its kinks are in the state.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return coordinate.bodies(); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const auto &ka = in.bodies[coordinate.joint.first], &kb = in.bodies[coordinate.joint.second];
    const CoordinateRow<T> row = evaluate_coordinate<T>(coordinate, ka, kb);
    const double side = row.value < T(d.minimum) ? 1.0 : (row.value > T(d.maximum) ? -1.0 : 0.0);
    if (side == 0.0) return;
    const T depth = T(side) * (T(side > 0.0 ? d.minimum : d.maximum) - row.value);
    const T rate = coordinate_rate<T>(row, ka, kb);
    const auto force = hunt_crossley<T>(T(d.stiffness) * depth, d.damping, T(-side) * rate);
    apply_along<T>(coordinate, row, T(side) * force.total(), rate, out);
    out.add_power(T(side) * force.viscous * rate);
  }

  Side side(const LoadInput<double>& in) const {
    if (pressed(in, 1.0) > 0.0) return side_of({kAtMinimum});
    return pressed(in, -1.0) > 0.0 ? side_of({kAtMaximum}) : Side();
  }
  double across(const LoadInput<double>& in, const Side& from, const Side& to) const {
    return pressed(in, (from.any() ? from : to)[kAtMinimum] ? 1.0 : -1.0);
  }
  Sight look(const LoadInput<double>& in) const {
    const auto &a = in.bodies[coordinate.joint.first], &b = in.bodies[coordinate.joint.second];
    const CoordinateRow<double> row = evaluate_coordinate<double>(coordinate, a, b);
    const double pace = std::abs(coordinate_rate<double>(row, a, b));
    const Side now = side(in);
    if (now.any()) return {.side = now, .pace = pace};
    return {.side = now,
            .watched = ~Side(),
            .clear = std::max(0.0, std::min(row.value - d.minimum, d.maximum - row.value)),
            .pace = pace,
            .strikes = true,
            .at = {row.value, 0.0, 0.0}};
  }

  double potential(const LoadInput<double>& in) const {
    const double q = evaluate_coordinate<double>(coordinate, in.bodies[coordinate.joint.first],
                                                 in.bodies[coordinate.joint.second])
                         .value;
    const double depth = q < d.minimum ? d.minimum - q : (q > d.maximum ? q - d.maximum : 0.0);
    return 0.5 * d.stiffness * depth * depth;
  }

 private:
  static constexpr std::size_t kAtMinimum = 0, kAtMaximum = 1;

  /// How far the minimum (1) or the maximum (-1) is passed; negative also where the stop would pull.
  double pressed(const LoadInput<double>& in, double side) const {
    const auto &ka = in.bodies[coordinate.joint.first], &kb = in.bodies[coordinate.joint.second];
    const CoordinateRow<double> row = evaluate_coordinate<double>(coordinate, ka, kb);
    const double depth = side * ((side > 0 ? d.minimum : d.maximum) - row.value);
    return std::min(depth, 1.0 - side * d.damping * coordinate_rate<double>(row, ka, kb));
  }
};

}  // namespace seacrane
