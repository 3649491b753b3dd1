#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "seacrane/integrate/cvode.hpp"
#include "seacrane/integrate/difference_jacobian.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// CVODE's backward differentiation formulas of order 1 to 5: modified Newton iteration with a dense
/// Jacobian by difference quotients, projection inside the step.
///
/// The quotients are our own because CVODE's take their increments from the error weights, which are zero
/// for components outside the error norm. The estimated error is not projected: the projection moves the
/// solution only, and the error test stays the formula's own.
class CvodeBdf final : public CvodeIntegrator {
 public:
  CvodeBdf(System& system, const IntegratorOptions& options)
      : CvodeIntegrator("cvode-bdf", CV_BDF, system, options), trial_(size()), trial_slope_(size()) {}

  int order() const override { return 5; }

 private:
  void attach_solver(void* memory) override;
  int fill_jacobian(double t, const double* y, const double* slope, SUNMatrix matrix);
  int correct(double t, const double* y, double* correction);

  static CvodeBdf& own(void* user_data) { return static_cast<CvodeBdf&>(self(user_data)); }
  static int jacobian(sunrealtype t, N_Vector y, N_Vector slope, SUNMatrix matrix, void* user_data, N_Vector,
                      N_Vector, N_Vector) {
    return own(user_data).fill_jacobian(t, sundials::data(y), sundials::data(slope), matrix);
  }
  static int projection(sunrealtype t, N_Vector y, N_Vector correction, sunrealtype /*tolerance*/,
                        N_Vector /*error*/, void* user_data) {
    return own(user_data).correct(t, sundials::data(y), sundials::data(correction));
  }

  std::vector<double> trial_, trial_slope_;
  std::optional<sundials::DenseAlgebra> algebra_;
};

void CvodeBdf::attach_solver(void* memory) {
  algebra_.emplace(solution_vector_.get(), context_);
  require(CVodeSetLinearSolver(memory, algebra_->solver.get(), algebra_->matrix.get()),
          "CVodeSetLinearSolver");
  require(CVodeSetJacFn(memory, jacobian), "CVodeSetJacFn");
  if (!system_.has_projection()) return;
  require(CVodeSetProjFn(memory, projection), "CVodeSetProjFn");
  require(CVodeSetProjErrEst(memory, SUNFALSE), "CVodeSetProjErrEst");
}

int CvodeBdf::fill_jacobian(double t, const double* y, const double* slope, SUNMatrix matrix) {
  ++counters_.jacobians;
  bool exact = false;
  const int flag = guarded([&] {
    exact = exact_jacobian(system_, t, y, SUNDenseMatrix_Data(matrix), counters_);
    return 0;
  });
  if (exact || flag != 0) return flag;
  return difference_jacobian(
      y, slope, attempted_step(), norm_, trial_, trial_slope_,
      [&](const double* at, double* f) { return evaluate(t, at, f); },
      [&](std::size_t j) { return SUNDenseMatrix_Column(matrix, static_cast<sunindextype>(j)); });
}

int CvodeBdf::correct(double t, const double* y, double* correction) {
  return guarded([&] {
    ++counters_.projections;
    std::copy_n(y, size(), trial_.data());
    system_.project(t, trial_.data(), false);
    for (std::size_t i = 0; i < size(); ++i) correction[i] = trial_[i] - y[i];
    return check_finite(correction, size());
  });
}

}  // namespace

std::unique_ptr<Integrator> make_cvode_bdf(System& system, ResidualSystem* /*residual*/,
                                           const IntegratorOptions& options) {
  return std::make_unique<CvodeBdf>(system, options);
}

}  // namespace seacrane
