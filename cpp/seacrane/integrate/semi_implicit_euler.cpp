#include <algorithm>

#include "seacrane/integrate/fixed_step.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

/// Step without a choice of the user (s): a method of order 1 needs short ones.
constexpr double default_step = 0.002;

/// Semi-implicit (symplectic) Euler method of order 1 [Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, I.1.2]: velocities move with the accelerations of the start of the step, then positions with
/// the new velocities; orientations turn by the exponential of the new angular velocity. What is neither
/// position nor velocity (memory states, work) takes an explicit Euler step, and so does every component of a
/// system that does not tell its positions. Dense output is linear, of order 1.
class SemiImplicitEuler final : public FixedStep {
 public:
  SemiImplicitEuler(System& system, const IntegratorOptions& options)
      : FixedStep("semi-implicit-euler", system, options, default_step) {}

  int order() const override { return 1; }
  void interpolate(double t, double* y) const override;

 private:
  void advance(double h, double t_end) override;
};

void SemiImplicitEuler::advance(double h, double /*t_end*/) {
  const std::size_t positions = system_.position_size();
  std::copy_n(state_.data(), positions, end_state_.data());
  for (std::size_t i = positions; i < size(); ++i) end_state_[i] = state_[i] + h * start_derivative_[i];
  if (positions > 0) system_.move(h, end_state_.data());
}

void SemiImplicitEuler::interpolate(double t, double* y) const {
  t = inside_last_step(t);
  if (previous_time_ == time_) {
    std::copy_n(state_.data(), size(), y);
    return;
  }
  const double s = (t - previous_time_) / (time_ - previous_time_);
  for (std::size_t i = 0; i < size(); ++i) y[i] = (1.0 - s) * previous_state_[i] + s * end_state_[i];
}

}  // namespace

std::unique_ptr<Integrator> make_semi_implicit_euler(System& system, ResidualSystem* /*residual*/,
                                                     const IntegratorOptions& options) {
  return std::make_unique<SemiImplicitEuler>(system, options);
}

}  // namespace seacrane
