#include <vector>

#include "seacrane/integrate/fixed_step.hpp"
#include "seacrane/integrate/registration.hpp"

namespace seacrane {
namespace {

/// The classical Runge-Kutta method of order 4 with a fixed step [Hairer, Norsett, Wanner, Solving
/// Ordinary Differential Equations I, II.1]. Four evaluations a step: the one at the end of a step is the
/// first of the next.
class ClassicalRungeKutta final : public FixedStep {
 public:
  // The default step is well inside the 0.15 s or so at which the modes of a crane's controlled cylinders
  // make the method unstable.
  static constexpr IntegratorProperties properties{
      .name = "rk4",
      .kind = "explicit, fixed step",
      .order = 4,
      .dense_order = 4,
      .default_step = 0.02,
      .stable_up_to = 2.8,
      .lanes = true,
      .purpose = "equal steps, for real time and for comparison with other programs"};
  static std::vector<double> stability_polynomial() { return {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0}; }

  ClassicalRungeKutta(const Problem& problem, const IntegratorOptions& options)
      : FixedStep(properties, problem, options),
        stage_state_(size()),
        k2_(size()),
        k3_(size()),
        k4_(size()) {}

 private:
  void advance(double h, double t_end) override;
  void stage(double c, double h, const std::vector<double>& slope, std::vector<double>& k);

  std::vector<double> stage_state_, k2_, k3_, k4_;
};

/// k = f(t + c h, y + c h slope)
void ClassicalRungeKutta::stage(double c, double h, const std::vector<double>& slope,
                                std::vector<double>& k) {
  for (std::size_t i = 0; i < size(); ++i) stage_state_[i] = state_[i] + c * h * slope[i];
  evaluate(time_ + c * h, stage_state_.data(), k.data());
  require_finite(h, k);
}

void ClassicalRungeKutta::advance(double h, double /*t_end*/) {
  stage(0.5, h, start_derivative_, k2_);
  stage(0.5, h, k2_, k3_);
  stage(1.0, h, k3_, k4_);
  for (std::size_t i = 0; i < size(); ++i) {
    end_state_[i] = state_[i] + h / 6.0 * (start_derivative_[i] + 2.0 * (k2_[i] + k3_[i]) + k4_[i]);
  }
}

}  // namespace

extern const Registration rk4 = registration<ClassicalRungeKutta>();

}  // namespace seacrane
