#pragma once

#include "seacrane/integrate/one_step.hpp"

namespace seacrane {

/// The step size control that the own one-step methods with an error estimate share: PI control [Hairer,
/// Wanner, Solving Ordinary Differential Equations II, IV.2] with the constants of Hairer's codes, and his
/// choice of the first step.
class AdaptiveStep : public OneStepIntegrator {
 public:
  /// `estimate_power`: the estimated error of a step of length h falls like h to this power.
  AdaptiveStep(const IntegratorProperties& properties, const Problem& problem,
               const IntegratorOptions& options, int estimate_power);

  double step_in_use() const final;
  void step(double t_limit) final;

 protected:
  /// Fills end_state_ with the result of a step of length h; false, with bad_component_, when a derivative is
  /// not finite. Where it has found f(t_end, end_state_) as well it says so by end_derivative_known_.
  virtual bool try_step(double h, double t_end) = 0;
  /// Norm of the estimated error of the step tried last.
  virtual double error(double h) const = 0;
  /// The component that takes the largest part in error().
  virtual std::size_t dominant_component(double h) const = 0;
  /// Whether the step just tried, its end derivative known, has leapt through something that its error
  /// estimate has not seen.
  virtual bool has_leapt(double h);
  /// Step size to try instead of the controller's `wish` after a step of length h.
  virtual double preferred_step(double /*h*/, double wish) const { return wish; }

  /// Evaluates into k; false, with the component noted, when the result is not finite.
  bool stage(double t, const double* y, double* k);
  /// Whether end_state_ is finite; notes the component when it is not.
  bool end_is_finite();

  std::size_t bad_component_ = IntegrationError::no_component;
  bool end_derivative_known_ = false;

 private:
  double starting_step(double remaining);
  void after_success(double h, double error, bool cut_before, bool truncated);
  [[noreturn]] void collapse() const;

  double max_step_;
  double power_, beta_, alpha_;
};

}  // namespace seacrane
