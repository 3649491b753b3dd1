#pragma once

namespace seacrane {

/// A number of a load that makes sense beside what the load acts on alone; outside its usual bounds a slip in
/// a unit is told. A load lists these as `proportions`.
struct Proportion {
  const char* field;
  const char* beside;  // "mass" or "inertia" (the least) of the body that it names last, "distance"
  const char* makes;   // "{} times the distance"
  double least, most;
};

}  // namespace seacrane
