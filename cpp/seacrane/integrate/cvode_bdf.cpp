#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "seacrane/integrate/cvode.hpp"
#include "seacrane/integrate/registration.hpp"

namespace seacrane {
namespace {

/// CVODE's backward differentiation formulas of order 1 to 5: modified Newton iteration with a dense
/// Jacobian, projection inside the step. The estimated error is not projected: the projection moves the
/// solution only, and the error test stays the formula's own.
class CvodeBdf final : public CvodeIntegrator {
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
      : CvodeIntegrator(properties, CV_BDF, problem, options), projected_(size()) {}

 private:
  void attach_solver(void* memory) override;
  int correct(double t, const double* y, double* correction);

  static int projection(sunrealtype t, N_Vector y, N_Vector correction, sunrealtype /*tolerance*/,
                        N_Vector /*error*/, void* user_data) {
    return static_cast<CvodeBdf&>(self(user_data)).correct(t, sundials::data(y), sundials::data(correction));
  }

  std::vector<double> projected_;
  std::optional<sundials::DenseAlgebra> algebra_;
};

void CvodeBdf::attach_solver(void* memory) {
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
