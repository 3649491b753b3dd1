#include "seacrane/run/side_by_side.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

#include "seacrane/dynamics/recursive/body_tree.hpp"
#include "seacrane/dynamics/recursive/driven_stroke.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/integrate/registry.hpp"
#include "seacrane/model/difference.hpp"

namespace seacrane {
namespace {

using Stopwatch = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kAskBeside{20};
constexpr const char* kStuck = "a load cannot go on as it is";

LaneModels lane_models(const std::vector<Simulation*>& runs, std::size_t lanes) {
  LaneModels out;
  for (const Simulation* run : runs) out.push_back(run->model());
  out.resize(lanes, out.front());
  return out;
}

/// Values of each lane beside each other, those of the first where there is no run.
std::vector<double> interleaved(const std::vector<std::vector<double>>& of_runs, std::size_t lanes) {
  std::vector<double> out;
  for (std::size_t i = 0; i < of_runs.front().size(); ++i) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      out.push_back(of_runs[lane < of_runs.size() ? lane : 0][i]);
    }
  }
  return out;
}

IntegratorOptions lane_options(const std::vector<Simulation*>& runs, std::size_t lanes) {
  IntegratorOptions out = runs.front()->step_options();
  std::vector<std::vector<double>> absolute, growth;
  for (const Simulation* run : runs) {
    const IntegratorOptions own = run->step_options();
    absolute.push_back(own.absolute_tolerance);
    growth.push_back(own.tolerance_growth);
  }
  out.absolute_tolerance = interleaved(absolute, lanes);
  out.tolerance_growth = interleaved(growth, lanes);
  out.lanes = lanes;
  return out;
}

/// The kinks of all runs, by time.
std::vector<Kink> kinks_of(const std::vector<Simulation*>& runs) {
  std::vector<Kink> out;
  for (const Simulation* run : runs) {
    out.insert(out.end(), run->model()->kinks.begin(), run->model()->kinks.end());
  }
  std::ranges::stable_sort(out, [](const Kink& a, const Kink& b) { return a.time < b.time; });
  return out;
}

std::string kept_apart(const Simulation& run) {
  if (run.options().formulation != "recursive") return "its formulation is not the recursive one";
  if (!integrator_of(run.options().integrator).lanes) return "its integrator steps nothing side by side";
  if (run.options().energy_limit) return "its energy is watched";
  return kept_out_of_lanes(*run.model());
}

bool by_one_method(const Simulation& one, const Simulation& other) {
  const RunOptions &a = one.options(), &b = other.options();
  return a.integrator == b.integrator && a.scaled_tolerance == b.scaled_tolerance &&
         a.fixed_step == b.fixed_step && a.max_step == b.max_step;
}

/// The sides that poses choose: those of a strut about its universal joint belong to the tree, and a stroke
/// that is prescribed leaves its hinge one on either side of a dead centre, near that of one lane.
std::string difference_of_sides(const Simulation& first, const Simulation& run) {
  const Model& model = first.model()->stepped();
  const BodyTree one = build_tree(model), other = build_tree(run.model()->stepped());
  for (std::size_t i = 0; i < one.struts.size(); ++i) {
    const Strut &here = one.struts[i], &there = other.struts[i];
    if (here.extension_sign == there.extension_sign && here.side == there.side) continue;
    return "the strut of joint '" + model.elements[idx(here.element)].name + "' stands on different sides";
  }
  for (const Cluster& c : one.clusters) {
    if (c.drive.strut < 0) continue;
    const DrivenStroke stroke(one.struts[idx(c.drive.strut)], c.joint);
    const auto is_behind = [&](const Simulation& of) { return stroke.sine(of.stepped_state()[c.q]) < 0.0; };
    if (is_behind(first) == is_behind(run)) continue;
    return "joint '" + model.elements[idx(c.element)].name + "' is on different sides of a dead centre";
  }
  return "";
}

std::string kept_apart(const Simulation& first, const Simulation& run) {
  const std::string other = difference(*first.model(), *run.model());
  if (!other.empty()) return "the lifts differ in what lanes share: in " + other;
  if (!by_one_method(first, run)) return "the runs have different methods";
  if (run.time() != first.time()) return "the runs begin at different times";
  if (run.inputs() != first.inputs()) return "the runs have different inputs";
  if (run.state_size() != first.state_size()) return "the runs have different states";
  return difference_of_sides(first, run);
}

std::vector<Simulation*> side_by_side(std::vector<Simulation*> runs, std::size_t lanes) {
  const std::string why = kept_apart(runs);
  if (!why.empty()) throw std::invalid_argument("runs cannot be stepped side by side: " + why);
  if (runs.size() > lanes) {
    throw std::invalid_argument("runs: there are " + std::to_string(runs.size()) + " for " +
                                std::to_string(lanes) + " lanes; give no more than that");
  }
  return runs;
}

}  // namespace

std::string kept_apart(const std::vector<Simulation*>& runs) {
  for (const Simulation* run : runs) {
    const std::string alone = kept_apart(*run);
    if (!alone.empty()) return alone;
    const std::string beside = kept_apart(*runs.front(), *run);
    if (!beside.empty()) return beside;
  }
  return "";
}

SideBySide::SideBySide(std::vector<Simulation*> runs, const LaneModule& module)
    : runs_(side_by_side(std::move(runs), module.lanes)),
      gone_(runs_.size(), false),
      lanes_(module.lanes),
      states_(static_cast<std::size_t>(runs_.front()->state_size())),
      system_(module.make(lane_models(runs_, lanes_))),
      integrator_(make_integrator({*system_}, lane_options(runs_, lanes_))),
      all_kinks_(kinks_of(runs_)),
      kinks_(runs_.front()->options().scaled_tolerance),
      all_(states_ * lanes_),
      rate_(all_),
      one_(states_) {
  system_->set_inputs(runs_.front()->inputs());
  for (std::size_t lane = 0; lane < lanes_; ++lane) {
    const Simulation& run = *runs_[lane < runs_.size() ? lane : 0];
    for (std::size_t i = 0; i < states_; ++i) all_[lanes_ * i + lane] = run.stepped_state()[i];
    if (lane >= runs_.size()) system_->freeze(lane);
  }
  integrator_->init(runs_.front()->time(), all_.data());
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    steps_.emplace_back(*integrator_, lanes_, lane, states_);
  }
}

bool SideBySide::advance(double t_end, const std::function<bool(double)>& keep_going) {
  auto asked = Stopwatch::now();
  bool going = true;
  while (going && left_ < runs_.size() && integrator_->time() < t_end) {
    step(t_end);
    if (Stopwatch::now() - asked <= kAskBeside) continue;
    count_time(asked);
    going = keep_going(integrator_->time());
    asked = Stopwatch::now();
  }
  count_time(asked);
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    hand_over(lane, integrator_->time(), integrator_->state());
  }
  counted_ = counters();
  wall_seconds_ = 0.0;
  return going;
}

Counters SideBySide::counters() const {
  Counters out = integrator_->counters();
  out += before_;
  return out;
}

void SideBySide::count_time(std::chrono::steady_clock::time_point since) {
  wall_seconds_ += std::chrono::duration<double>(Stopwatch::now() - since).count();
}

void SideBySide::step(double t_end) {
  const double smooth_until = kinks_.next(all_kinks_, *integrator_, integrator_->time());
  system_->set_curve_limit(smooth_until);
  const double stop = std::min(smooth_until, kink_at_);
  try {
    integrator_->step(std::min(stop, t_end));
    if (integrator_->is_adaptive()) stall_.step(integrator_->time());
  } catch (const IntegrationError& error) {
    return drop(error);
  }
  if (retake_to_kink()) return;
  if (!integrator_->is_adaptive()) leave_turning();
  record(smooth_until);
  const double strike = end_of_strike();
  if (integrator_->time() < stop && strike == std::numeric_limits<double>::infinity()) return;
  kink_at_ = strike;
  reset();
  watch_kinks();
}

/// As in a run by itself: where the next step is to end after one in which a lane struck something. Steps of
/// a given length are as long as was asked for.
double SideBySide::end_of_strike() const {
  double first = std::numeric_limits<double>::infinity();
  if (!integrator_->is_adaptive()) return first;
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    if (has_left(lane) || !runs_[lane]->has_switches()) continue;
    first = std::min(first, runs_[lane]->end_of_strike(integrator_->time(), integrator_->step_in_use()));
  }
  return first;
}

/// The lane that took the largest part in a failure is left, or all where it is not known or was left before.
/// The others choose their steps anew: that of the failure has collapsed.
void SideBySide::drop(const IntegrationError& error) {
  const std::size_t worst = error.component() % lanes_;
  const bool known = error.component() < states_ * lanes_ && worst < runs_.size() && !has_left(worst);
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    if (!known || lane == worst) leave(lane);
  }
  kink_at_ = std::numeric_limits<double>::infinity();
  before_ += integrator_->counters();
  std::copy_n(integrator_->state(), all_.size(), all_.data());
  integrator_->init(integrator_->time(), all_.data());
}

void SideBySide::LaneStep::update() {
  time_ = all_.time();
  previous_time_ = all_.previous_time();
  take(all_.state(), state_.data());
  take(all_.previous_state(), previous_state_.data());
}

void SideBySide::LaneStep::interpolate(double t, double* y) const {
  all_.interpolate(t, scratch_.data());
  take(scratch_.data(), y);
}

void SideBySide::LaneStep::take(const double* all, double* own) const {
  for (std::size_t i = 0; i < size(); ++i) own[i] = all[lanes_ * i + lane_];
}

/// Takes a step of all again in which a load of one passed a kink, up to the first of them. Whether it does.
bool SideBySide::retake_to_kink() {
  std::optional<double> first;
  std::size_t by = 0;
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    const std::optional<double> found = find_kink(lane);
    if (!found || (first && *first <= *found)) continue;
    first = found;
    by = lane;
  }
  if (!first) return false;
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    if (lane != by && !has_left(lane) && runs_[lane]->has_switches()) runs_[lane]->take_sides_back();
  }
  kink_at_ = *first;
  std::copy_n(integrator_->previous_state(), all_.size(), all_.data());
  integrator_->reset(integrator_->previous_time(), all_.data());
  return true;
}

/// Where the last step of a lane is to end. A lane that cannot be where the step took it goes on by itself
/// from its start, and tells why.
std::optional<double> SideBySide::find_kink(std::size_t lane) {
  Simulation& run = *runs_[lane];
  if (has_left(lane) || !run.has_switches()) return std::nullopt;
  steps_[lane].update();
  run.keep_sides();
  try {
    return run.find_kink(steps_[lane]);
  } catch (const std::domain_error&) {
    run.take_sides_back();
    leave_before_step(lane, kStuck);
    return std::nullopt;
  }
}

/// As in a run by itself: what turns too far in a step of given length goes back to its start, and tells it.
void SideBySide::leave_turning() {
  const double h = integrator_->time() - integrator_->previous_time();
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    if (has_left(lane) || h * system_->turning_rate(lane) <= kLargestTurn) continue;
    if (runs_[lane]->has_switches()) runs_[lane]->take_sides_back();
    leave_before_step(lane, "a body turns too far in a step");
  }
}

/// The sides at the start of the next step.
void SideBySide::watch_kinks() {
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    if (has_left(lane) || !runs_[lane]->has_switches()) continue;
    take_lane(integrator_->state(), lane, one_.data());
    try {
      runs_[lane]->watch_kinks(integrator_->time(), one_.data());
    } catch (const std::domain_error&) {
      hand_over(lane, integrator_->time(), integrator_->state());
      set_aside(lane, kStuck);
    }
  }
}

void SideBySide::leave(std::size_t lane) {
  if (has_left(lane)) return;
  hand_over(lane, integrator_->time(), integrator_->state());
  set_aside(lane, "its step beside the others failed");
}

void SideBySide::leave_before_step(std::size_t lane, const std::string& why) {
  hand_over(lane, integrator_->previous_time(), integrator_->previous_state());
  set_aside(lane, why);
}

void SideBySide::set_aside(std::size_t lane, const std::string& why) {
  runs_[lane]->set_aside(why);
  gone_[lane] = true;
  ++left_;
  system_->freeze(lane);
}

/// Drops the derivative's past: the next step is on the other side of a kink.
void SideBySide::reset() {
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    if (!has_left(lane)) runs_[lane]->end_stretch();
  }
  const double now = integrator_->time();
  std::copy_n(integrator_->state(), all_.size(), all_.data());
  system_->set_curve_limit(kinks_.next(all_kinks_, *integrator_, now));
  system_->project(now, all_.data(), false);
  integrator_->reset(now, all_.data());
}

void SideBySide::record(double smooth_until) {
  known_ = 0;
  for (std::size_t lane = 0; lane < runs_.size(); ++lane) {
    if (has_left(lane)) continue;
    const StepStates states{[&](double t, double* y) { take_lane(instant(t).state.data(), lane, y); },
                            [&](double t, const double* y) {
                              return runs_[lane]->take_solution(t, y, {solution_at(t).data(), lane, lanes_});
                            }};
    runs_[lane]->record_beside(integrator_->previous_time(), integrator_->time(), smooth_until, states);
  }
}

/// The state of all lanes at a time of the last step. Other lanes with this output find it made.
SideBySide::Instant& SideBySide::instant(double t) {
  for (std::size_t i = 0; i < known_; ++i) {
    if (instants_[i].time == t) return instants_[i];
  }
  if (known_ == instants_.size()) instants_.push_back({t, std::vector<double>(all_.size()), {}, false});
  Instant& out = instants_[known_++];
  out.time = t;
  out.solved = false;
  if (t >= integrator_->time()) {
    std::copy_n(integrator_->state(), all_.size(), out.state.data());
  } else {
    integrator_->interpolate(t, out.state.data());
  }
  return out;
}

/// What is solved for there: by the step itself, or anew.
const std::vector<double>& SideBySide::solution_at(double t) {
  Instant& at = instant(t);
  // A stage inside the step has the time of an output by chance, and another state.
  const bool met = t >= integrator_->time() && system_->evaluated_at() == t;
  if (!at.solved && !met) {
    std::ranges::copy(at.state, all_.begin());
    system_->project(t, all_.data(), false);
    system_->derivative(t, all_.data(), rate_.data());
  }
  if (!at.solved) system_->write_solution(at.solution);
  at.solved = true;
  return at.solution;
}

void SideBySide::take_lane(const double* all, std::size_t lane, double* y) const {
  for (std::size_t i = 0; i < states_; ++i) y[i] = all[lanes_ * i + lane];
}

/// To a run that has not left: its part of a state of all, its share of the time, and the steps, which are
/// those of all.
void SideBySide::hand_over(std::size_t lane, double t, const double* all) {
  if (has_left(lane)) return;
  take_lane(all, lane, one_.data());
  Counters taken = counters();
  taken -= counted_;
  runs_[lane]->go_on_from(t, one_.data(), taken, wall_seconds_ / static_cast<double>(runs_.size()));
}

}  // namespace seacrane
