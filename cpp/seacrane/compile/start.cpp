#include <memory>
#include <optional>
#include <vector>

#include "seacrane/compile/steps.hpp"
#include "seacrane/dynamics/terms.hpp"

namespace seacrane {
namespace {

constexpr double kBeyond = 1e-9;  // m or rad: a start beyond a bound

/// Refuses a start beyond a bound.
void check_limits(const Model& model, const Terms& terms) {
  for (std::size_t i = 0; i < model.limits.size(); ++i) {
    const Limit& limit = model.limits[i];
    if (holds(model.closed, static_cast<int>(i)) || !limit.kind->closes_again) continue;
    const double gap = limit.side * evaluate_limit(limit, terms.bodies().data()).value;
    if (gap >= -kBeyond) continue;
    throw SceneError("limit '" + limit.name + "': the scene starts " + to_text(-gap) +
                     " m or rad beyond it; start within the bounds, or correct them");
  }
}

}  // namespace

void start_fast_motions(Model& model) {
  std::vector<double>& y = model.initial_state;
  for (const Vessel& vessel : model.vessels) {
    if (!vessel.fast) continue;
    const double* twist = &y[idx(model.layout.twist(vessel.body))];
    vessel.fast->start({twist[0], twist[1], twist[5]}, &y[idx(vessel.memory_offset + vessel.fluid_states())]);
  }
}

void start_loads(Model& model) {
  const std::shared_ptr<const Model> view(&model, [](const Model*) {});
  Terms terms(view);
  double* const y = model.initial_state.data();
  terms.read(0.0, y);
  const LoadInput<double> in = terms.load_input(0.0, y + model.layout.memory);
  std::vector<double> weights;
  for (int b = 0; b < model.body_count(); ++b) {
    weights.push_back(model.bodies[idx(b)].mass * model.description.gravity);
  }
  model.loads.for_each([&](const LoadList& list, std::size_t i) {
    list.check_start(i, in, weights);
    list.settle(i, in, std::nullopt, y + model.layout.loads);
  });
  check_limits(model, terms);
}

}  // namespace seacrane
