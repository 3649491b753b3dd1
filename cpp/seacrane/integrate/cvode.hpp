#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {

/// What the two multistep families of CVODE share; a family's own file attaches its nonlinear solver.
class CvodeIntegrator : public SundialsIntegrator {
 public:
  /// `family` is CV_ADAMS or CV_BDF.
  CvodeIntegrator(std::string name, int family, System& system, const IntegratorOptions& options);

 protected:
  /// Called once, when the solver's memory exists.
  virtual void attach_solver(void* memory) = 0;

  double attempted_step() const override;

  static CvodeIntegrator& self(void* user_data) { return *static_cast<CvodeIntegrator*>(user_data); }

  ErrorNorm norm_;

 private:
  struct Free {
    void operator()(void* memory) const { CVodeFree(&memory); }
  };

  void restart() override;
  double advance(double t_limit) override;
  void dense_output(double t, double* y) const override;
  Counters solver_counters() const override;
  bool error_estimates(N_Vector errors, N_Vector weights) const override;
  void create();

  static int derivative(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data);
  static int weigh(N_Vector y, N_Vector weights, void* user_data);

  int family_;
  // Written by dense_output(), which is const to the caller.
  mutable std::vector<double> dense_;
  sundials::Vector dense_vector_;
  std::unique_ptr<void, Free> memory_;
};

}  // namespace seacrane
