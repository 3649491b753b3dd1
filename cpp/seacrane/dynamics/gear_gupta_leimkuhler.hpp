#pragma once

#include <optional>
#include <vector>

#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/dynamics/residual_jacobian.hpp"
#include "seacrane/integrate/problem.hpp"

namespace seacrane {

/// Stabilised index-2 form (Gear, Gupta & Leimkuhler 1985) for IDA:
///   q' = N(q) (v + M0^-1 D^T mu),  M v' = f + D^T lambda,  Phi = 0,  D v = nu,
/// unknowns (ODE state, lambda, mu). M0 is a constant diagonal mass, so that mu stays small and scaled.
class GearGuptaLeimkuhler final : public ResidualSystem {
 public:
  explicit GearGuptaLeimkuhler(MaximalSystem& system);

  std::size_t size() const override { return differential_.size(); }
  void residual(double t, const double* y, const double* ydot, double* r) override;
  bool jacobian(double t, double c, const double* y, const double* ydot, double* out) override;
  std::span<const double> differential() const override { return differential_; }
  void expand(double t, const double* ode_state, double* y, double* ydot) override;
  void contract(double t, const double* y, double* ode_state) const override;

 private:
  MaximalSystem* system_;
  std::vector<double> differential_, rate_;
  std::vector<Vec6d> load_, correction_;
  std::optional<ResidualJacobian> jacobian_;
};

}  // namespace seacrane
