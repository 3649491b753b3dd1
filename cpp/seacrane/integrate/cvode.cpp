#include "seacrane/integrate/cvode.hpp"

namespace seacrane {

CvodeIntegrator::CvodeIntegrator(const IntegratorProperties& properties, int family, const Problem& problem,
                                 const IntegratorOptions& options)
    : SundialsIntegrator(properties, problem, options, sundials::cvode, options.tolerances(),
                         problem.system.size()),
      family_(family) {}

void* CvodeIntegrator::make() {
  void* memory = CVodeCreate(family_, context_.get());
  if (memory == nullptr) return nullptr;
  sundials::record_cvode_messages(memory, messages_);
  if (CVodeInit(memory, derivative, time_, solution_vector_.get()) < 0) CVodeFree(&memory);
  return memory;
}

void CvodeIntegrator::attach(void* memory) {
  require(CVodeSetMaxHnilWarns(memory, -1), "CVodeSetMaxHnilWarns");
  attach_solver(memory);
}

void CvodeIntegrator::reinitialise(void* memory) {
  require(CVodeReInit(memory, time_, solution_vector_.get()), "CVodeReInit");
}

double CvodeIntegrator::advance(double t_limit) {
  require(solver_.set_stop_time(memory(), t_limit), "CVodeSetStopTime");
  double reached = time_;
  const int flag = CVode(memory(), t_limit, solution_vector_.get(), &reached, CV_ONE_STEP);
  if (flag < 0) fail("the multistep formula");
  state_ = solution_;
  return reached;
}

}  // namespace seacrane
