#include <algorithm>

#include "seacrane/integrate/registry.hpp"
#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {
namespace {

struct FreeArkode {
  void operator()(void* memory) const { SEACRANE_ERK(Free)(&memory); }
};

/// ARKODE's explicit stepper with the Dormand-Prince 5(4) pair: the same formulas as dopri5, written by
/// others, with their own error control and dense output (quintic-or-lower Hermite); it checks dopri5.
///
/// ARKODE may not be given a changed state from inside a step, so the projection is done after it and the
/// projected state handed over by a reset, which keeps step size and error history, before the next step:
/// dense output of the raw step stays available in between.
class ArkodeExplicit final : public SundialsIntegrator {
 public:
  ArkodeExplicit(System& system, const IntegratorOptions& options)
      : SundialsIntegrator("ark-erk", system, options, system.size()),
        norm_(options.tolerances(), system.size()),
        dense_(system.size()),
        dense_vector_(sundials::view(dense_, context_)) {}

  int order() const override { return 5; }

 private:
  void restart() override;
  void prepare_step() override;
  double advance(double t_limit) override;
  void dense_output(double t, double* y) const override;
  Counters solver_counters() const override;
  double attempted_step() const override;
  bool error_estimates(N_Vector errors, N_Vector weights) const override;
  void create();
  void hand_over(double h);
  void project(double t);

  static int derivative(sunrealtype t, N_Vector y, N_Vector ydot, void* self) {
    return static_cast<ArkodeExplicit*>(self)->evaluate(t, sundials::data(y), sundials::data(ydot));
  }
  static int weigh(N_Vector y, N_Vector weights, void* self) {
    static_cast<ArkodeExplicit*>(self)->norm_.weights(sundials::data(y), sundials::data(weights));
    return 0;
  }

  ErrorNorm norm_;
  // Written by dense_output(), which is const to the caller.
  mutable std::vector<double> dense_;
  sundials::Vector dense_vector_;
  std::unique_ptr<void, FreeArkode> memory_;
};

void ArkodeExplicit::create() {
  memory_.reset(ERKStepCreate(derivative, time_, solution_vector_.get(), context_.get()));
  if (!memory_) throw std::runtime_error("ark-erk: ARKODE could not be created");
  void* const memory = memory_.get();
  sundials::record_arkode_messages(memory, messages_);
  require(SEACRANE_ERK(SetUserData)(memory, this), "SetUserData");
  require(SEACRANE_ERK(WFtolerances)(memory, weigh), "WFtolerances");
  require(ERKStepSetTableNum(memory, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
  require(SEACRANE_ERK(SetMaxHnilWarns)(memory, -1), "SetMaxHnilWarns");
  require(SEACRANE_ERK(SetMaxStep)(memory, options_.max_step), "SetMaxStep");
  if (options_.initial_step > 0.0) {
    require(SEACRANE_ERK(SetInitStep)(memory, options_.initial_step), "SetInitStep");
  }
}

void ArkodeExplicit::restart() {
  solution_ = state_;
  if (memory_) {
    require(ERKStepReInit(memory_.get(), derivative, time_, solution_vector_.get()), "ERKStepReInit");
    require(SEACRANE_ERK(SetInitStep)(memory_.get(), options_.initial_step), "SetInitStep");
    return;
  }
  try {
    create();
  } catch (...) {
    memory_.reset();
    throw;
  }
}

void ArkodeExplicit::prepare_step() {
  if (system_.has_projection()) hand_over(0.0);
}

/// Gives ARKODE the present state; with a step size it is also told what to try next.
void ArkodeExplicit::hand_over(double h) {
  solution_ = state_;
  require(SEACRANE_ERK(Reset)(memory_.get(), time_, solution_vector_.get()), "Reset");
  if (h > 0.0) require(SEACRANE_ERK(SetInitStep)(memory_.get(), h), "SetInitStep");
}

double ArkodeExplicit::advance(double t_limit) {
  double h = 0.0;
  while (true) {
    require(SEACRANE_ERK(SetStopTime)(memory_.get(), t_limit), "SetStopTime");
    if (h == 0.0) SEACRANE_ERK(GetCurrentStep)(memory_.get(), &h);
    double reached = time_;
    bad_component_ = IntegrationError::no_component;
    const int flag =
        SEACRANE_ERK(Evolve)(memory_.get(), t_limit, solution_vector_.get(), &reached, ARK_ONE_STEP);
    if (flag >= 0) {
      state_ = solution_;
      project(reached);
      return reached;
    }
    // ARKODE gives up on a derivative that is not finite; a shorter step may do.
    if (pending_ || bad_component_ == IntegrationError::no_component) fail("the explicit step");
    h = 0.25 * std::min(h > 0.0 ? h : t_limit - time_, t_limit - time_);
    if (h < smallest_step(time_)) {
      messages_.last_error = "the step size has collapsed";
      fail("the explicit step");
    }
    ++counters_.rejected_steps;
    hand_over(h);
  }
}

void ArkodeExplicit::project(double t) {
  if (!system_.has_projection()) return;
  ++counters_.projections;
  system_.project(t, state_.data(), false);
  if (check_finite(state_.data(), size()) != 0) {
    messages_.last_error = "the projected state is not finite";
    fail("the projection");
  }
}

void ArkodeExplicit::dense_output(double t, double* y) const {
  const int flag = SEACRANE_ERK(GetDky)(memory_.get(), t, 0, dense_vector_.get());
  if (flag < 0) fail("dense output");
  std::copy(dense_.begin(), dense_.end(), y);
}

Counters ArkodeExplicit::solver_counters() const {
  Counters now;
  SEACRANE_ERK(GetNumSteps)(memory_.get(), &now.steps);
  SEACRANE_ERK(GetNumErrTestFails)(memory_.get(), &now.rejected_steps);
  return now;
}

double ArkodeExplicit::attempted_step() const {
  double h = 0.0;
  SEACRANE_ERK(GetCurrentStep)(memory_.get(), &h);
  return h;
}

bool ArkodeExplicit::error_estimates(N_Vector errors, N_Vector weights) const {
  return SEACRANE_ERK(GetEstLocalErrors)(memory_.get(), errors) >= 0 &&
         SEACRANE_ERK(GetErrWeights)(memory_.get(), weights) >= 0;
}

}  // namespace

std::unique_ptr<Integrator> make_ark_erk(System& system, ResidualSystem* /*residual*/,
                                         const IntegratorOptions& options) {
  return std::make_unique<ArkodeExplicit>(system, options);
}

}  // namespace seacrane
