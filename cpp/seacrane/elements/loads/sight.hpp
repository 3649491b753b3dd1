#pragma once

#include <limits>
#include <string>

#include "seacrane/elements/kinematics.hpp"
#include "seacrane/elements/loads/margin.hpp"

namespace seacrane {

/// What a load sees from the side that it is on: how far at least another one is that it may meet and leave
/// again within a step, and how fast that way is gone. Far: where it is closed or taut, whose force error
/// control sees, and of loads whose sides are no places: what is commanded, and pressures.
struct Sight {
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  Side side = {};
  Side watched = {};         // what changes of the side where the other one is met
  double clear = kFar;       // m or rad
  double pace = 0.0;         // m/s or rad/s
  double thin = kFar;        // m: no shorter way leads through what is met
  bool strikes = false;      // what is met throws it back
  bool presses = false;      // on what is thin
  Vec3d at = Vec3d::Zero();  // where that is which moves
};

/// What a load did as its side changed: "contact" of a point that touches, for one.
struct Happening {
  std::string name;
  const char* kind;
  double speed = 0.0;  // m/s, of what touches
};

/// Velocity of a point of a body, from its state point in its axes.
inline Vec3d velocity_of(const BodyKinematics<double>& k, const Vec3d& point) {
  return k.velocity + k.angular_velocity.cross(k.rotation * point);
}

}  // namespace seacrane
