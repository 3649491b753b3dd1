#pragma once

namespace seacrane {

/// What an integration method is: everything said of it elsewhere, in tables, checks and tests, is made
/// from this.
struct IntegratorProperties {
  /// By which a user asks for it.
  const char* name;
  /// What it is, in words.
  const char* kind;
  /// The highest one for a method of variable order.
  int order;
  int lowest_order = order;
  /// Order of the embedded method that estimates the error; 0: none.
  int error_order = 0;
  /// Order of the solution between the ends of a step; 0: it varies.
  int dense_order;
  /// Step without a choice of the user (s); 0: it chooses its steps by the tolerance.
  double default_step = 0.0;
  /// |eigenvalue| times step up to which an oscillation does not grow, of an explicit method of fixed step;
  /// 0: no such limit.
  double stable_up_to = 0.0;
  /// Solves with df/dy, so that fast modes do not limit its steps.
  bool uses_jacobian = false;
  /// Asks for the PositionMap of the system.
  bool uses_positions = false;
  /// Solves the ResidualSystem.
  bool residual_form = false;
  /// Loses its history where a run continues from saved steps, or from a changed state.
  bool restarts = false;
  /// Has a spectral radius to choose.
  bool has_spectral_radius = false;
  /// Steps systems side by side: an error is that of the lane where it is largest, see Tolerances.
  bool lanes = false;
  /// How it keeps joints closed, in words.
  const char* joints = "projection";
  /// What it is there for, in words.
  const char* purpose;

  constexpr bool is_adaptive() const { return default_step == 0.0; }
};

}  // namespace seacrane
