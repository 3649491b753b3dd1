#pragma once

#include <cstddef>
#include <span>

namespace seacrane {

/// A fully implicit system F(t, y, y') = 0 (Gear-Gupta-Leimkuhler stabilised index 2). The unknowns are the
/// state in the System's layout, then one multiplier for each constraint, then as many more that keep the
/// rates of the positions on the constraints; the residuals likewise, then all constraints on velocity level,
/// then all on position level.
class ResidualSystem {
 public:
  virtual ~ResidualSystem() = default;
  virtual std::size_t size() const = 0;
  virtual void residual(double t, const double* y, const double* ydot, double* r) = 0;
  /// Writes dF/dy + c dF/dy', exact to rounding, by columns; may throw as residual() does. Returns false, and
  /// leaves `out` undefined, where there is none: differences then replace it.
  virtual bool jacobian(double t, double c, const double* y, const double* ydot, double* out) = 0;
  /// 1 for differential, 0 for algebraic components.
  virtual std::span<const double> differential() const = 0;
  /// Maps an ODE state (layout of System) to consistent (y, ydot) of this system, and back.
  virtual void expand(double t, const double* ode_state, double* y, double* ydot) = 0;
  virtual void contract(double t, const double* y, double* ode_state) const = 0;
};

}  // namespace seacrane
