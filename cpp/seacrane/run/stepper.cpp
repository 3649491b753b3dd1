#include "seacrane/run/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "seacrane/dynamics/recursive/body_tree.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/integrate/registry.hpp"
#include "seacrane/run/switches.hpp"

namespace seacrane {
namespace {

constexpr double kLargestTolerance = 0.1;  // beyond, an error estimate of one step means nothing

/// Where limits leave nothing to move, the recursive form has no coordinates.
std::string formulation_of(const Model& model, const RunOptions& run) {
  if (model.limits.empty()) return run.formulation;
  const BodyTree tree = build_tree(model.stepped());
  return tree.speeds == tree.driven ? "redundant" : run.formulation;
}

/// Adds how tolerances of load states grow. These states are the last before both integrals of work.
void add_growth(const Model& model, const RunOptions& run, IntegratorOptions& out) {
  const std::vector<LoadState>& states = model.load_states;
  if (std::ranges::none_of(states, [](const LoadState& one) { return one.growth > 0.0; })) return;
  out.tolerance_growth.assign(out.absolute_tolerance.size(), 0.0);
  const std::size_t first = out.absolute_tolerance.size() - 2 - states.size();
  for (std::size_t i = 0; i < states.size(); ++i) {
    out.tolerance_growth[first + i] = run.scaled_tolerance * states[i].growth;
  }
}

/// A step of no length at a kink fails where residuals are solved for by a method of many steps.
void check_jumps(const Model& model, const Integrator& integrator, const std::string& name) {
  if (!integrator_of(name).residual_form || !(integrator.steps_lost_by_reset() > 0.0)) return;
  const std::string load = Switches::first_that_jumps(model);
  if (load.empty()) return;
  throw std::invalid_argument("integrator \"" + name + "\" cannot restart where " + load +
                              " is touched; choose 'dopri5', or 'cvode-bdf' where it is stiff");
}

}  // namespace

IntegratorOptions integrator_options(const Formulation& stepped, const Model& model, const RunOptions& run) {
  if (!(run.scaled_tolerance > 0.0) || !(run.scaled_tolerance <= kLargestTolerance)) {
    throw std::invalid_argument("rtol is " + to_text(run.scaled_tolerance) +
                                "; give a positive number up to 0.1, e.g. 1e-6");
  }
  IntegratorOptions out;
  out.name = run.integrator;
  out.relative_tolerance = 0.0;
  out.absolute_tolerance = stepped.scale();
  for (double& value : out.absolute_tolerance) value *= run.scaled_tolerance;
  add_growth(model, run, out);
  out.fixed_step = run.fixed_step.value_or(0.0);
  out.max_step = run.max_step.value_or(0.0);
  out.spectral_radius = run.spectral_radius;
  return out;
}

Stepper::Stepper(std::shared_ptr<const Model> of, const RunOptions& options)
    : model(std::move(of)),
      bodies(formulation_of(*model, options), model),
      system(bodies.described()),
      stepped(bodies.formulation()),
      loads(bodies.terms()),
      stiff(stepped) {
  const bool inertial = model->inertial_tensions > 0;
  if (options.formulation == "redundant" && !inertial) residual.emplace(*bodies.maximal());
  if (inertial && integrator_of(options.integrator).residual_form) {
    throw std::invalid_argument("integrator \"" + options.integrator +
                                "\" has no accelerations for lines with rung 'quasi-static'; choose "
                                "another one, or rung 'elastic'");
  }
  integrator = make_integrator({stepped, &stepped.positions(), residual ? &*residual : nullptr, &stiff},
                               integrator_options(stepped, *model, options));
  check_jumps(*model, *integrator, options.integrator);
}

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
