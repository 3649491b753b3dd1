#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "seacrane/run/stepper.hpp"

namespace seacrane {

/// Kinks that loads have in the state: where a soft stop is touched, left or lets go, the corners of a
/// spring's table, where a line goes slack or taut. They have no time to offer. A step that ends on another
/// side of one is taken again, up to where it crossed, so that every step sees one side only. A load that may
/// have kinks has has_sides(), side(input), a number for each side, and across(input, from, to), which
/// changes its sign between two of them. One that cannot be on a side has refused(side), which says why: the
/// run ends there.
class Switches {
 public:
  /// Whether loads of a model have such kinks.
  static bool any(const Model& model);

  /// Takes the sides at the state (t, y) of what is stepped, where a step starts. Throws std::domain_error
  /// where a load cannot be on its side.
  void watch(Stepper& at, double t, const double* y);
  /// Time of the first crossing inside the last step of `at`; nothing where there is none but at its ends:
  /// then the next step starts from the sides at its end.
  std::optional<double> find(Stepper& at);

 private:
  void find_sides(Stepper& at, double t, const double* y, std::vector<int>& sides);
  void refuse(const Stepper& at, double t, const std::vector<int>& sides) const;
  LoadInput<double> read(Stepper& at, double t, const double* y);
  static double across(const Stepper& at, const LoadInput<double>& in, std::size_t load, int from, int to);

  std::vector<int> before_, after_;  // by load with sides
  std::vector<double> bodies_;
};

}  // namespace seacrane
