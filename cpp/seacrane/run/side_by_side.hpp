#pragma once

#include <chrono>
#include <functional>
#include <memory>
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
/// that of the lane where it is largest. Outputs are taken by each run. A run that fails in its lane is left
/// where it was, and goes on by itself, which tells why. So does one whose loads pass a kink in the state,
/// from the step before it.
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
    std::vector<double> state;  // of all lanes
  };

  void step(double t_end);
  void drop(const IntegrationError& error);
  void leave_at_kinks();
  void leave(std::size_t lane);
  void set_aside(std::size_t lane, const std::string& why);
  bool has_left(std::size_t lane) const { return gone_[lane]; }
  void reset();
  void record(double smooth_until);
  const std::vector<double>& state_at(double t);
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
  StallWatch stall_;
  Counters before_, counted_;  // of steps before the last beginning; handed over so far
  double wall_seconds_ = 0.0;
  std::vector<Instant> instants_;  // outputs in the last step
  std::size_t known_ = 0;          // of these
  std::vector<double> all_, one_;  // scratch: all lanes, one of them
};

}  // namespace seacrane
