#include <memory>
#include <stdexcept>

#include "seacrane/integrate/cvode.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// CVODE's Adams-Moulton formulas of order 1 to 12, each step's equation solved by fixed-point iteration.
/// Nothing is projected (CVODE offers that with BDF only): a system that drifts applies Baumgarte's
/// stabilisation itself.
class CvodeAdams final : public CvodeIntegrator {
 public:
  CvodeAdams(System& system, const IntegratorOptions& options)
      : CvodeIntegrator("cvode-adams", CV_ADAMS, system, options) {}

  int order() const override { return 12; }

 private:
  void attach_solver(void* memory) override {
    constexpr int no_acceleration = 0;
    solver_.reset(SUNNonlinSol_FixedPoint(solution_vector_.get(), no_acceleration, context_.get()));
    if (!solver_) throw std::runtime_error("cvode-adams: the fixed-point solver could not be created");
    require(CVodeSetNonlinearSolver(memory, solver_.get()), "CVodeSetNonlinearSolver");
  }

  sundials::NonlinearSolver solver_;
};

}  // namespace

std::unique_ptr<Integrator> make_cvode_adams(System& system, ResidualSystem* /*residual*/,
                                             const IntegratorOptions& options) {
  return std::make_unique<CvodeAdams>(system, options);
}

}  // namespace seacrane
