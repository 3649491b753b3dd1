#pragma once

#include "seacrane/integrate/sundials_integrator.hpp"

namespace seacrane {

/// What the two multistep families of CVODE share; a family's own file attaches its nonlinear solver.
class CvodeIntegrator : public SundialsIntegrator {
 public:
  /// `family` is CV_ADAMS or CV_BDF.
  CvodeIntegrator(const IntegratorProperties& properties, int family, const Problem& problem,
                  const IntegratorOptions& options);

 protected:
  virtual void attach_solver(void* memory) = 0;

 private:
  void* make() final;
  void attach(void* memory) final;
  void reinitialise(void* memory) final;
  double advance(double t_limit) final;

  int family_;
};

}  // namespace seacrane
