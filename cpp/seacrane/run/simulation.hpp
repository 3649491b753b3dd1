#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/model/model.hpp"
#include "seacrane/run/contacts.hpp"
#include "seacrane/run/guards.hpp"
#include "seacrane/run/output_sampler.hpp"
#include "seacrane/run/restart.hpp"
#include "seacrane/run/stepper.hpp"
#include "seacrane/run/stepper_pool.hpp"
#include "seacrane/run/switches.hpp"

namespace seacrane {

struct LaneOf;

/// The kinks of curves over time at which steps end.
class KinkStops {
 public:
  explicit KinkStops(double scaled_tolerance) : scaled_tolerance_(scaled_tolerance) {}

  /// Time of the next kink that matters to a step of the present length; infinity where there is none near.
  /// Kinks beyond the step are left to the steps that come near them: an integrator must know of a stop a
  /// little beyond its step, no further.
  double next(const std::vector<Kink>& kinks, const Integrator& integrator, double now);

 private:
  double scaled_tolerance_;
  std::size_t next_ = 0;  // of the kinks of the model
};

struct RunStatistics {
  Counters counters;
  long dense_solves = 0;
  double wall_seconds = 0.0;  // inside advance()
  double energy_lost = 0.0;   // J, in impacts
  std::optional<RankReport> rank;
};

/// One run of one Model: the loop of steps, which end at kinks, samples and events, with outputs between
/// them.
class Simulation {
 public:
  Simulation(std::shared_ptr<const Model> model, const State& start, RunOptions options);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Steps to t_end. `keep_going` is asked every RunOptions::ask_every; false stops the run after the step
  /// at hand. Returns whether t_end was reached and nothing asked for a stop.
  bool advance(double t_end, const std::function<bool(double time)>& keep_going);

  double time() const { return integrator().time(); }
  State state();
  /// One row of all channels the model offers, at the present time.
  Recording snapshot() { return outputs_.snapshot(stepper(), energy_lost()); }
  const Recording& recording() const { return outputs_.recording(); }
  const Trail& trail() const { return outputs_.trail(); }
  /// Drops the first `count` rows recorded.
  void drop_rows(std::size_t count) { outputs_.drop_rows(count); }
  RunStatistics statistics() const;
  /// Steps so far, which `statistics` tells too, at the cost of the rank of all constraints.
  long steps() const { return steppers_.counters().steps + beside_.steps; }
  /// Sets the inputs from the present time on and restarts the derivative's history.
  void set_inputs(const std::vector<double>& slots);
  int state_size() const { return static_cast<int>(stepper().stepped.size()); }
  /// Order of the method, the highest one where it varies, and whether it chooses its own steps.
  int order() const { return integrator().order(); }
  bool is_adaptive() const { return integrator().is_adaptive(); }
  /// What limits did so far, in order of time.
  const std::vector<Event>& events() const;
  bool has_limits() const { return contacts_ != nullptr; }
  /// Bounds of loads that were reached so far.
  const std::vector<LimitReached>& limits_reached() const;
  const std::string& limit_name(int limit) const { return model_->limits[idx(limit)].name; }

  // For runs that are stepped side by side, see SideBySide.
  const std::shared_ptr<const Model>& model() const { return model_; }
  const RunOptions& options() const { return options_; }
  const std::vector<double>& inputs() const { return inputs_.slots(); }
  IntegratorOptions step_options() const { return integrator_options(stepper().stepped, *model_, options_); }
  /// As Switches for a step that was taken elsewhere: the sides where it starts, kept meanwhile, and where it
  /// is to end.
  bool has_switches() const { return switches_ != nullptr; }
  void keep_sides() { *kept_sides_ = *switches_; }
  void take_sides_back() { *switches_ = *kept_sides_; }
  std::optional<double> find_kink(LastStep& step) { return switches_->find(stepper(), step); }
  double end_of_strike(double now, double step) const { return switches_->end_of_strike(now, step); }
  void watch_kinks(double t, const double* y) { switches_->watch(stepper(), t, y); }
  /// At time(), as it is stepped.
  const double* stepped_state() const { return integrator().state(); }
  /// Records the outputs due until t and the step from `from`, at states that were stepped elsewhere;
  /// `curve_limit`: see Curve::at.
  void record_beside(double from, double t, double curve_limit, const StepStates& states);
  /// See RecursiveSystem::take_solution(). False: it places no bodies.
  bool take_solution(double t, const double* y, const LaneOf& solution);
  /// The next step begins behind a kink.
  void end_stretch() { outputs_.end_stretch(); }
  /// Takes over what was stepped elsewhere until t.
  void go_on_from(double t, const double* y, const Counters& taken, double wall_seconds);
  /// Why it was not stepped on beside others; empty: it was. Notes it.
  const std::string& set_aside() const { return set_aside_; }
  void set_aside(const std::string& why) { set_aside_ = why; }

 private:
  Stepper& stepper() const { return steppers_.current(); }
  Integrator& integrator() const { return *stepper().integrator; }
  double energy_lost() const { return contacts_ ? contacts_->energy_lost() : 0.0; }

  void put_on_constraints(double t);
  void begin_steps(const State& start);
  double end_of_smooth_stretch(double now);
  void step(double limit);
  void check_turning() const;
  bool retake_to_switch();
  bool carry_out_event();
  void settle(double t);
  void finish_step(double now, double smooth_until);
  void step_from(double t, ClosedSet closed);
  void reset_integrator();
  void watch_limits(bool goes_on = false);
  bool steps_over_kinks() const;
  void take_step(double to);
  void record_until(double t) { outputs_.record_until(stepper(), t, energy_lost()); }
  /// The state at time() in bodies' poses and twists.
  void write_bodies(double* bodies) const;

  std::shared_ptr<const Model> model_;
  RunOptions options_;
  HeldInputs inputs_;
  StepperPool steppers_;
  KinkStops kinks_;
  RankWatch rank_;
  StallWatch stall_;
  OutputSampler outputs_;
  std::unique_ptr<Contacts> contacts_;                          // null: the scene has no limits
  std::unique_ptr<Switches> switches_, kept_sides_;             // null: no load has a kink in the state
  bool ends_before_kinks_ = false;                              // the method cannot begin anew on one
  double switch_at_ = std::numeric_limits<double>::infinity();  // where the next step is to end on one
  double event_time_ = 0.0;                                     // with bodies_, of the last event
  std::vector<double> bodies_, state_;                          // of the described bodies, of what is stepped
  std::vector<double> forces_;                                  // of limits, see Contacts::read_forces()
  double wall_seconds_ = 0.0;
  Counters beside_;  // of steps that were taken elsewhere
  std::string set_aside_;
};

}  // namespace seacrane
