#include <algorithm>
#include <vector>

#include "seacrane/integrate/arkode.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// Steps after which the linear part is formed anew.
constexpr int steps_per_linearisation = 20;

/// ARKODE's implicit-explicit stepper with the pair ARK4(3)6L[2]SA of order 4 [C. A. Kennedy, M. H.
/// Carpenter, Additive Runge-Kutta schemes for convection-diffusion-reaction equations, Appl. Numer. Math. 44
/// (2003) 139].
///
/// A multibody system does not fall into a stiff and a soft sum: every load reaches every acceleration
/// through the constraints. What can be split off is linear: f = L (y - y0) + rest, L the Jacobian by
/// difference quotients at the state y0 of some step before. The linear part is implicit and carries the
/// stiffness; the rest, which is small near y0, is explicit. The order holds for any L; a stale one only
/// costs stability. A product with L is dearer than an evaluation of a crane's f.
class ArkodeImex final : public ArkodeImplicitIntegrator {
 public:
  ArkodeImex(System& system, const IntegratorOptions& options)
      : ArkodeImplicitIntegrator("ark-imex", 4, rest, linear, system, options),
        origin_(size()),
        slope_(size()),
        product_(size()),
        jacobian_(size() * size()) {}

 private:
  int set_table(void* memory) override {
    // One Newton step solves a linear part, with the factors of the present step size only. Iterating
    // instead, ARKODE would take its experience of instant convergence to steps whose factors are those of
    // another size.
    constexpr int time_dependent = 0;
    const int flag = SEACRANE_ARK(SetLinear)(memory, time_dependent);
    return flag < 0 ? flag
                    : ARKStepSetTableNum(memory, ARKODE_ARK436L2SA_DIRK_6_3_4, ARKODE_ARK436L2SA_ERK_6_3_4);
  }
  int fill_jacobian(double, const double*, const double*, SUNMatrix matrix) override {
    std::copy(jacobian_.begin(), jacobian_.end(), SUNDenseMatrix_Data(matrix));
    return 0;
  }
  bool change_parts(bool restarted) override;
  void apply_linear(const double* y, double* product);

  static ArkodeImex& own(void* user_data) { return static_cast<ArkodeImex&>(self(user_data)); }
  static int linear(sunrealtype, N_Vector y, N_Vector ydot, void* user_data) {
    own(user_data).apply_linear(sundials::data(y), sundials::data(ydot));
    return 0;
  }
  static int rest(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data);
  int steps_left_ = 0;
  std::vector<double> origin_, slope_, product_;
  std::vector<double> jacobian_;  // by columns
};

bool ArkodeImex::change_parts(bool restarted) {
  if (!restarted && steps_left_-- > 0) return false;
  steps_left_ = 0;
  origin_ = state_;
  int flag = evaluate(time_, origin_.data(), slope_.data());
  if (flag == 0) flag = dense_jacobian(time_, origin_.data(), slope_.data(), 0.0, norm_, jacobian_.data());
  if (flag != 0) fail("the linearisation");
  steps_left_ = steps_per_linearisation - 1;
  return true;
}

void ArkodeImex::apply_linear(const double* y, double* product) {
  std::fill_n(product, size(), 0.0);
  for (std::size_t j = 0; j < size(); ++j) {
    const double change = y[j] - origin_[j];
    const double* const column = jacobian_.data() + j * size();
    for (std::size_t i = 0; i < size(); ++i) product[i] += change * column[i];
  }
}

int ArkodeImex::rest(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data) {
  ArkodeImex& me = own(user_data);
  const int flag = derivative(t, y, ydot, user_data);
  if (flag != 0) return flag;
  me.apply_linear(sundials::data(y), me.product_.data());
  double* const out = sundials::data(ydot);
  for (std::size_t i = 0; i < me.size(); ++i) out[i] -= me.product_[i];
  return 0;
}

}  // namespace

std::unique_ptr<Integrator> make_ark_imex(System& system, ResidualSystem* /*residual*/,
                                          const IntegratorOptions& options) {
  return std::make_unique<ArkodeImex>(system, options);
}

}  // namespace seacrane
