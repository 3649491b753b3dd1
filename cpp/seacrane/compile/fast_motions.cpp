#include "seacrane/compile/fast_motions.hpp"

namespace seacrane {

void start_fast_motions(Model& model) {
  std::vector<double>& y = model.initial_state;
  for (const Vessel& vessel : model.vessels) {
    if (!vessel.fast) continue;
    const double* twist = &y[idx(model.layout.twist(vessel.body))];
    vessel.fast->start({twist[0], twist[1], twist[5]}, &y[idx(vessel.memory_offset + vessel.fluid_states())]);
  }
}

}  // namespace seacrane
