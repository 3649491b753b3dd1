#include <algorithm>
#include <optional>
#include <vector>

#include "seacrane/integrate/registration.hpp"
#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {
namespace {

/// CVODE's backward differentiation formulas of order 1 to 5: modified Newton iteration with a dense
/// Jacobian, projection inside the step. The estimated error is not projected: the projection moves the
/// solution only, and the error test stays the formula's own.
class CvodeBdf final : public SundialsIntegrator {
 public:
  static constexpr IntegratorProperties properties{.name = "cvode-bdf",
                                                   .kind = "implicit multistep, SUNDIALS CVODE",
                                                   .order = 5,
                                                   .lowest_order = 1,
                                                   .dense_order = 0,
                                                   .uses_jacobian = true,
                                                   .restarts = true,
                                                   .joints = "projection inside CVODE",
                                                   .purpose = "stiff elements in long smooth motion"};

  CvodeBdf(const Problem& problem, const IntegratorOptions& options)
      : SundialsIntegrator(properties, problem, options, sundials::cvode, options.tolerances(),
                           problem.system.size()),
        projected_(size()) {}

 private:
  void* make() override;
  void attach(void* memory) override;
  void reinitialise(void* memory) override {
    require(CVodeReInit(memory, time_, solution_vector_.get()), "CVodeReInit");
  }
  double advance(double t_limit) override;
  int correct(double t, const double* y, double* correction);

  static int projection(sunrealtype t, N_Vector y, N_Vector correction, sunrealtype /*tolerance*/,
                        N_Vector /*error*/, void* user_data) {
    return static_cast<CvodeBdf&>(self(user_data)).correct(t, sundials::data(y), sundials::data(correction));
  }

  std::vector<double> projected_;
  std::optional<sundials::SparseAlgebra> algebra_;
};

void* CvodeBdf::make() {
  void* memory = CVodeCreate(CV_BDF, context_.get());
  if (memory == nullptr) return nullptr;
  sundials::record_cvode_messages(memory, messages_);
  if (CVodeInit(memory, derivative, time_, solution_vector_.get()) < 0) CVodeFree(&memory);
  return memory;
}

double CvodeBdf::advance(double t_limit) {
  require(solver_.set_stop_time(memory(), t_limit), "CVodeSetStopTime");
  double reached = time_;
  const int flag = CVode(memory(), t_limit, solution_vector_.get(), &reached, CV_ONE_STEP);
  if (flag < 0) fail("the multistep formula");
  state_ = solution_;
  return reached;
}

void CvodeBdf::attach(void* memory) {
  require(CVodeSetMaxHnilWarns(memory, -1), "CVodeSetMaxHnilWarns");
  algebra_.emplace(solution_vector_.get(), context_);
  require(CVodeSetLinearSolver(memory, algebra_->solver.get(), algebra_->matrix.get()),
          "CVodeSetLinearSolver");
  require(CVodeSetJacFn(memory, dense_jacobian), "CVodeSetJacFn");
  if (!system_.has_projection()) return;
  require(CVodeSetProjFn(memory, projection), "CVodeSetProjFn");
  require(CVodeSetProjErrEst(memory, SUNFALSE), "CVodeSetProjErrEst");
}

int CvodeBdf::correct(double t, const double* y, double* correction) {
  return guarded([&] {
    ++counters_.projections;
    std::copy_n(y, size(), projected_.data());
    system_.project(t, projected_.data(), false);
    for (std::size_t i = 0; i < size(); ++i) correction[i] = projected_[i] - y[i];
    return check_finite(correction, size());
  });
}

}  // namespace

extern const Registration cvode_bdf = registration<CvodeBdf>();

}  // namespace seacrane
