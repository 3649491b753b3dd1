#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "seacrane/integrate/error_norm.hpp"

namespace seacrane {

/// The integration cannot continue. Thrown in place of a NaN, a hang or a message on the terminal.
class IntegrationError : public std::runtime_error {
 public:
  static constexpr std::size_t no_component = static_cast<std::size_t>(-1);

  IntegrationError(std::string method, double time, double step_size, std::size_t component,
                   std::string reason);

  const std::string& method() const { return method_; }
  double time() const { return time_; }
  double step_size() const { return step_size_; }
  /// Index of the state component with the largest weighted error (or the first non-finite one).
  std::size_t component() const { return component_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string method_;
  double time_;
  double step_size_;
  std::size_t component_;
  std::string reason_;
};

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

/// A quantity whose change of sign is an event.
using EventFunction = std::function<double(double t, const double* y)>;

/// The last step of a method, or of one of the systems that it steps side by side.
class LastStep {
 public:
  LastStep(std::string name, std::size_t size);
  virtual ~LastStep() = default;

  const std::string& name() const { return name_; }
  std::size_t size() const { return state_.size(); }
  double time() const { return time_; }
  /// Start of the last step; time() right after init, reset and load.
  double previous_time() const { return previous_time_; }
  /// State at time(), projected where the method projects.
  const double* state() const { return state_.data(); }
  /// State at previous_time(), projected likewise.
  const double* previous_state() const { return previous_state_.data(); }

  /// Dense output of the last step at t in [previous_time(), time()]; not projected.
  virtual void interpolate(double t, double* y) const = 0;

  /// Time in the last step at which `event` changes sign, to rounding, on the side where it has changed;
  /// nothing when its sign at time() is that at previous_time(). An event that is zero at the start of the
  /// step has been found by the step before. Of several events in one step it finds one.
  std::optional<double> locate(const EventFunction& event);

 protected:
  double time_ = 0.0;
  double previous_time_ = 0.0;
  std::vector<double> state_;
  std::vector<double> previous_state_;

 private:
  std::string name_;
  std::vector<double> event_state_;
};

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// What a run has cost so far; never set back by reset().
struct Counters {
  long steps = 0;
  long rejected_steps = 0;
  long evaluations = 0;
  long jacobians = 0;
  long newton_iterations = 0;
  long projections = 0;
  long restarts = 0;

  Counters& operator+=(const Counters& other) {
    steps += other.steps;
    rejected_steps += other.rejected_steps;
    evaluations += other.evaluations;
    jacobians += other.jacobians;
    newton_iterations += other.newton_iterations;
    projections += other.projections;
    restarts += other.restarts;
    return *this;
  }

  Counters& operator-=(const Counters& other) {
    steps -= other.steps;
    rejected_steps -= other.rejected_steps;
    evaluations -= other.evaluations;
    jacobians -= other.jacobians;
    newton_iterations -= other.newton_iterations;
    projections -= other.projections;
    restarts -= other.restarts;
    return *this;
  }
};

struct IntegratorOptions {
  std::string name = "dopri5";
  double relative_tolerance = 1e-6;
  /// One value, or one per state component; infinity leaves a component out of the error norm.
  std::vector<double> absolute_tolerance = {1e-8};
  /// What a tolerance grows by with the magnitude of its component, see Tolerances; empty: none.
  std::vector<double> tolerance_growth = {};
  /// Step of the fixed-step methods (s); 0 is the method's own default.
  double fixed_step = 0.0;
  /// Longest step (s); 0 is no limit.
  double max_step = 0.0;
  /// First step of the adaptive methods (s); 0 lets the method choose.
  double initial_step = 0.0;
  /// Spectral radius at infinite frequency of generalized-alpha, 0 to 1: 1 damps nothing, 0 annihilates.
  /// Without one the method takes its own; the other methods have none to choose.
  std::optional<double> spectral_radius;

  /// Systems side by side, see Tolerances; of methods that have `lanes`.
  std::size_t lanes = 1;

  Tolerances tolerances() const { return {relative_tolerance, absolute_tolerance, lanes, tolerance_growth}; }
};

/// Steps a System through time. One object belongs to one run.
class Integrator : public LastStep {
 public:
  /// `properties` are those of the method's registration, which lasts.
  Integrator(const IntegratorProperties& properties, std::size_t size);
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// Order of the method; the highest one for a method of variable order.
  int order() const { return properties_.order; }
  bool is_adaptive() const { return properties_.is_adaptive(); }

  virtual void init(double t0, const double* y0) = 0;
  /// Takes one internal step, never beyond t_limit; a step that reaches it lands on it exactly. Does
  /// nothing when t_limit is time(). After an exception time() and state() are those before the call.
  virtual void step(double t_limit) = 0;

  /// Goes on from a new state: drops what is kept of the derivative's past.
  virtual void reset(double t, const double* y) = 0;
  /// As reset() at time(), of a system that is the same there: of an unchanged state the derivative is known.
  virtual void begin_stretch(const double* y) { reset(time(), y); }
  virtual Counters counters() const = 0;
  /// Longest step that step() would take now (s); infinity where it is not chosen yet.
  virtual double step_in_use() const = 0;
  /// Steps after which a method is back at the length and order that it had before a reset.
  virtual double steps_lost_by_reset() const { return 0.0; }

  /// What load() needs to continue. The own one-step methods then continue bit for bit; the SUNDIALS methods
  /// keep time and state only (no public call saves their history), so load() restarts them.
  virtual std::vector<double> save() const = 0;
  virtual void load(std::span<const double> saved) = 0;

 protected:
  /// Sets time and state, with an empty last step. Throws std::invalid_argument on non-finite values.
  void set_state(double t, const double* y);
  /// Throws std::invalid_argument unless t_limit is finite and not before time().
  void check_limit(double t_limit) const;
  /// t, moved by rounding into the last step. Throws std::invalid_argument when t lies outside.
  double inside_last_step(double t) const;

 private:
  const IntegratorProperties& properties_;
};

/// Throws std::invalid_argument on a step size that is negative or not finite.
void check_step_sizes(const IntegratorOptions& options);

/// Below this step size, time plus a step is the same number as time.
double smallest_step(double t);

/// Length of the next step when `proposed` is wanted and `remaining` is left: all that is left when the
/// proposal covers it, and half of it where a full step would leave a sliver.
double limited_step(double proposed, double remaining);

}  // namespace seacrane
