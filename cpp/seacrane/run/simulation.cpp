#include "seacrane/run/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"

namespace seacrane {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kNever = std::numeric_limits<double>::infinity();

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const Model> model, const State& start, RunOptions options)
    : model_(std::move(model)),
      options_(std::move(options)),
      inputs_(*model_, checked_state(*model_, start).inputs),
      steppers_(model_, closed_limits(*model_, start), options_, inputs_),
      kinks_(options_.scaled_tolerance),
      outputs_(*model_, options_, rank_),
      event_time_(start.time),
      bodies_(start.values),
      state_(stepper().stepped.size()),
      forces_(2 * model_->limits.size()) {
  if (!model_->limits.empty()) {
    contacts_ = std::make_unique<Contacts>(*model_, [this](ClosedSet closed) -> Stepper& {
      return steppers_.of(closed, event_time_, bodies_.data());
    });
    contacts_->check(stepper(), start.time, start.values.data());
  }
  if (Switches::any(*model_)) {
    switches_ = std::make_unique<Switches>();
    kept_sides_ = std::make_unique<Switches>();
    ends_before_kinks_ = integrator_of(options_.integrator).residual_form;
  }
  put_on_constraints(start.time);
  end_of_smooth_stretch(start.time);
  stepper().bodies.start_histories(start.time, bodies_.data(), start.histories);
  outputs_.start(stepper(), start.time, bodies_.data());
  begin_steps(start);
  record_until(start.time);
}

void Simulation::put_on_constraints(double t) {
  MaximalSystem& system = stepper().system;
  system.project(t, bodies_.data(), false);
  const double open = constraint_residual(system.terms(), t, bodies_.data()).position;
  if (!(open <= kLargestResidual)) {
    throw std::invalid_argument("state: leaves joints or drivers open by " + to_text(open) +
                                " m or rad at t = " + to_text(t) +
                                " s; give a state of this scene at its own time");
  }
  stepper().bodies.check_merged(bodies_.data());
  system.take_residual_before_projection();
}

void Simulation::begin_steps(const State& start) {
  if (load_steps(stepper(), options_.integrator, start)) {
    if (start.record) {
      outputs_.continue_from(*start.record);
      if (contacts_) contacts_->continue_from(start.record->impact_loss);
    }
    stepper().started = true;
    watch_limits(true);
    if (switches_ && start.steps.kink && *start.steps.kink > start.time) switch_at_ = *start.steps.kink;
    return;
  }
  if (switches_) {
    stepper().read_bodies(start.time, bodies_.data(), state_.data());
    switches_->settle(stepper(), start.time, state_.data(), bodies_.data() + model_->layout.loads);
  }
  const ClosedSet closed = stepper().model->closed;
  step_from(start.time, contacts_ ? contacts_->settle(start.time, bodies_.data(), closed) : closed);
}

const std::vector<Event>& Simulation::events() const {
  static const std::vector<Event> none;
  return contacts_ ? contacts_->events() : none;
}

const std::vector<LimitReached>& Simulation::limits_reached() const {
  static const std::vector<LimitReached> none;
  return switches_ ? switches_->reached() : none;
}

/// Whether limits had an event in the last step: what has been stepped beyond it is dropped then.
bool Simulation::carry_out_event() {
  if (!contacts_) return false;
  const std::optional<double> found = contacts_->find(stepper());
  if (!found) return false;
  const double t = *found;
  record_until(t);
  take_step(t);
  outputs_.end_stretch();
  Stepper& at = stepper();
  state_.resize(at.stepped.size());
  integrator().interpolate(t, state_.data());
  at.stepped.project(t, state_.data(), false);
  if (switches_) switches_->shorten(t);
  settle(t);
  at.write_bodies(t, state_.data(), bodies_.data());
  event_time_ = t;
  end_of_smooth_stretch(t);
  ClosedSet closed = at.model->closed;
  try {
    closed = contacts_->carry_out(t, bodies_.data(), closed);
  } catch (...) {  // the run ends here, not beyond
    integrator().reset(t, state_.data());
    throw;
  }
  step_from(t, closed);
  return true;
}

/// Steps from bodies_ on, with the limits of a set.
void Simulation::step_from(double t, ClosedSet closed) {
  Stepper& next = steppers_.of(closed, event_time_, bodies_.data());
  // What the stepper of another set was left with, and what settling found, is no residual of the steps.
  outputs_.take_residual(stepper());
  next.stepped.take_residual_before_projection();
  steppers_.step_from(next, t, bodies_.data());
  watch_limits();
}

/// Lets states of loads jump in state_, where a step ended at t.
void Simulation::settle(double t) {
  if (!switches_) return;
  const std::size_t behind = model_->load_states.size() + 2;  // they stand before both integrals of work
  switches_->settle(stepper(), t, state_.data(), state_.data() + state_.size() - behind);
}

/// Restarts the derivative's history at the present state.
void Simulation::reset_integrator() {
  outputs_.end_stretch();
  state_.assign(integrator().state(), integrator().state() + stepper().stepped.size());
  integrator().reset(time(), state_.data());
}

/// Whether loads may have kinks inside a step, see retake_to_switch().
bool Simulation::steps_over_kinks() const {
  return switches_ && integrator().steps_lost_by_reset() > 0.0 && Switches::first_that_jumps(*model_).empty();
}

/// Takes a step that crossed a kink of a load again, up to the crossing: what was stepped has seen both
/// sides. Methods that lose much by a reset are left to their step control, which would lose it twice, but
/// for what they step over.
bool Simulation::retake_to_switch() {
  if (!switches_) return false;
  const std::optional<double> found =
      steps_over_kinks() ? switches_->find_between(stepper(), integrator(), ends_before_kinks_)
                         : switches_->find(stepper(), integrator());
  if (!found) return false;
  switch_at_ = *found;
  const double* const before = integrator().previous_state();
  state_.assign(before, before + stepper().stepped.size());
  integrator().reset(integrator().previous_time(), state_.data());
  return true;
}

/// `goes_on`: a run before this one came here.
void Simulation::watch_limits(bool goes_on) {
  switch_at_ = kNever;
  if (switches_ && goes_on) switches_->resume(stepper(), time(), integrator().state());
  if (switches_ && !goes_on) switches_->watch(stepper(), time(), integrator().state());
  if (!contacts_) return;
  write_bodies(bodies_.data());
  contacts_->start(stepper(), time(), bodies_.data());
}

/// Time of the next kink at which steps end: curves show their limit from the left until there.
double Simulation::end_of_smooth_stretch(double now) {
  const double end = kinks_.next(stepper().model->kinks, integrator(), now);
  set_curve_limit(stepper(), end);
  return end;
}

void Simulation::step(double limit) {
  Stepper& at = stepper();
  try {
    at.integrator->step(limit);
    require_finite(*at.integrator, at.stepped);
    outputs_.read_evaluation(at);
  } catch (const IntegrationError& error) {
    explain(error, at);
  }
  if (at.integrator->is_adaptive()) stall_.step(time());
  const Dependence found = at.stepped.take_dependence();
  if (!rank_.sees(found)) return;
  write_bodies(bodies_.data());
  rank_.keep(time(), found, at.stepped_model(), at.stepped_bodies(bodies_.data()));
}

/// A coordinate that turns keeps its joint closed however wrong it is: where no error is estimated, only the
/// turn itself can tell.
void Simulation::check_turning() const {
  const Terms& loads = stepper().loads;
  const double h = time() - integrator().previous_time();
  for (int b = 0; b < loads.model().body_count(); ++b) {
    const double turn = h * loads.bodies()[idx(b)].angular_velocity.norm();
    if (turn <= kLargestTurn) continue;
    throw std::domain_error("body '" + loads.model().bodies[idx(b)].name + "': turns by " + to_text(turn) +
                            " rad in one step of " + to_text(h) + " s at t = " + to_text(time()) +
                            " s: the step is too long for the method; give a smaller dt");
  }
}

/// After a step without an event. An output at a sample of histories comes after it, as in a run that
/// continues from there.
void Simulation::finish_step(double now, double smooth_until) {
  // The memory's load is smooth over a sample: no derivative is thrown away.
  const bool samples = now >= stepper().system.terms().histories().next_sample();
  if (samples) {
    record_until(std::nextafter(now, -kNever));
    write_bodies(bodies_.data());
    stepper().bodies.sample_histories(now, bodies_.data());
  }
  record_until(now);
  take_step(now);
  const double strike =
      switches_ && is_adaptive() ? switches_->end_of_strike(now, integrator().step_in_use()) : kNever;
  if (now < std::min(smooth_until, switch_at_) && strike == kNever &&
      !(switches_ && switches_->has_jumped())) {
    return;
  }
  // A curve or a load has a kink here: the next step starts on its other side, behind that of a curve or what
  // jumped with a fresh derivative.
  switch_at_ = strike;
  outputs_.end_stretch();
  end_of_smooth_stretch(now);
  state_.assign(integrator().state(), integrator().state() + stepper().stepped.size());
  stepper().stepped.project(now, state_.data(), false);
  settle(now);
  if (now < smooth_until && !samples) {
    integrator().begin_stretch(state_.data());
  } else {
    integrator().reset(now, state_.data());
  }
  if (switches_) switches_->watch(stepper(), now, state_.data());
}

/// The last step, or its part until an event, for least and largest values.
void Simulation::take_step(double to) {
  const bool is_whole = to >= time();
  if (contacts_ && is_whole) contacts_->read_forces(stepper(), forces_.data());
  outputs_.take_step(stepper(), to, contacts_ && is_whole ? forces_.data() : nullptr);
  if (steps_over_kinks()) outputs_.forget_stretch();
}

bool Simulation::advance(double t_end, const std::function<bool(double)>& keep_going) {
  if (!std::isfinite(t_end)) throw std::invalid_argument("t_end is not finite");
  auto asked = Clock::now();
  bool going = true;
  while (going && time() < t_end) {
    const double smooth_until = end_of_smooth_stretch(time());
    step(std::min({smooth_until, switch_at_, stepper().system.terms().histories().next_sample(), t_end}));
    const double now = time();
    if (retake_to_switch()) continue;  // asked after its step: a State does not hold the sides passed
    if (!is_adaptive()) check_turning();
    if (!carry_out_event()) finish_step(now, smooth_until);
    if (Clock::now() - asked >= options_.ask_every) {
      wall_seconds_ += seconds_since(asked);
      going = !keep_going || keep_going(time());
      asked = Clock::now();
    }
  }
  wall_seconds_ += seconds_since(asked);
  return going && time() >= t_end;
}

void Simulation::set_inputs(const std::vector<double>& slots) {
  inputs_.set(slots);
  inputs_.give_to(stepper());
  reset_integrator();
  watch_limits();
}

void Simulation::write_bodies(double* bodies) const {
  stepper().write_bodies(time(), integrator().state(), bodies);
}

State Simulation::state() {
  State out;
  out.time = time();
  out.values.resize(idx(model_->layout.size));
  write_bodies(out.values.data());
  outputs_.take_residual(stepper());
  out.inputs = inputs_.slots();
  out.histories = stepper().system.terms().histories().save();
  out.steps = save_steps(stepper(), options_.integrator);
  if (switch_at_ < kNever) out.steps.kink = switch_at_;
  out.closed = names_of(model_->limits, stepper().model->closed);
  out.record = outputs_.history(time(), energy_lost());
  out.parts = state_parts(*model_);
  return out;
}

void Simulation::record_beside(double from, double t, double curve_limit, const StepStates& states) {
  set_curve_limit(stepper(), curve_limit);
  outputs_.take_step_beside(stepper(), from, t, energy_lost(), states);
}

bool Simulation::take_solution(double t, const double* y, const LaneOf& solution) {
  stepper().bodies.recursive()->take_solution(t, y, solution);
  return false;
}

void Simulation::go_on_from(double t, const double* y, const Counters& taken, double wall_seconds) {
  beside_ += taken;
  wall_seconds_ += wall_seconds;
  if (t == time()) return;
  outputs_.end_stretch();
  state_.assign(y, y + stepper().stepped.size());
  integrator().reset(t, state_.data());
}

RunStatistics Simulation::statistics() const {
  RunStatistics out;
  out.counters = steppers_.counters();
  out.counters += beside_;
  out.dense_solves = steppers_.dense_solves();
  out.wall_seconds = wall_seconds_;
  out.energy_lost = energy_lost();
  out.rank = rank_.report();
  return out;
}

double KinkStops::next(const std::vector<Kink>& kinks, const Integrator& integrator, double now) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  while (next_ < kinks.size() && kinks[next_].time <= now) ++next_;
  if (next_ == kinks.size()) return kNone;
  const double h = integrator.step_in_use(), lost = integrator.steps_lost_by_reset();
  const auto from = kinks.begin() + static_cast<std::ptrdiff_t>(next_);
  const auto stop = std::find_if(from, kinks.end(), [&](const Kink& k) {
    return k.time - now > 2.0 * h || k.matters(h, scaled_tolerance_, lost);
  });
  return stop != kinks.end() && stop->time - now <= 2.0 * h ? stop->time : kNone;
}

}  // namespace seacrane
