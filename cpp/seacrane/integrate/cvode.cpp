#include "seacrane/integrate/cvode.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace seacrane {

CvodeIntegrator::CvodeIntegrator(std::string name, int family, System& system,
                                 const IntegratorOptions& options)
    : SundialsIntegrator(std::move(name), system, options, system.size()),
      norm_(options.tolerances(), system.size()),
      family_(family),
      dense_(system.size()),
      dense_vector_(sundials::view(dense_, context_)) {}

int CvodeIntegrator::derivative(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data) {
  return self(user_data).evaluate(t, sundials::data(y), sundials::data(ydot));
}

int CvodeIntegrator::weigh(N_Vector y, N_Vector weights, void* user_data) {
  self(user_data).norm_.weights(sundials::data(y), sundials::data(weights));
  return 0;
}

void CvodeIntegrator::create() {
  memory_.reset(CVodeCreate(family_, context_.get()));
  if (!memory_) throw std::runtime_error(name() + ": CVODE could not be created");
  void* const memory = memory_.get();
  sundials::record_cvode_messages(memory, messages_);
  require(CVodeInit(memory, derivative, time_, solution_vector_.get()), "CVodeInit");
  require(CVodeSetUserData(memory, this), "CVodeSetUserData");
  require(CVodeWFtolerances(memory, weigh), "CVodeWFtolerances");
  require(CVodeSetMaxHnilWarns(memory, -1), "CVodeSetMaxHnilWarns");
  require(CVodeSetMaxStep(memory, options_.max_step), "CVodeSetMaxStep");
  require(CVodeSetInitStep(memory, options_.initial_step), "CVodeSetInitStep");
  attach_solver(memory);
}

void CvodeIntegrator::restart() {
  solution_ = state_;
  if (memory_) {
    require(CVodeReInit(memory_.get(), time_, solution_vector_.get()), "CVodeReInit");
    return;
  }
  try {
    create();
  } catch (...) {
    memory_.reset();
    throw;
  }
}

double CvodeIntegrator::advance(double t_limit) {
  require(CVodeSetStopTime(memory_.get(), t_limit), "CVodeSetStopTime");
  double reached = time_;
  const int flag = CVode(memory_.get(), t_limit, solution_vector_.get(), &reached, CV_ONE_STEP);
  if (flag < 0) fail("the multistep formula");
  state_ = solution_;
  return reached;
}

void CvodeIntegrator::dense_output(double t, double* y) const {
  if (CVodeGetDky(memory_.get(), t, 0, dense_vector_.get()) < 0) fail("dense output");
  std::copy(dense_.begin(), dense_.end(), y);
}

Counters CvodeIntegrator::solver_counters() const {
  Counters now;
  CVodeGetNumSteps(memory_.get(), &now.steps);
  CVodeGetNumErrTestFails(memory_.get(), &now.rejected_steps);
  CVodeGetNumNonlinSolvIters(memory_.get(), &now.newton_iterations);
  return now;
}

double CvodeIntegrator::attempted_step() const {
  double h = 0.0;
  CVodeGetCurrentStep(memory_.get(), &h);
  return h;
}

bool CvodeIntegrator::error_estimates(N_Vector errors, N_Vector weights) const {
  return CVodeGetEstLocalErrors(memory_.get(), errors) >= 0 &&
         CVodeGetErrWeights(memory_.get(), weights) >= 0;
}

}  // namespace seacrane
