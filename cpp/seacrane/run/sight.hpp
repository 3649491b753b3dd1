#pragma once

#include <limits>

#include "seacrane/elements/loads/load_kind.hpp"

namespace seacrane {

/// What a load sees from the side that it is on: how far at least another one is that it may meet and leave
/// again within a step, and how fast that way is gone.
struct Sight {
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  int side = 0;
  int watched = 0;           // what changes of the side where the other one is met
  double clear = kFar;       // m or rad
  double pace = 0.0;         // m/s or rad/s
  double thin = kFar;        // m: no shorter way leads through what is met
  bool strikes = false;      // what is met throws it back
  Vec3d at = Vec3d::Zero();  // where that is which moves
};

/// Of load i of a list. Far: where it is closed or taut, whose force error control sees,
/// and of loads whose sides are no places: what is commanded, and pressures.
Sight look(const LoadList& list, std::size_t i, const LoadInput<double>& in);

}  // namespace seacrane
