#include <memory>
#include <stdexcept>

#include "seacrane/integrate/cvode.hpp"
#include "seacrane/integrate/registration.hpp"

namespace seacrane {
namespace {

/// CVODE's Adams-Moulton formulas of order 1 to 12, each step's equation solved by fixed-point iteration.
/// Nothing is projected (CVODE offers that with BDF only): a system that drifts applies Baumgarte's
/// stabilisation itself.
class CvodeAdams final : public CvodeIntegrator {
 public:
  static constexpr IntegratorProperties properties{
      .name = "cvode-adams",
      .kind = "multistep, SUNDIALS CVODE",
      .order = 12,
      .lowest_order = 1,
      .dense_order = 0,
      .projects = false,
      .restarts = true,
      .joints = "Baumgarte",
      .purpose = "smooth motion at tight tolerances, few evaluations"};

  CvodeAdams(const Problem& problem, const IntegratorOptions& options)
      : CvodeIntegrator(properties, CV_ADAMS, problem, options) {}

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

extern const Registration cvode_adams = registration<CvodeAdams>();

}  // namespace seacrane
