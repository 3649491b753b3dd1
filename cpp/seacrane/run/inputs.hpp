#pragma once

#include <vector>

#include "seacrane/run/stepper.hpp"

namespace seacrane {

/// The inputs of a run, one number for each slot of the model, held from one call of a controller to the
/// next.
class HeldInputs {
 public:
  /// Throws std::invalid_argument for a wrong count, and for a value that is not finite; so does set().
  HeldInputs(const Model& model, const std::vector<double>& slots);

  void set(const std::vector<double>& slots);
  void give_to(Stepper& stepper) const;
  const std::vector<double>& slots() const { return slots_; }

 private:
  const Model& model_;
  std::vector<double> slots_;
};

}  // namespace seacrane
