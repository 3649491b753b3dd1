#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "seacrane/run/stepper.hpp"

namespace seacrane {

/// Kinks that loads have in the state: where a soft stop is touched, left or lets go, and the corners of a
/// spring's table. They have no time to offer. A step that ends on another side of one is taken again, up to
/// where it crossed, so that every step sees one side only.
class Switches {
 public:
  /// Whether loads of a model have such kinks.
  static bool any(const Model& model);

  /// Takes the sides at the state (t, y) of what is stepped, where a step starts.
  void watch(Stepper& at, double t, const double* y);
  /// Time of the first crossing inside the last step of `at`; nothing where there is none but at its ends:
  /// then the next step starts from the sides at its end.
  std::optional<double> find(Stepper& at);

 private:
  void find_sides(Stepper& at, double t, const double* y, std::vector<int>& sides);
  void read(Stepper& at, double t, const double* y);
  /// What changes its sign between two sides of a load, with the kinematics read last.
  double across(Stepper& at, std::size_t load, int from, int to) const;

  std::vector<int> before_, after_;  // soft stops, then springs with a table, in the order of the model
  std::vector<double> bodies_;
};

}  // namespace seacrane
