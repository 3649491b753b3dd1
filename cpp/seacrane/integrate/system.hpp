#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace seacrane {

/// Consecutive components x of a state, x' = a x + b(t, y) where b does not depend on x.
struct LinearBlock {
  std::size_t first = 0, size = 0;
  std::vector<double> a;  // by rows
};

/// An explicit first-order system y' = f(t, y), possibly living on a manifold.
///
/// One virtual call per evaluation of the whole right-hand side, none per component. Implementations
/// keep their scratch memory, so a System belongs to one run; they allocate nothing after construction.
class System {
 public:
  virtual ~System() = default;

  virtual std::size_t size() const = 0;

  /// Writes f(t, y). May throw; a non-finite result makes adaptive integrators reject the trial step.
  virtual void derivative(double t, const double* y, double* ydot) = 0;

  /// Moves y onto the invariant manifold of time t (mass metric). `evaluated_here` says that the last
  /// call of derivative() was at exactly this (t, y), so that its factorisation can be used again.
  /// Returns true when y changed by more than rounding (the caller then refreshes what it keeps of f).
  virtual bool project(double /*t*/, double* /*y*/, bool /*evaluated_here*/) { return false; }

  /// False when project() never changes y; integrators then skip it.
  virtual bool has_projection() const { return false; }

  /// Number of leading components that are positions, for methods that treat them apart; 0 where the system
  /// does not tell.
  virtual std::size_t position_size() const { return 0; }
  /// Moves the positions in y along the velocities in y for the time h, both held: rotations by the
  /// exponential.
  virtual void move(double /*h*/, double* /*y*/) {}
  /// Derivatives of the positions that move(h, y) leaves in the velocities of y, by columns: position_size()
  /// rows, a column for every other component. Returns false where there are none.
  virtual bool move_jacobian(double /*h*/, const double* /*y*/, double* /*out*/) { return false; }

  /// Writes df/dy, exact to rounding, by columns, for less than differences cost; may throw as derivative()
  /// does. Returns false, and leaves nothing of use, where there is none: differences then stand in.
  virtual bool jacobian(double /*t*/, const double* /*y*/, double* /*out*/) { return false; }

  /// Why there is no fast part, for multirate methods; empty where there is one.
  virtual std::string missing_fast_part() const { return "it tells no fast part"; }
  /// Chooses the fast part of f anew, right after derivative(t, y, ...); it holds until the next call.
  virtual void split(double /*t*/, const double* /*y*/) {}
  /// Writes the fast part of f(t, y), for much less than f costs.
  virtual void fast_derivative(double /*t*/, const double* /*y*/, double* /*ydot*/) {}

  /// The components whose rate is linear in themselves, with constant coefficients.
  virtual std::vector<LinearBlock> linear_blocks() const { return {}; }
};

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
  /// leaves nothing of use, where there is none.
  virtual bool jacobian(double /*t*/, double /*c*/, const double* /*y*/, const double* /*ydot*/,
                        double* /*out*/) {
    return false;
  }
  /// 1 for differential, 0 for algebraic components.
  virtual std::span<const double> differential() const = 0;
  /// Maps an ODE state (layout of System) to consistent (y, ydot) of this system, and back.
  virtual void expand(double t, const double* ode_state, double* y, double* ydot) = 0;
  virtual void contract(double t, const double* y, double* ode_state) const = 0;
};

}  // namespace seacrane
