#pragma once

#include <string>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/joint_coordinate.hpp"
#include "seacrane/math/curve.hpp"

namespace seacrane {

struct DriverDescription {
  std::string name;
  CoordinateDescription coordinate;
  Curve curve;

  static constexpr const char* type = "Driver";
  static constexpr const char* text = "Prescribes a joint coordinate as a function of time.";
  static constexpr auto fields() {
    using D = DriverDescription;
    return std::tuple_cat(on_coordinate<D>(), std::tuple(required("curve", &D::curve, "m or rad", "")));
  }
};

/// A joint coordinate prescribed as a function of time: one row with nu = the reference's rate.
struct DriverData {
  CoordinateData coordinate;
  Curve curve;
  int element = 0;
};

template <class T>
void evaluate_driver(const DriverData& driver, const CurveValue& reference, const BodyKinematics<T>& ka,
                     const BodyKinematics<T>& kb, RowBlock<T>& out) {
  const CoordinateRow<T> c = evaluate_coordinate<T>(driver.coordinate, ka, kb);
  const T error = c.value - T(reference.value);
  out.d[0].row(0) = c.da.transpose();
  out.d[1].row(0) = c.db.transpose();
  out.phi[0] = is_angular(driver.coordinate.kind) ? wrap_angle<T>(error) : error;
  out.nu[0] = T(reference.rate);
  out.gamma[0] = c.gamma + T(reference.acceleration);
}

}  // namespace seacrane
