#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "seacrane/integrate/cvode.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// CVODE's backward differentiation formulas of order 1 to 5: modified Newton iteration with a dense
/// Jacobian, projection inside the step. The estimated error is not projected: the projection moves the
/// solution only, and the error test stays the formula's own.
class CvodeBdf final : public CvodeIntegrator {
 public:
  CvodeBdf(System& system, const IntegratorOptions& options)
      : CvodeIntegrator("cvode-bdf", CV_BDF, system, options), projected_(size()) {}

  int order() const override { return 5; }

 private:
  void attach_solver(void* memory) override;
  int correct(double t, const double* y, double* correction);

  static CvodeBdf& own(void* user_data) { return static_cast<CvodeBdf&>(self(user_data)); }
  static int jacobian(sunrealtype t, N_Vector y, N_Vector slope, SUNMatrix matrix, void* user_data, N_Vector,
                      N_Vector, N_Vector) {
    CvodeBdf& me = own(user_data);
    return me.dense_jacobian(t, sundials::data(y), sundials::data(slope), me.attempted_step(), me.norm_,
                             SUNDenseMatrix_Data(matrix));
  }
  static int projection(sunrealtype t, N_Vector y, N_Vector correction, sunrealtype /*tolerance*/,
                        N_Vector /*error*/, void* user_data) {
    return own(user_data).correct(t, sundials::data(y), sundials::data(correction));
  }

  std::vector<double> projected_;
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

std::unique_ptr<Integrator> make_cvode_bdf(System& system, ResidualSystem* /*residual*/,
                                           const IntegratorOptions& options) {
  return std::make_unique<CvodeBdf>(system, options);
}

}  // namespace seacrane
