#include "seacrane/compile/in_sea.hpp"

#include <algorithm>

#include "seacrane/compile/steps.hpp"
#include "seacrane/elements/check.hpp"

namespace seacrane {
namespace {

double cutoff(const WaveLoadDescription& load) { return load.positioned ? load.positioned->cutoff() : 0.0; }

bool loads_something(const WaveLoadDescription& load) { return load.exact || load.table || load.positioned; }

bool alike(const WaveLoadDescription& a, const WaveLoadDescription& b) {
  return a.body == b.body && loads_something(a) == loads_something(b) &&
         (a.positioned != nullptr) == (b.positioned != nullptr) && (cutoff(a) > 0.0) == (cutoff(b) > 0.0);
}

void put(Model& model, const std::vector<WaveLoadDescription>& loads,
         const std::shared_ptr<const SeaField>& sea) {
  model.description.wave_loads = loads;
  model.description.sea = model.sea = sea;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    WaveLoad& load = model.wave_loads[i];
    load.sources = loads[i];
    if (cutoff(loads[i]) > 0.0) model.vessels[idx(load.vessel)].fast = FastMotion{cutoff(loads[i])};
  }
}

void copy_fast_motions(const Model& from, Model& to) {
  for (std::size_t v = 0; v < from.vessels.size(); ++v) {
    const Vessel &there = from.vessels[v], &here = to.vessels[v];
    if (!there.fast) continue;
    std::copy_n(&from.initial_state[idx(there.memory_offset + there.fluid_states())], FastMotion::states,
                &to.initial_state[idx(here.memory_offset + here.fluid_states())]);
  }
}

}  // namespace

std::shared_ptr<const Model> in_sea(const Model& model, const std::vector<WaveLoadDescription>& loads,
                                    std::shared_ptr<const SeaField> sea) {
  const std::vector<WaveLoadDescription>& there = model.description.wave_loads;
  if (!std::equal(there.begin(), there.end(), loads.begin(), loads.end(), alike)) {
    throw SceneError("scene '" + model.description.name +
                     "': another sea loads other vessels than it was compiled with, or at another kind of "
                     "position; compile the scene in that sea");
  }
  auto out = std::make_shared<Model>(model);
  put(*out, loads, sea);
  out->near = NearSea::of(sea, out->stencils);
  start_fast_motions(*out);
  if (model.merged) {
    auto merged = std::make_shared<Model>(*model.merged);
    put(*merged, loads, sea);
    merged->near = merged->stencils == out->stencils ? out->near : NearSea::of(sea, merged->stencils);
    copy_fast_motions(*out, *merged);
    out->merged = std::move(merged);
  }
  return out;
}

}  // namespace seacrane
