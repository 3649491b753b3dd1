#include <algorithm>
#include <vector>

#include "seacrane/integrate/fixed_step.hpp"
#include "seacrane/integrate/registry.hpp"
#include "seacrane/integrate/tableaus/carpenter_kennedy.hpp"

namespace seacrane {
namespace {

/// Step without a choice of the user (s), that of rk4.
constexpr double default_step = 0.02;

/// A Runge-Kutta method of order 4 whose stages live in two registers, the solution and its change, beside
/// the derivative: five evaluations a step for a smaller error and a wider stability region than rk4's.
class LowStorageRungeKutta final : public FixedStep {
 public:
  LowStorageRungeKutta(System& system, const IntegratorOptions& options)
      : FixedStep("rk-low-storage", system, options, default_step), change_(size()), slope_(size()) {}

  int order() const override { return Scheme::order; }

 private:
  using Scheme = tableaus::CarpenterKennedy;

  void advance(double h, double t_end) override;

  std::vector<double> change_, slope_;
};

void LowStorageRungeKutta::advance(double h, double /*t_end*/) {
  const std::size_t n = size();
  double* __restrict const u = end_state_.data();
  double* __restrict const du = change_.data();
  std::copy_n(state_.data(), n, u);
  for (std::size_t stage = 0; stage < Scheme::stages; ++stage) {
    const auto a = static_cast<double>(Scheme::a[stage]), b = static_cast<double>(Scheme::b[stage]);
    const double* f = start_derivative_.data();
    if (stage > 0) {
      evaluate(time_ + static_cast<double>(Scheme::c[stage]) * h, u, slope_.data());
      require_finite(h, slope_);
      f = slope_.data();
    }
    for (std::size_t i = 0; i < n; ++i) {
      du[i] = (stage > 0 ? a * du[i] : 0.0) + h * f[i];
      u[i] += b * du[i];
    }
  }
}

}  // namespace

std::unique_ptr<Integrator> make_rk_low_storage(System& system, ResidualSystem* /*residual*/,
                                                const IntegratorOptions& options) {
  return std::make_unique<LowStorageRungeKutta>(system, options);
}

}  // namespace seacrane
