#pragma once

#include <cmath>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/joint_coordinate.hpp"
#include "seacrane/elements/loads/load.hpp"

namespace seacrane {

/// A load along a joint coordinate, on both bodies. Returns its power.
template <class T>
T apply_along(const CoordinateData& coordinate, const CoordinateRow<T>& row, const T& load, const T& rate,
              LoadSum<T>& out) {
  const int a = coordinate.joint.first, b = coordinate.joint.second;
  out.wrench[a].force += row.da.template head<3>() * load;
  out.wrench[a].moment += row.da.template tail<3>() * load;
  out.wrench[b].force += row.db.template head<3>() * load;
  out.wrench[b].moment += row.db.template tail<3>() * load;
  return load * rate;
}

struct FrictionDescription {
  std::string name;
  CoordinateDescription coordinate;
  double load = 0.0, speed = 0.0;

  static constexpr const char* type = "Friction";
  static constexpr const char* text =
      "Dry friction on a joint coordinate: -load tanh(rate / speed); see Scene.add_friction.";
  static constexpr auto fields() {
    using D = FrictionDescription;
    return std::tuple_cat(
        on_coordinate<D>(),
        std::tuple(required("load", &D::load, "N or N m", "").not_negative(),
                   required("speed", &D::speed, "m/s or rad/s", "").positive().usually(1e-6, 1.0)));
  }
};

/// Dry friction on a joint coordinate, -load tanh(rate / speed), N or N m: Coulomb's to 1e-4 from 5 speeds
/// on. It does not stick: under a steady load F below `load` the coordinate creeps at speed atanh(F / load).
struct Friction {
  static constexpr const char* kind = "friction";
  static constexpr bool passive = true;  // holds no joint where it is
  using Description = FrictionDescription;

  Description d;
  CoordinateData coordinate;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    names.coordinate(c, d.coordinate);
  }

  static Description example() { return {"load", {"joint", "angle"}, 4.0, 0.7}; }

  template <class Context>
  static Friction compile(const Description& d, Context& context) {
    return {d, context.coordinate(d.coordinate)};
  }

  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return coordinate.bodies(); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    using std::tanh;
    const auto &ka = in.bodies[coordinate.joint.first], &kb = in.bodies[coordinate.joint.second];
    const CoordinateRow<T> row = evaluate_coordinate<T>(coordinate, ka, kb);
    const T rate = coordinate_rate<T>(row, ka, kb);
    const T ratio = rate / T(d.speed);
    const T drag = T(-d.load) * tanh(ratio);
    out.add_power(apply_along<T>(coordinate, row, drag, rate, out));
  }
};

}  // namespace seacrane
