#include "seacrane/run/stepper_pool.hpp"

#include <algorithm>
#include <utility>

#include "seacrane/compile/compile.hpp"
#include "seacrane/run/stepper.hpp"

namespace seacrane {
namespace {

/// The set that holds at the start is the assembled model itself, wherever a run began: its rank is known.
std::shared_ptr<const Model> model_of(const std::shared_ptr<const Model>& model, ClosedSet closed) {
  return closed == model->closed ? model : compile_set(*model, closed);
}

}  // namespace

StepperPool::StepperPool(std::shared_ptr<const Model> model, ClosedSet closed, const RunOptions& options,
                         const HeldInputs& inputs)
    : model_(std::move(model)), options_(options), inputs_(inputs) {
  steppers_.push_back(std::make_unique<Stepper>(model_of(model_, closed), options_));
  current_ = steppers_.front().get();
  inputs_.give_to(*current_);
}

Stepper& StepperPool::of(ClosedSet closed, double t, const double* bodies) {
  if (current_->model->closed == closed) return *current_;
  const auto known = std::find_if(steppers_.begin(), steppers_.end(),
                                  [&](const auto& s) { return s->model->closed == closed; });
  const bool is_new = known == steppers_.end();
  if (is_new) steppers_.push_back(std::make_unique<Stepper>(model_of(model_, closed), options_));
  Stepper& out = is_new ? *steppers_.back() : **known;
  inputs_.give_to(out);
  set_curve_limit(out, current_->system.terms().curve_limit());
  const auto histories = current_->system.terms().histories().save();
  if (!histories.empty()) out.bodies.start_histories(t, bodies, histories);
  return out;
}

void StepperPool::step_from(Stepper& next, double t, const double* bodies) {
  const bool same = &next == current_ && next.started;
  current_ = &next;
  state_.resize(next.stepped.size());
  next.read_bodies(t, bodies, state_.data());
  if (same) {
    next.integrator->reset(t, state_.data());
    return;
  }
  if (next.started) counters_before_ += next.integrator->counters();
  next.integrator->init(t, state_.data());
  next.started = true;
}

Counters StepperPool::counters() const {
  Counters out = counters_before_;
  for (const auto& stepper : steppers_) {
    if (stepper->started) out += stepper->integrator->counters();
  }
  return out;
}

long StepperPool::dense_solves() const {
  long out = 0;
  for (const auto& stepper : steppers_) {
    out += stepper->bodies.dense_solves();
  }
  return out;
}

void set_curve_limit(Stepper& at, double time) {
  at.system.terms().set_curve_limit(time);
  at.loads.set_curve_limit(time);
}

}  // namespace seacrane
