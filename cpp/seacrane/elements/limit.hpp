#pragma once

#include <string>

#include "seacrane/elements/check.hpp"

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
};

}  // namespace seacrane
