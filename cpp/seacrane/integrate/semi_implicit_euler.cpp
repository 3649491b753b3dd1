#include <algorithm>

#include "seacrane/integrate/fixed_step.hpp"
#include "seacrane/integrate/registration.hpp"

namespace seacrane {
namespace {

/// Semi-implicit (symplectic) Euler method of order 1 [Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, I.1.2]: velocities move with the accelerations of the start of the step, then positions with
/// the new velocities; orientations turn by the exponential of the new angular velocity. What is neither
/// position nor velocity (memory states, work) takes an explicit Euler step. Dense output is linear, of
/// order 1.
class SemiImplicitEuler final : public FixedStep {
 public:
  static constexpr IntegratorProperties properties{
      .name = "semi-implicit-euler",
      .kind = "explicit, fixed step, symplectic without constraints",
      .order = 1,
      .dense_order = 1,
      .default_step = 0.002,  // order 1 needs short ones
      .stable_up_to = 2.0,
      .uses_positions = true,
      .purpose = "the cheapest step; what game engines and many real-time simulators use"};

  SemiImplicitEuler(const Problem& problem, const IntegratorOptions& options)
      : FixedStep(properties, problem, options), positions_(*problem.positions) {}

  void interpolate(double t, double* y) const override;

 private:
  void advance(double h, double t_end) override;

  PositionMap& positions_;
};

void SemiImplicitEuler::advance(double h, double /*t_end*/) {
  const std::size_t positions = positions_.position_size();
  std::copy_n(state_.data(), positions, end_state_.data());
  for (std::size_t i = positions; i < size(); ++i) end_state_[i] = state_[i] + h * start_derivative_[i];
  positions_.move(h, end_state_.data());
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

extern const Registration semi_implicit_euler = registration<SemiImplicitEuler>();

}  // namespace seacrane
