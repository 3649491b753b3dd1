#pragma once

#include <string>

#include "seacrane/elements/field.hpp"

namespace seacrane {

inline constexpr double kNoStop = kFarthest;  // m or rad: a bound here or beyond is none

/// Contact that only pushes, or a wire that only pulls:
///   wire   a distance joint that holds only while it is stretched
///   stop   bounds on a joint coordinate
///   seat   a weld that holds only while it is pressed along z of its first frame; let go, it stays open
struct LimitDescription {
  std::string name, kind;
  CoordinateDescription coordinate;              // of a stop; wires and seats name the joint alone
  double minimum = -kNoStop, maximum = kNoStop;  // of a stop
  double restitution = 0.0;
  double sticking_speed = 1e-3;  // m/s or rad/s: approaches below it don't rebound

  static constexpr const char* type = "Limit";
  static constexpr const char* text = "What a joint does one way only; see Scene.add_line and add_stop.";
  static constexpr auto fields() {
    using D = LimitDescription;
    return std::tuple_cat(
        std::tuple(required("kind", &D::kind, "", "wire, stop or seat")), on_coordinate<D>(false),
        std::tuple(
            optional("minimum", &D::minimum, "m or rad", "at -1e7 there is none").usually(0.0, 500.0),
            optional("maximum", &D::maximum, "m or rad", "at 1e7 there is none").usually(0.0, 500.0),
            optional("restitution", &D::restitution, "", "0 to 1").within(0.0, 1.0),
            optional("sticking_speed", &D::sticking_speed, "m/s or rad/s", "slower impacts do not rebound")
                .not_negative()
                .usually(1e-6, 0.5)));
  }
};

}  // namespace seacrane
