#include "seacrane/integrate/arkode.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace seacrane {

ArkodeIntegrator::ArkodeIntegrator(std::string name, int order, sundials::ArkodeFunctions functions,
                                   System& system, const IntegratorOptions& options)
    : SundialsIntegrator(std::move(name), system, options, system.size()),
      norm_(options.tolerances(), system.size()),
      order_(order),
      functions_(functions),
      dense_(system.size()),
      dense_vector_(sundials::view(dense_, context_)),
      memory_(nullptr, Free{functions.free}) {}

int ArkodeIntegrator::derivative(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data) {
  return self(user_data).evaluate(t, sundials::data(y), sundials::data(ydot));
}

int ArkodeIntegrator::weigh(N_Vector y, N_Vector weights, void* user_data) {
  self(user_data).norm_.weights(sundials::data(y), sundials::data(weights));
  return 0;
}

void ArkodeIntegrator::create() {
  memory_.reset(make());
  if (!memory_) throw std::runtime_error(name() + ": ARKODE could not be created");
  void* const memory = memory_.get();
  require(functions_.set_user_data(memory, this), "SetUserData");
  require(functions_.set_weights(memory, weigh), "WFtolerances");
  require(functions_.set_warnings(memory, -1), "SetMaxHnilWarns");
  require(functions_.set_max_step(memory, options_.max_step), "SetMaxStep");
  if (options_.initial_step > 0.0) {
    require(functions_.set_init_step(memory, options_.initial_step), "SetInitStep");
  }
  attach(memory);
}

void ArkodeIntegrator::restart() {
  solution_ = state_;
  before_change_ = Counters{};
  change_parts(true);
  if (memory_) {
    require(reinitialise(memory_.get()), "ReInit");
    require(functions_.set_init_step(memory_.get(), options_.initial_step), "SetInitStep");
    return;
  }
  try {
    create();
  } catch (...) {
    memory_.reset();
    throw;
  }
}

void ArkodeIntegrator::prepare_step() {
  if (!change_parts(false)) {
    if (system_.has_projection()) hand_over(0.0);
    return;
  }
  // A reset would go on with the parts' values at the end of the last step.
  double h = 0.0;
  functions_.current_step(memory_.get(), &h);
  before_change_ = solver_counters();
  solution_ = state_;
  require(reinitialise(memory_.get()), "ReInit");
  require(functions_.set_init_step(memory_.get(), h), "SetInitStep");
}

/// Gives ARKODE the present state; with a step size it is also told what to try next.
void ArkodeIntegrator::hand_over(double h) {
  solution_ = state_;
  require(functions_.reset(memory_.get(), time_, solution_vector_.get()), "Reset");
  if (h > 0.0) require(functions_.set_init_step(memory_.get(), h), "SetInitStep");
}

double ArkodeIntegrator::advance(double t_limit) {
  double h = 0.0;
  while (true) {
    require(functions_.set_stop_time(memory_.get(), t_limit), "SetStopTime");
    if (h == 0.0) functions_.current_step(memory_.get(), &h);
    double reached = time_;
    bad_component_ = IntegrationError::no_component;
    const int flag =
        functions_.evolve(memory_.get(), t_limit, solution_vector_.get(), &reached, ARK_ONE_STEP);
    if (flag >= 0) {
      state_ = solution_;
      project(reached);
      return reached;
    }
    // ARKODE gives up on a derivative that is not finite; a shorter step may do.
    if (pending_ || bad_component_ == IntegrationError::no_component) fail("the step");
    h = 0.25 * std::min(h > 0.0 ? h : t_limit - time_, t_limit - time_);
    if (h < smallest_step(time_)) {
      messages_.last_error = "the step size has collapsed";
      fail("the step");
    }
    ++counters_.rejected_steps;
    hand_over(h);
  }
}

void ArkodeIntegrator::project(double t) {
  if (!system_.has_projection()) return;
  ++counters_.projections;
  system_.project(t, state_.data(), false);
  if (check_finite(state_.data(), size()) != 0) {
    messages_.last_error = "the projected state is not finite";
    fail("the projection");
  }
}

void ArkodeIntegrator::dense_output(double t, double* y) const {
  const int flag = functions_.dense_output(memory_.get(), t, 0, dense_vector_.get());
  if (flag < 0) fail("dense output");
  std::copy(dense_.begin(), dense_.end(), y);
}

Counters ArkodeIntegrator::solver_counters() const {
  Counters now;
  functions_.steps(memory_.get(), &now.steps);
  functions_.error_test_failures(memory_.get(), &now.rejected_steps);
  now.newton_iterations = newton_iterations(memory_.get());
  now.steps += before_change_.steps;
  now.rejected_steps += before_change_.rejected_steps;
  now.newton_iterations += before_change_.newton_iterations;
  return now;
}

double ArkodeIntegrator::attempted_step() const {
  double h = 0.0;
  functions_.current_step(memory_.get(), &h);
  return h;
}

bool ArkodeIntegrator::error_estimates(N_Vector errors, N_Vector weights) const {
  return functions_.local_errors(memory_.get(), errors) >= 0 &&
         functions_.weights(memory_.get(), weights) >= 0;
}

ArkodeImplicitIntegrator::ArkodeImplicitIntegrator(std::string name, int order, ARKRhsFn explicit_part,
                                                   ARKRhsFn implicit_part, System& system,
                                                   const IntegratorOptions& options)
    : ArkodeIntegrator(std::move(name), order, sundials::general_stepper(), system, options),
      explicit_part_(explicit_part),
      implicit_part_(implicit_part) {}

void* ArkodeImplicitIntegrator::make() {
  void* const memory =
      ARKStepCreate(explicit_part_, implicit_part_, time_, solution_vector_.get(), context_.get());
  if (memory != nullptr) sundials::record_ark_messages(memory, messages_);
  return memory;
}

void ArkodeImplicitIntegrator::attach(void* memory) {
  require(set_table(memory), "SetTable");
  algebra_.emplace(solution_vector_.get(), context_);
  require(SEACRANE_ARK(SetLinearSolver)(memory, algebra_->solver.get(), algebra_->matrix.get()),
          "SetLinearSolver");
  require(SEACRANE_ARK(SetJacFn)(memory, jacobian), "SetJacFn");
}

int ArkodeImplicitIntegrator::reinitialise(void* memory) {
  return ARKStepReInit(memory, explicit_part_, implicit_part_, time_, solution_vector_.get());
}

long ArkodeImplicitIntegrator::newton_iterations(void* memory) const {
  long iterations = 0;
  SEACRANE_ARK(GetNumNonlinSolvIters)(memory, &iterations);
  return iterations;
}

int ArkodeImplicitIntegrator::jacobian(sunrealtype t, N_Vector y, N_Vector slope, SUNMatrix matrix,
                                       void* user_data, N_Vector, N_Vector, N_Vector) {
  return static_cast<ArkodeImplicitIntegrator&>(self(user_data))
      .fill_jacobian(t, sundials::data(y), sundials::data(slope), matrix);
}

}  // namespace seacrane
