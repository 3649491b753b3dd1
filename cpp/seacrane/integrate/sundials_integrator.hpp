#pragma once

#include <exception>
#include <span>
#include <string>
#include <vector>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/integrate/sundials_handles.hpp"
#include "seacrane/integrate/system.hpp"

namespace seacrane {

/// What the SUNDIALS methods share: hard stops, exceptions across C, messages, restarts and counters.
///
/// Nothing may be thrown through the C code of the solvers. A callback runs inside guarded(), which keeps
/// an exception and tells the solver to give up; the step then throws it again. A result that is not
/// finite is reported to the solver as an error that a shorter step may cure.
class SundialsIntegrator : public Integrator {
 public:
  /// `solved_size` is the number of unknowns the solver works on.
  SundialsIntegrator(std::string name, System& system, const IntegratorOptions& options,
                     std::size_t solved_size);

  void init(double t0, const double* y0) final;
  void step(double t_limit) final;
  void interpolate(double t, double* y) const final;
  void reset(double t, const double* y) final;
  Counters counters() const final;
  bool is_adaptive() const override { return true; }
  double step_in_use() const override;
  double steps_lost_by_reset() const final { return 20.0; }
  std::vector<double> save() const final;
  void load(std::span<const double> saved) final;

 protected:
  /// Sets the solver's own start values from time_ and state_ and makes it forget the past.
  virtual void restart() = 0;
  /// Called before a step that goes on from the last one.
  virtual void prepare_step() {}
  /// One internal step. Fills state_ and returns the time reached, or returns through fail().
  virtual double advance(double t_limit) = 0;
  /// The solver's dense output at t, in the layout of the System.
  virtual void dense_output(double t, double* y) const = 0;
  /// Steps, failed error tests, Newton iterations since the last restart(); evaluations are counted here.
  virtual Counters solver_counters() const = 0;
  virtual double attempted_step() const = 0;
  /// Estimated errors and weights of the last attempt; false when the solver has none.
  virtual bool error_estimates(N_Vector errors, N_Vector weights) const = 0;

  /// Throws the exception kept by guarded(), or an IntegrationError for a failed `call`.
  [[noreturn]] void fail(const std::string& call) const;
  /// Throws std::runtime_error when a set-up call of SUNDIALS returned a negative flag.
  void require(int flag, const char* call) const;

  template <class Work>
  int guarded(Work&& work) noexcept {
    try {
      return work();
    } catch (...) {
      pending_ = std::current_exception();
      return -1;
    }
  }
  /// f(t, y) for the solver's callbacks: 0, or 1 when the result is not finite.
  int evaluate(double t, const double* y, double* ydot);
  /// Jacobian of f at (t, y) by columns: the system's own, else by difference quotients; `slope` is f there.
  /// Our own quotients because those of the solvers take increments from the error weights, which are zero
  /// for components outside the error norm. Returns what a callback does.
  int dense_jacobian(double t, const double* y, const double* slope, double h, const ErrorNorm& norm,
                     double* columns);
  /// 0 when finite, else 1 with the component noted.
  int check_finite(const double* values, std::size_t size);

  System& system_;
  IntegratorOptions options_;
  sundials::MessageLog messages_;
  sundials::Context context_;
  // The solver's unknowns. Apart from state_, which a failed step must leave alone.
  std::vector<double> solution_;
  sundials::Vector solution_vector_;
  Counters counters_;
  // Taken out by fail(), also from dense output.
  mutable std::exception_ptr pending_;
  std::size_t bad_component_ = IntegrationError::no_component;

 private:
  std::size_t dominant_component() const;

  Counters before_restart_;
  std::vector<double> trial_, trial_slope_;  // of dense_jacobian()
  // Filled only to name the dominant component of a failure.
  mutable std::vector<double> errors_, weights_;
  sundials::Vector errors_vector_, weights_vector_;
  bool started_ = false;
  bool must_restart_ = true;
  double step_before_restart_ = 0.0;  // s: what a restarted solver starts with is shorter
  // The last step was too short for the solver: the state was carried over.
  bool carried_ = false;
};

}  // namespace seacrane
