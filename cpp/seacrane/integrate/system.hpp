#pragma once

#include <cstddef>

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

}  // namespace seacrane
