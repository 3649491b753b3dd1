#include <algorithm>
#include <optional>

#include "seacrane/integrate/registration.hpp"
#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {
namespace {

/// ARKODE's diagonally implicit stepper with the L-stable pair ESDIRK4(3)6L[2]SA of order 4 [C. A. Kennedy,
/// M. H. Carpenter, Diagonally implicit Runge-Kutta methods for ordinary differential equations, NASA TM
/// 219173 (2016)]: modified Newton iteration with a dense Jacobian.
///
/// ARKODE may not be given a changed state from inside a step, so the projection is done after it and the
/// projected state handed over by a reset, which keeps step size and error history, before the next step:
/// dense output of the raw step (quintic-or-lower Hermite) stays available in between.
class ArkodeDirk final : public SundialsIntegrator {
 public:
  static constexpr IntegratorProperties properties{
      .name = "ark-dirk",
      .kind = "implicit, L-stable, SUNDIALS ARKODE (Kennedy, Carpenter)",
      .order = 4,
      .error_order = 3,
      .dense_order = 4,
      .uses_jacobian = true,
      .restarts = true,
      .joints = "projection, restart when it moved the state",
      .purpose = "stiff elements at tighter tolerances"};

  ArkodeDirk(const Problem& problem, const IntegratorOptions& options)
      : SundialsIntegrator(properties, problem, options, sundials::arkode, options.tolerances(),
                           problem.system.size()) {}

 private:
  void* make() override {
    void* const memory = ARKStepCreate(nullptr, derivative, time_, solution_vector_.get(), context_.get());
    if (memory != nullptr) sundials::record_ark_messages(memory, messages_);
    return memory;
  }
  void attach(void* memory) override;
  void reinitialise(void* memory) override;
  void prepare_step() override {
    if (system_.has_projection()) hand_over(0.0);
  }
  double advance(double t_limit) override;
  void hand_over(double h);

  std::optional<sundials::DenseAlgebra> algebra_;
};

void ArkodeDirk::attach(void* memory) {
  require(SEACRANE_ARK(SetMaxHnilWarns)(memory, -1), "SetMaxHnilWarns");
  require(ARKStepSetTableNum(memory, ARKODE_ESDIRK436L2SA_6_3_4, ARKODE_ERK_NONE), "SetTable");
  algebra_.emplace(solution_vector_.get(), context_);
  require(SEACRANE_ARK(SetLinearSolver)(memory, algebra_->solver.get(), algebra_->matrix.get()),
          "SetLinearSolver");
  require(SEACRANE_ARK(SetJacFn)(memory, dense_jacobian), "SetJacFn");
}

void ArkodeDirk::reinitialise(void* memory) {
  require(ARKStepReInit(memory, nullptr, derivative, time_, solution_vector_.get()), "ReInit");
  // hand_over() may have left another.
  require(solver_.set_init_step(memory, options_.initial_step), "SetInitStep");
}

/// Gives ARKODE the present state, and with a step size what to try next.
void ArkodeDirk::hand_over(double h) {
  solution_ = state_;
  require(SEACRANE_ARK(Reset)(memory(), time_, solution_vector_.get()), "Reset");
  if (h > 0.0) require(solver_.set_init_step(memory(), h), "SetInitStep");
}

double ArkodeDirk::advance(double t_limit) {
  double h = 0.0;
  while (true) {
    require(solver_.set_stop_time(memory(), t_limit), "SetStopTime");
    if (h == 0.0) h = attempted_step();
    double reached = time_;
    bad_component_ = IntegrationError::no_component;
    const int flag = SEACRANE_ARK(Evolve)(memory(), t_limit, solution_vector_.get(), &reached, ARK_ONE_STEP);
    if (flag >= 0) {
      state_ = solution_;
      project_state(reached);
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

}  // namespace

extern const Registration ark_dirk = registration<ArkodeDirk>();

}  // namespace seacrane
