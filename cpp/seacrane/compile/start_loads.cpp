#include "seacrane/compile/start_loads.hpp"

#include <memory>
#include <optional>
#include <vector>

#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

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
}

}  // namespace seacrane
