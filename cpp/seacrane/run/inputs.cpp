#include "seacrane/run/inputs.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace seacrane {

HeldInputs::HeldInputs(const Model& model, const std::vector<double>& slots) : model_(model) { set(slots); }

void HeldInputs::set(const std::vector<double>& slots) {
  if (slots.size() != idx(model_.slot_count)) {
    throw std::invalid_argument("inputs: " + std::to_string(slots.size()) + " values given, the model has " +
                                std::to_string(model_.slot_count) + " slots");
  }
  for (const double v : slots) {
    if (!std::isfinite(v)) throw std::invalid_argument("inputs: hold a value that is not finite");
  }
  slots_ = slots;
}

void HeldInputs::give_to(Stepper& stepper) const {
  stepper.system.terms().set_inputs(slots_);
  stepper.loads.set_inputs(slots_);
}

}  // namespace seacrane
