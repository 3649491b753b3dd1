#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {

/// What the methods of ARKODE's ARKStep share; a method's own file chooses the tables and attaches its
/// solvers.
///
/// ARKODE may not be given a changed state from inside a step, so the projection is done after it and the
/// projected state handed over by a reset, which keeps step size and error history, before the next step:
/// dense output of the raw step (quintic-or-lower Hermite) stays available in between.
class ArkodeIntegrator : public SundialsIntegrator {
 public:
  ArkodeIntegrator(std::string name, int order, sundials::ArkodeFunctions functions, System& system,
                   const IntegratorOptions& options);

  int order() const final { return order_; }

 protected:
  /// The stepper at time_ and solution_vector_,, null when it cannot be made.
  virtual void* make() = 0;
  /// Attaches the solvers to a new stepper.
  virtual void attach(void* /*memory*/) {}
  /// Restarts the stepper at time_ and solution_vector_.
  virtual int reinitialise(void* memory) = 0;
  virtual long newton_iterations(void* /*memory*/) const { return 0; }
  /// Called before every step, at time_ and state_; true when it has changed the parts of f.
  virtual bool change_parts(bool /*restarted*/) { return false; }

  double attempted_step() const override;

  static ArkodeIntegrator& self(void* user_data) { return *static_cast<ArkodeIntegrator*>(user_data); }
  /// The whole of f as a part.
  static int derivative(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data);

  ErrorNorm norm_;

 private:
  struct Free {
    void (*free)(void**);
    void operator()(void* memory) const { free(&memory); }
  };

  void restart() override;
  void prepare_step() override;
  double advance(double t_limit) override;
  void dense_output(double t, double* y) const override;
  Counters solver_counters() const override;
  bool error_estimates(N_Vector errors, N_Vector weights) const override;
  void create();
  void hand_over(double h);
  void project(double t);

  static int weigh(N_Vector y, N_Vector weights, void* user_data);

  int order_;
  sundials::ArkodeFunctions functions_;
  /// Counts of ARKODE that it has forgotten when the parts of f changed.
  Counters before_change_;
  // Written by dense_output(), which is const to the caller.
  mutable std::vector<double> dense_;
  sundials::Vector dense_vector_;
  std::unique_ptr<void, Free> memory_;
};

/// The implicit methods of ARKODE: f as the sum of an explicit and an implicit part, a dense Newton matrix.
class ArkodeImplicitIntegrator : public ArkodeIntegrator {
 public:
  /// `explicit_part` may be null.
  ArkodeImplicitIntegrator(std::string name, int order, ARKRhsFn explicit_part, ARKRhsFn implicit_part,
                           System& system, const IntegratorOptions& options);

 protected:
  /// Chooses the tables.
  virtual int set_table(void* memory) = 0;
  /// Fills the Jacobian of the implicit part by columns; 0, or what a callback of ARKODE returns on failure.
  virtual int fill_jacobian(double t, const double* y, const double* slope, SUNMatrix matrix) = 0;

 private:
  void* make() override;
  void attach(void* memory) override;
  int reinitialise(void* memory) override;
  long newton_iterations(void* memory) const override;

  static int jacobian(sunrealtype t, N_Vector y, N_Vector slope, SUNMatrix matrix, void* user_data, N_Vector,
                      N_Vector, N_Vector);

  ARKRhsFn explicit_part_, implicit_part_;
  std::optional<sundials::DenseAlgebra> algebra_;
};

}  // namespace seacrane
