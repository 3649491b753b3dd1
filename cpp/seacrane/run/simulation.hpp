#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "seacrane/run/contacts.hpp"
#include "seacrane/run/guards.hpp"
#include "seacrane/run/record_history.hpp"
#include "seacrane/run/recording.hpp"
#include "seacrane/run/stepper.hpp"
#include "seacrane/run/switches.hpp"

namespace seacrane {

struct RunOptions {
  std::string formulation = "redundant";
  std::string integrator = "dopri5";
  double tolerance =
      1e-6;  // times the scale of each state: absolute, so that results don't depend on the origin
  double fixed_step = 0.0;                // s, fixed-step methods; 0: the method's default
  double max_step = 0.0;                  // s; 0: no limit
  std::optional<double> spectral_radius;  // of generalized-alpha; none: the method's default
  double energy_limit = 0.0;              // of the energy balance, see EnergyWatch; 0: none
  std::vector<double> output_times;       // increasing; those before the start are left out
  std::size_t capacity = 0;               // outputs to take memory for; 0: all
  std::set<std::string> channels;
};

/// What an integrator keeps from step to step, with the state in the coordinates it steps.
struct StepHistory {
  std::string formulation, integrator;  // empty: none
  std::vector<double> values;           // Integrator::save()
  std::vector<double> rate;             // of the state stepped: tells whether the scene is the same
};

/// Everything that changes during a run; a copy is a checkpoint.
struct State {
  double time = 0.0;
  std::vector<double> values;           // poses, twists, memory states, work; see StateLayout
  std::vector<double> inputs;           // zero-order-held slots
  std::vector<TwistHistory> histories;  // one per vessel with a convolution; none: at rest before `time`
  StepHistory steps;                    // the same formulation and integrator go on from it bit for bit
  std::optional<std::vector<std::string>> closed;  // limits that hold; none: as described
  std::optional<RecordHistory> record;             // goes with `steps`; none: recording starts afresh
  std::vector<std::string> parts;                  // see state_parts(); none: not known
};

State initial_state(const Model& model);

struct RunStatistics {
  Counters counters;
  long dense_solves = 0;
  double wall_seconds = 0.0;  // inside advance()
  double energy_lost = 0.0;   // J, in impacts
  std::optional<RankReport> rank;
};

/// One run of one Model: steps, lands on kinks of curves, records at the times asked for.
class Simulation {
 public:
  Simulation(std::shared_ptr<const Model> model, State start, RunOptions options);

  /// Steps to t_end. `keep_going` is asked every 20 ms of wall time; false stops the run after the step
  /// at hand. Returns whether t_end was reached and nothing asked for a stop.
  bool advance(double t_end, const std::function<bool(double time)>& keep_going);

  double time() const { return now_->integrator->time(); }
  State state();
  /// One row of all channels the model offers, at the present time.
  Recording snapshot();
  const Recording& recording() const { return recording_; }
  /// Drops the first `count` rows recorded.
  void drop_rows(std::size_t count) { recording_.drop(count); }
  RunStatistics statistics() const;
  /// Sets the inputs from the present time on and restarts the derivative's history.
  void set_inputs(const std::vector<double>& slots);
  int state_size() const { return static_cast<int>(now_->stepped.size()); }
  const char* formulation() const { return now_->stepped.name(); }
  /// Order of the method, the highest one where it varies, and whether it chooses its own steps.
  int order() const { return now_->integrator->order(); }
  bool is_adaptive() const { return now_->integrator->is_adaptive(); }
  /// What limits did so far, in order of time.
  const std::vector<Event>& events() const;
  bool has_limits() const { return contacts_ != nullptr; }
  const std::string& limit_name(int limit) const { return model_->limits[idx(limit)].name; }

 private:
  /// Time of the last output, and the residual written with it.
  struct Written {
    double time = std::numeric_limits<double>::quiet_NaN(), open = 0.0;
  };

  Integrator& integrator() const { return *now_->integrator; }
  double find_stop(double now);
  void record_until(double t);
  void write(double t, double* y, Recording& out);
  void step(double limit);
  void land(double now, double stop);
  /// Takes what projection has found since into open_.
  void keep_open();
  void check_turning() const;
  [[noreturn]] void report_open(double t) const;
  void watch_rank_at(double t, const double* bodies);
  void check_inputs(const std::vector<double>& slots) const;
  void apply_inputs();
  bool resume(const State& given);
  void resume(const RecordHistory& record);
  std::vector<double> present_rate() const;
  void watch_limits();
  /// Starts histories of `at` from those given; none: at rest before t.
  static void start_histories(Stepper& at, double t, const double* bodies,
                              const std::vector<TwistHistory>& histories);
  /// The stepper of a set of limits, with the inputs, curves and histories of the present one.
  Stepper& stepper_of(ClosedSet closed);
  bool pass_event();
  bool step_back();
  void go_on(double t, ClosedSet closed);
  void sample_histories(double now);
  /// The state at time() in bodies' poses and twists.
  void write_present(double* bodies) const;

  std::shared_ptr<const Model> model_;
  RunOptions options_;
  std::vector<std::unique_ptr<Stepper>> steppers_;  // by set of limits, in the order of their first use
  Stepper* now_ = nullptr;
  Counters before_;                                             // of steppers before their last start
  std::unique_ptr<Contacts> contacts_;                          // null: the scene has no limits
  std::unique_ptr<Switches> switches_;                          // null: no load has a kink in the state
  double switch_at_ = std::numeric_limits<double>::infinity();  // where the next step is to end on one
  Recording recording_;
  RankWatch rank_;
  StallWatch stall_;
  EnergyWatch energy_;
  std::vector<double> inputs_;
  std::size_t next_output_ = 0, next_kink_ = 0;
  std::vector<double> stepped_state_, output_state_, rate_;
  double output_time_ = 0.0;  // of output_state_ at an event
  double start_energy_ = 0.0, start_work_ = 0.0;
  double open_ = 0.0;  // largest residual before projection since the last output, as far as taken
  Written written_;
  double wall_seconds_ = 0.0;
};

}  // namespace seacrane
