#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/lanes/lane_system.hpp"
#include "seacrane/run/guards.hpp"
#include "seacrane/run/simulation.hpp"

namespace seacrane {

/// Why runs cannot be stepped side by side; empty: they can. All that is taken from the first of them is
/// compared: what their models hold beside the values of their waves, method, time and inputs.
std::string kept_apart(const std::vector<Simulation*>& runs);

/// Steps runs of one model in different seas side by side, in lanes, with steps that they share: an error is
/// that of the lane where it is largest, and a step in which a load of one passes a kink in the state is
/// taken again by all, up to the kink. Outputs are taken by each run. A run that fails in its lane is left
/// where it was, and goes on by itself, which tells why.
class SideBySide {
 public:
  /// As many runs as the module has lanes, or fewer, which outlive this. Throws std::invalid_argument for
  /// runs that kept_apart() has something against.
  SideBySide(std::vector<Simulation*> runs, const LaneModule& module);
  SideBySide(const SideBySide&) = delete;
  SideBySide& operator=(const SideBySide&) = delete;

  /// Steps to t_end and hands the runs what was stepped. `keep_going` as in Simulation::advance().
  bool advance(double t_end, const std::function<bool(double time)>& keep_going);

 private:
  struct Instant {
    double time;
    std::vector<double> state;     // of all lanes
    std::vector<double> solution;  // likewise, see LaneSystem::write_solution()
    bool solved = false;
  };
  /// The part of one lane in the last step.
  class LaneStep : public LastStep {
   public:
    LaneStep(const Integrator& all, std::size_t lanes, std::size_t lane, std::size_t states)
        : LastStep(all.name(), states), all_(all), lanes_(lanes), lane_(lane), scratch_(all.size()) {}
    void update();
    void interpolate(double t, double* y) const override;

   private:
    void take(const double* all, double* own) const;

    const Integrator& all_;
    std::size_t lanes_, lane_;
    mutable std::vector<double> scratch_;
  };

  void step(double t_end);
  void drop(const IntegrationError& error);
  bool retake_to_kink();
  double end_of_strike() const;
  void leave_turning();
  std::optional<double> find_kink(std::size_t lane);
  void watch_kinks();
  void leave(std::size_t lane);
  void leave_before_step(std::size_t lane, const std::string& why);
  void set_aside(std::size_t lane, const std::string& why);
  bool has_left(std::size_t lane) const { return gone_[lane]; }
  void reset();
  void record(double smooth_until);
  Instant& instant(double t);
  const std::vector<double>& solution_at(double t);
  void take_lane(const double* all, std::size_t lane, double* y) const;
  void hand_over(std::size_t lane, double t, const double* all);
  Counters counters() const;
  void count_time(std::chrono::steady_clock::time_point since);

  std::vector<Simulation*> runs_;  // by lane
  std::vector<bool> gone_;         // of these
  std::size_t left_ = 0;           // how many
  std::size_t lanes_, states_;     // states of one lane
  std::unique_ptr<LaneSystem> system_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<Kink> all_kinks_;
  KinkStops kinks_;
  std::vector<LaneStep> steps_;                               // by run
  double kink_at_ = std::numeric_limits<double>::infinity();  // where the next step is to end
  StallWatch stall_;
  Counters before_, counted_;  // of steps before the last beginning; handed over so far
  double wall_seconds_ = 0.0;
  std::vector<Instant> instants_;         // outputs in the last step
  std::size_t known_ = 0;                 // of these
  std::vector<double> all_, rate_, one_;  // scratch: all lanes, one of them
};

}  // namespace seacrane
