#pragma once

#include <string>

namespace seacrane {

/// How a line lets what hangs on it bounce: the slowest mode in which it is stretched about as much as in
/// any, at the start, of the bodies as they are joined, of all lines as if taut, and of what else holds them
/// along one direction.
struct LineBounce {
  std::string line;
  double mass = 0.0;   // kg, that has the mode's frequency on this line alone; on n falls a mass over n^2
  double omega = 0.0;  // rad/s
  double ratio = 0.0;  // of critical damping, that all lines give the mode
};

}  // namespace seacrane
