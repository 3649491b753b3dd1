#include <pybind11/pybind11.h>

#include "seacrane/lanes/packed_system.hpp"

// One module for each kind of processor: SEACRANE_LANES numbers to a register, SEACRANE_INSTRUCTIONS as
// has_instructions() of the bindings calls them, SEACRANE_LANE_MODULE its name.

namespace {

std::unique_ptr<seacrane::LaneSystem> make(const seacrane::LaneModels& models) {
  return std::make_unique<seacrane::PackedSystem<SEACRANE_LANES>>(models);
}

constexpr seacrane::LaneModule offered{SEACRANE_INSTRUCTIONS, SEACRANE_LANES, seacrane::layout_of_models(),
                                       &make};

}  // namespace

PYBIND11_MODULE(SEACRANE_LANE_MODULE, m) {
  m.doc() = "Lanes for one kind of processor; for the core alone.";
  m.attr("offered") = pybind11::capsule(&offered, "seacrane lanes");
}
