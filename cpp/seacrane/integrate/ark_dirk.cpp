#include "seacrane/integrate/arkode.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// ARKODE's diagonally implicit stepper with the L-stable pair ESDIRK4(3)6L[2]SA of order 4 [C. A. Kennedy,
/// M. H. Carpenter, Diagonally implicit Runge-Kutta methods for ordinary differential equations, NASA TM
/// 219173 (2016)]: modified Newton iteration with a dense Jacobian.
class ArkodeDirk final : public ArkodeImplicitIntegrator {
 public:
  ArkodeDirk(System& system, const IntegratorOptions& options)
      : ArkodeImplicitIntegrator("ark-dirk", 4, nullptr, derivative, system, options) {}

 private:
  int set_table(void* memory) override {
    return ARKStepSetTableNum(memory, ARKODE_ESDIRK436L2SA_6_3_4, ARKODE_ERK_NONE);
  }
  int fill_jacobian(double t, const double* y, const double* slope, SUNMatrix matrix) override {
    return dense_jacobian(t, y, slope, attempted_step(), norm_, SUNDenseMatrix_Data(matrix));
  }
};

}  // namespace

std::unique_ptr<Integrator> make_ark_dirk(System& system, ResidualSystem* /*residual*/,
                                          const IntegratorOptions& options) {
  return std::make_unique<ArkodeDirk>(system, options);
}

}  // namespace seacrane
