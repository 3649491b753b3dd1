#pragma once

#include <span>
#include <vector>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/integrate/problem.hpp"

namespace seacrane {

/// What the own explicit one-step methods share: the derivative handed from the end of a step to the start
/// of the next, projection, and saving.
///
/// A step ends with f(t + h, y) at the raw end state y; the system then projects y, using what it has just
/// factorised. The next step starts from the projected state but keeps that derivative. Why the order is
/// kept: in one step of a method of order p the constraints drift by O(h^(p+1)), so the kept derivative is
/// wrong by O(h^(p+1)) and the next step by h times that, one power below its own local error. Where the
/// correction is not small against the tolerances (a step far too long, a start off the manifold) the
/// derivative is evaluated again.
class OneStepIntegrator : public Integrator {
 public:
  OneStepIntegrator(const IntegratorProperties& properties, const Problem& problem,
                    const IntegratorOptions& options);

  void init(double t0, const double* y0) override;
  void reset(double t, const double* y) override;
  void begin_stretch(const double* y) override;
  Counters counters() const override { return counters_; }
  std::vector<double> save() const final;
  void load(std::span<const double> saved) final;

 protected:
  /// Makes start_derivative_ hold the derivative at time() and empties the last step.
  void begin_step();
  /// Ends the step: end_state_ and end_derivative_, the raw result at t_end, become the present state.
  void accept(double t_end);
  void evaluate(double t, const double* y, double* ydot) const;
  /// What a method keeps from step to step beyond the state and its derivative.
  virtual std::size_t history_size() const { return 0; }
  virtual void save_history(std::span<double> /*history*/) const {}
  virtual void load_history(std::span<const double> /*history*/) {}
  [[noreturn]] void fail(double h, std::size_t component, const std::string& reason) const;

  System& system_;
  ErrorNorm norm_;
  // Mutable because dense output may need an evaluation of its own.
  mutable Counters counters_;
  /// Derivatives at both ends and raw end state of the last step: what dense output is made of.
  std::vector<double> start_derivative_;
  std::vector<double> end_state_;
  std::vector<double> end_derivative_;
  /// Step size to try next (s, 0: not chosen yet) and error of the last step, for the step size control.
  double step_ = 0.0;
  double error_memory_;

 private:
  enum class NextStart { missing, at_start, at_end, refreshed };

  const std::vector<double>& next_derivative() const;
  bool next_is_exact() const;

  NextStart next_start_ = NextStart::missing;
  bool starts_exact_ = false;  // start_derivative_ is that at previous_state(), to the last bit
  std::vector<double> refreshed_;
  std::vector<double> candidate_;
  double initial_step_;
};

/// Cubic Hermite polynomial at s in [0, 1] from values and slopes (times the step) at both ends
/// [Hairer, Norsett, Wanner I, II.6.7].
inline double cubic_hermite(double start, double end, double start_slope, double end_slope, double s) {
  const double rise = end - start;
  const double bend = (1.0 - 2.0 * s) * rise + (s - 1.0) * start_slope + s * end_slope;
  return start + s * (rise + (s - 1.0) * bend);
}

}  // namespace seacrane
