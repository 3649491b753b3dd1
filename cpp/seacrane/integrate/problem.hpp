#pragma once

#include <cstddef>
#include <span>

namespace seacrane {

/// An explicit first-order system y' = f(t, y), possibly living on a manifold: what every integrator asks
/// for. What single methods need beside it is an interface of its own (Problem).
///
/// One virtual call per evaluation of the whole right-hand side, none per component. Implementations
/// keep their scratch memory, so a System belongs to one run; they allocate nothing after construction.
class System {
 public:
  virtual ~System() = default;

  virtual std::size_t size() const = 0;

  /// Writes f(t, y). May throw; a non-finite result makes adaptive integrators reject the trial step.
  virtual void derivative(double t, const double* y, double* ydot) = 0;

  /// False when project() never changes y; integrators then skip it.
  virtual bool has_projection() const = 0;

  /// Moves y onto the invariant manifold of time t (mass metric). `evaluated_here` says that the last
  /// call of derivative() was at exactly this (t, y), so that its factorisation can be used again.
  /// Returns true when y changed by more than rounding (the caller then refreshes what it keeps of f).
  virtual bool project(double t, double* y, bool evaluated_here) = 0;

  /// Writes df/dy, exact to rounding, by columns, for less than differences cost; may throw as derivative()
  /// does. Returns false, and leaves `out` undefined, where there is none: differences then replace it.
  virtual bool jacobian(double t, const double* y, double* out) = 0;
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
  /// leaves `out` undefined, where there is none: differences then replace it.
  virtual bool jacobian(double t, double c, const double* y, const double* ydot, double* out) = 0;
  /// 1 for differential, 0 for algebraic components.
  virtual std::span<const double> differential() const = 0;
  /// Maps an ODE state (layout of System) to consistent (y, ydot) of this system, and back.
  virtual void expand(double t, const double* ode_state, double* y, double* ydot) = 0;
  virtual void contract(double t, const double* y, double* ode_state) const = 0;
};

/// What makes a system stiff, where that is little and known: few numbers z of the state on which its rates
/// depend so strongly that explicit steps would be bound by them,
///
///   z = in y,   dy'/dz = out.
class StiffPart {
 public:
  virtual ~StiffPart() = default;
  /// How many numbers.
  virtual std::size_t rank() const = 0;
  /// Writes `in`, by numbers, and `out`, by numbers too, each over all components of the state. Evaluates the
  /// system at (t, y); may throw as its derivative() does.
  virtual void linearise(double t, const double* y, double* in, double* out) = 0;
};

/// Which components of a System's state are positions and how velocities move them: for methods that treat
/// the two apart.
class PositionMap {
 public:
  virtual ~PositionMap() = default;

  /// Number of leading components that are positions.
  virtual std::size_t position_size() const = 0;
  /// Moves the positions in y along the velocities in y for the time h, both held: rotations by the
  /// exponential.
  virtual void move(double h, double* y) = 0;
  /// Derivatives of the positions that move(h, y) leaves in the velocities of y, by columns: position_size()
  /// rows, a column for every other component. Returns false where there are none: differences then replace
  /// them.
  virtual bool move_jacobian(double h, const double* y, double* out) = 0;
};

/// What there is to integrate: the system, and what single methods ask for beside it; null where there is no
/// such thing. All of it must outlive the integrator.
struct Problem {
  System& system;
  PositionMap* positions = nullptr;
  ResidualSystem* residual = nullptr;
  StiffPart* stiff = nullptr;
};

}  // namespace seacrane
