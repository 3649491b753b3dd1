#include "seacrane/run/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "seacrane/compile/compile.hpp"

namespace seacrane {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kAskInterval{20};
constexpr double kLargestTurn = 3.14159265358979323846;  // rad in one step: no method resolves more
constexpr double kClosed = 1e-6;  // m, rad: a state that projection leaves open by more is none

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void add(const Counters& more, Counters& sum) {
  sum.steps += more.steps;
  sum.rejected_steps += more.rejected_steps;
  sum.evaluations += more.evaluations;
  sum.jacobians += more.jacobians;
  sum.newton_iterations += more.newton_iterations;
  sum.projections += more.projections;
  sum.restarts += more.restarts;
}

/// The set that holds at the start is the assembled model itself, wherever a run began: its rank is known.
std::shared_ptr<const Model> model_of(const std::shared_ptr<const Model>& model, ClosedSet closed) {
  return closed == model->closed ? model : compile_set(*model, closed);
}

ClosedSet closed_at(const Model& model, const State& start) {
  return start.closed ? set_of(model.limits, *start.closed) : model.closed;
}

}  // namespace

State initial_state(const Model& model) {
  State out;
  out.values = model.initial_state;
  out.inputs.assign(idx(model.slot_count), 0.0);
  out.closed = names_of(model.limits, model.closed);
  out.parts = state_parts(model);
  return out;
}

Simulation::Simulation(std::shared_ptr<const Model> model, State start, RunOptions options)
    : model_(std::move(model)),
      options_(std::move(options)),
      recording_(*model_, options_.channels,
                 options_.capacity > 0 ? options_.capacity : options_.output_times.size()),
      energy_(options_.energy_limit),
      inputs_(start.inputs),
      output_state_(start.values),
      rate_(start.values.size(), 0.0) {
  if (!start.parts.empty()) check_state_parts(*model_, start.parts);
  if (options_.energy_limit > 0.0 && model_->paper_kinematics) {
    throw std::invalid_argument(
        "energy_limit: kinematics 'paper' has no energy balance; leave energy_limit out");
  }
  if (start.values.size() != idx(model_->layout.size)) {
    throw std::invalid_argument("state: has " + std::to_string(start.values.size()) +
                                " values, the model needs " + std::to_string(model_->layout.size));
  }
  for (double v : start.values) {
    if (!std::isfinite(v)) throw std::invalid_argument("state: holds a value that is not finite");
  }
  output_time_ = start.time;
  steppers_.push_back(std::make_unique<Stepper>(model_of(model_, closed_at(*model_, start)), options_));
  now_ = steppers_.front().get();
  stepped_state_.resize(now_->stepped.size());
  check_inputs(inputs_);
  apply_inputs();
  if (!model_->limits.empty()) {
    contacts_ =
        std::make_unique<Contacts>(*model_, [this](ClosedSet set) -> Stepper& { return stepper_of(set); });
    contacts_->check(*now_, start.time, start.values.data());
  }
  if (Switches::any(*model_)) switches_ = std::make_unique<Switches>();
  RedundantSystem& system = now_->system;
  double* const bodies = output_state_.data();
  system.project(start.time, bodies, false);
  const double open = system.residual(start.time, bodies).position;
  if (!(open <= kClosed)) {
    throw std::invalid_argument("state: leaves joints or drivers open by " + to_text(open) +
                                " m or rad at t = " + to_text(start.time) +
                                " s; give a state of this scene at its own time");
  }
  system.take_residual_before_projection();
  find_stop(start.time);
  start_histories(*now_, start.time, bodies, start.histories);
  start_energy_ = system.energy(start.time, bodies);
  start_work_ = output_state_[idx(model_->layout.work)];
  if (resume(start)) {
    if (start.record) resume(*start.record);
    now_->started = true;
    watch_limits();
  } else {
    const ClosedSet closed = now_->model->closed;
    go_on(start.time, contacts_ ? contacts_->settle(start.time, bodies, closed) : closed);
  }
  while (next_output_ < options_.output_times.size() && options_.output_times[next_output_] < start.time) {
    ++next_output_;
  }
  record_until(start.time);
}

/// Goes on from the integrator's own state where the history belongs to this formulation and integrator and
/// to exactly these values, inputs and scene.
bool Simulation::resume(const State& given) {
  const StepHistory& history = given.steps;
  if (history.formulation != now_->stepped.name() || history.integrator != options_.integrator) return false;
  now_->stepped.read_bodies(given.time, given.values.data(), stepped_state_.data());
  integrator().init(given.time, stepped_state_.data());
  if (integrator().save().size() != history.values.size()) return false;
  integrator().load(history.values);
  std::vector<double> present(given.values.size());
  write_present(present.data());
  return time() == given.time && present == given.values && present_rate() == history.rate;
}

void Simulation::resume(const RecordHistory& record) {
  start_energy_ = record.start_energy;
  start_work_ = record.start_work;
  open_ = record.open;
  recording_.go_on_from(record.quaternions);
  if (contacts_) contacts_->go_on_from(record.impact_loss);
}

std::vector<double> Simulation::present_rate() const {
  std::vector<double> out(now_->stepped.size());
  now_->stepped.derivative(time(), integrator().state(), out.data());
  return out;
}

const std::vector<Event>& Simulation::events() const {
  static const std::vector<Event> none;
  return contacts_ ? contacts_->events() : none;
}

Stepper& Simulation::stepper_of(ClosedSet closed) {
  if (now_->model->closed == closed) return *now_;
  const auto known = std::find_if(steppers_.begin(), steppers_.end(),
                                  [&](const auto& s) { return s->model->closed == closed; });
  const bool fresh = known == steppers_.end();
  if (fresh) steppers_.push_back(std::make_unique<Stepper>(model_of(model_, closed), options_));
  Stepper& at = fresh ? *steppers_.back() : **known;
  for (RedundantSystem* system : {&at.system, &at.loads}) {
    system->set_inputs(inputs_);
    system->set_curve_limit(now_->system.curve_limit());
  }
  const auto histories = now_->system.histories();
  if (!histories.empty()) start_histories(at, output_time_, output_state_.data(), histories);
  return at;
}

/// Whether limits had an event in the last step: what has been stepped beyond it is dropped then.
bool Simulation::pass_event() {
  const std::optional<double> found = contacts_->find(*now_);
  if (!found) return false;
  const double t = output_time_ = *found;
  record_until(t);
  integrator().interpolate(t, stepped_state_.data());
  now_->stepped.project(t, stepped_state_.data(), false);
  now_->stepped.write_bodies(t, stepped_state_.data(), output_state_.data());
  find_stop(t);
  ClosedSet closed = now_->model->closed;
  try {
    closed = contacts_->pass(t, output_state_.data(), closed);
  } catch (...) {  // the run ends here, not beyond
    integrator().reset(t, stepped_state_.data());
    throw;
  }
  go_on(t, closed);
  return true;
}

/// Steps from output_state_ on, with other limits. Another stepper starts afresh: what it kept from the last
/// time its set held would be missing in a run that goes on from a State.
void Simulation::go_on(double t, ClosedSet closed) {
  Stepper& next = stepper_of(closed);
  const bool same = &next == now_ && next.started;
  // What another set's stepper was left with, and what settling found, is no residual of the steps.
  keep_open();
  next.stepped.take_residual_before_projection();
  now_ = &next;
  stepped_state_.resize(now_->stepped.size());
  now_->stepped.read_bodies(t, output_state_.data(), stepped_state_.data());
  if (same) {
    integrator().reset(t, stepped_state_.data());
  } else {
    if (now_->started) add(integrator().counters(), before_);
    integrator().init(t, stepped_state_.data());
    now_->started = true;
  }
  watch_limits();
}

/// Takes a step that crossed a kink of a load again, up to the crossing: what was stepped has seen both
/// sides. Methods that lose much by a reset are left to their step control: they would lose it twice.
bool Simulation::step_back() {
  if (!switches_ || integrator().steps_lost_by_reset() > 0.0) return false;
  const std::optional<double> found = switches_->find(*now_);
  if (!found) return false;
  switch_at_ = *found;
  std::copy_n(integrator().previous_state(), stepped_state_.size(), stepped_state_.data());
  integrator().reset(integrator().previous_time(), stepped_state_.data());
  return true;
}

void Simulation::watch_limits() {
  switch_at_ = std::numeric_limits<double>::infinity();
  if (switches_) switches_->watch(*now_, time(), integrator().state());
  if (!contacts_) return;
  write_present(output_state_.data());
  contacts_->start(*now_, time(), output_state_.data());
}

/// Time of the next kink that matters to a step of the present length. Those beyond it are left to the steps
/// that come near them: the integrator must know of a stop a little beyond its step, no further.
double Simulation::find_stop(double now) {
  const std::vector<Kink>& kinks = now_->model->kinks;
  while (next_kink_ < kinks.size() && kinks[next_kink_].time <= now) ++next_kink_;
  double stop = std::numeric_limits<double>::infinity();
  if (next_kink_ < kinks.size()) {
    const double h = integrator().step_in_use(), lost = integrator().steps_lost_by_reset();
    const auto here = kinks.begin() + static_cast<std::ptrdiff_t>(next_kink_);
    const auto far = std::find_if(here, kinks.end(), [&](const Kink& k) {
      return k.time - now > 2.0 * h || k.matters(h, options_.tolerance, lost);
    });
    if (far != kinks.end() && far->time - now <= 2.0 * h) stop = far->time;
  }
  now_->system.set_curve_limit(stop);
  now_->loads.set_curve_limit(stop);
  return stop;
}

void Simulation::apply_inputs() {
  now_->system.set_inputs(inputs_);
  now_->loads.set_inputs(inputs_);
}

/// One history of the vessel's motion for the steps and the outputs: two would differ by rounding, and a run
/// that goes on from one of them would too.
void Simulation::start_histories(Stepper& at, double t, const double* bodies,
                                 const std::vector<TwistHistory>& histories) {
  at.loads.start_histories(t, at.stepped_bodies(bodies), histories);
  if (&at.loads != &at.system) at.system.take_histories(at.loads);
}

void Simulation::sample_histories(double now) {
  write_present(output_state_.data());
  now_->loads.sample(now, now_->stepped_bodies(output_state_.data()));
  if (&now_->loads != &now_->system) now_->system.take_histories(now_->loads);
}

void Simulation::report_open(double t) const {
  double worst = -1.0;
  std::string name;
  for (std::size_t e = 0; e < now_->model->elements.size(); ++e) {
    const ElementModel& element = now_->model->elements[e];
    if (element.rows == 0) continue;
    const double open = now_->system.blocks()[e].phi.head(element.rows).cwiseAbs().maxCoeff();
    if (open > worst || std::isnan(open)) {
      worst = open;
      name = element.name;
    }
  }
  throw std::domain_error("joint or driver '" + name + "': is open by " + to_text(worst) +
                          " m or rad at t = " + to_text(t) +
                          " s and projection does not close it: the step is too long for the method, or "
                          "constraints nearly depend on each other there; give a smaller dt or rtol, or move "
                          "nearly coincident joints apart");
}

void Simulation::write(double t, double* y, Recording& out) {
  RedundantSystem& system = now_->system;
  Formulation& stepped = now_->stepped;
  stepped.project(t, y, false);
  keep_open();
  const double before = std::exchange(open_, 0.0);
  written_ = {t, before};
  double* const bodies = output_state_.data();
  stepped.write_bodies(t, y, bodies);
  if (out.wants_solution()) {
    system.derivative(t, bodies, rate_.data());
    // The tree factors no constraints of its own joints.
    if (now_->other) watch_rank_at(t, bodies);
  } else {
    system.evaluate_terms(t, bodies, rate_.data());
  }
  const ConstraintResidual after = system.residual_here(bodies);
  if (!(after.position <= kClosed)) report_open(t);
  const double energy = model_->paper_kinematics ? 0.0 : system.energy_here(t, bodies);
  const double work = bodies[model_->layout.work] - start_work_;
  const double impact_loss = contacts_ ? contacts_->energy_lost() : 0.0;
  const double balance = energy - start_energy_ - work;
  out.append(t, bodies, system, {after, before, balance, impact_loss});
  energy_.check(t, bodies, system, balance, bodies[model_->layout.work + 1], energy);
}

void Simulation::keep_open() { open_ = std::max(open_, now_->stepped.take_residual_before_projection()); }

void Simulation::record_until(double t) {
  const auto& times = options_.output_times;
  while (next_output_ < times.size() && times[next_output_] <= t) {
    const double at = times[next_output_++];
    if (at >= integrator().time()) {
      std::copy_n(integrator().state(), stepped_state_.size(), stepped_state_.data());
    } else {
      integrator().interpolate(at, stepped_state_.data());
    }
    write(at, stepped_state_.data(), recording_);
  }
}

void Simulation::step(double limit) {
  try {
    integrator().step(limit);
    require_finite(integrator(), now_->stepped);
  } catch (const IntegrationError& error) {
    explain(error, integrator(), now_->stepped, now_->system);
  }
  if (integrator().is_adaptive()) stall_.step(time());
  const Dependence found = now_->stepped.take_dependence();
  if (!rank_.sees(found)) return;
  write_present(output_state_.data());
  rank_.keep(time(), found, now_->stepped_model(), now_->stepped_bodies(output_state_.data()));
}

/// At an output, of the rows described: those that are stepped are fewer in the recursive form.
void Simulation::watch_rank_at(double t, const double* bodies) {
  if (now_->stepped.take_dependence().ratio > 0.0) return;
  const Dependence found = now_->system.take_dependence();
  if (rank_.sees(found)) rank_.keep(t, found, now_->model, bodies);
}

/// A coordinate that turns keeps its joint closed however wrong it is: where no error is estimated, only the
/// turn itself can tell.
void Simulation::check_turning() const {
  const double h = integrator().time() - integrator().previous_time();
  for (int b = 0; b < now_->loads.model().body_count(); ++b) {
    const double turn = h * now_->loads.bodies()[idx(b)].angular_velocity.norm();
    if (turn <= kLargestTurn) continue;
    throw std::domain_error("body '" + now_->loads.model().bodies[idx(b)].name + "': turns by " +
                            to_text(turn) + " rad in one step of " + to_text(h) +
                            " s at t = " + to_text(integrator().time()) +
                            " s: the step is too long for the method; give a smaller dt");
  }
}

/// The end of a step that went as far as it should. An output at a sample comes after it, as in a run that
/// goes on from there.
void Simulation::land(double now, double stop) {
  // The memory's load goes on smoothly over a sample: no derivative is thrown away.
  if (now >= now_->system.next_sample()) {
    record_until(std::nextafter(now, -std::numeric_limits<double>::infinity()));
    sample_histories(now);
  }
  record_until(now);
  if (now < stop) return;
  // A curve or a load has a kink here: go on from the other side with a fresh derivative.
  switch_at_ = std::numeric_limits<double>::infinity();
  find_stop(now);
  std::copy_n(integrator().state(), stepped_state_.size(), stepped_state_.data());
  now_->stepped.project(now, stepped_state_.data(), false);
  integrator().reset(now, stepped_state_.data());
}

bool Simulation::advance(double t_end, const std::function<bool(double)>& keep_going) {
  if (!std::isfinite(t_end)) throw std::invalid_argument("t_end is not finite");
  const auto start = Clock::now();
  auto asked = start;
  bool going = true;
  while (going && integrator().time() < t_end) {
    const double stop = std::min(find_stop(integrator().time()), switch_at_);
    step(std::min({stop, now_->system.next_sample(), t_end}));
    const double now = integrator().time();
    if (step_back()) continue;
    if (!integrator().is_adaptive()) check_turning();
    if (!contacts_ || !pass_event()) land(now, stop);
    if (Clock::now() - asked > kAskInterval) {
      wall_seconds_ += seconds_since(asked);
      going = !keep_going || keep_going(integrator().time());
      asked = Clock::now();
    }
  }
  wall_seconds_ += seconds_since(asked);
  return going && integrator().time() >= t_end;
}

void Simulation::check_inputs(const std::vector<double>& slots) const {
  if (slots.size() != static_cast<std::size_t>(model_->slot_count)) {
    throw std::invalid_argument("inputs: " + std::to_string(slots.size()) + " values given, the model has " +
                                std::to_string(model_->slot_count) + " slots");
  }
  for (double v : slots) {
    if (!std::isfinite(v)) throw std::invalid_argument("inputs: hold a value that is not finite");
  }
}

void Simulation::set_inputs(const std::vector<double>& slots) {
  check_inputs(slots);
  inputs_ = slots;
  apply_inputs();
  std::copy_n(integrator().state(), stepped_state_.size(), stepped_state_.data());
  integrator().reset(integrator().time(), stepped_state_.data());
  watch_limits();
}

Recording Simulation::snapshot() {
  const std::vector<std::string> names = channel_names(*model_, false);
  Recording out(*model_, {names.begin(), names.end()}, 1);
  std::copy_n(integrator().state(), stepped_state_.size(), stepped_state_.data());
  keep_open();
  const double open = open_;
  const Written written = written_;
  write(integrator().time(), stepped_state_.data(), out);
  open_ = open;
  written_ = written;
  return out;
}

void Simulation::write_present(double* bodies) const {
  now_->stepped.write_bodies(integrator().time(), integrator().state(), bodies);
}

State Simulation::state() {
  std::vector<double> values(idx(model_->layout.size));
  write_present(values.data());
  keep_open();
  // A run that goes on writes an output at its start once more.
  const double open = written_.time == time() ? std::max(open_, written_.open) : open_;
  return {time(),
          std::move(values),
          inputs_,
          now_->system.histories(),
          {now_->stepped.name(), options_.integrator, integrator().save(), present_rate()},
          names_of(model_->limits, now_->model->closed),
          RecordHistory{start_energy_, start_work_, open, contacts_ ? contacts_->energy_lost() : 0.0,
                        recording_.last_quaternions()},
          state_parts(*model_)};
}

RunStatistics Simulation::statistics() const {
  RunStatistics out;
  out.counters = before_;
  out.wall_seconds = wall_seconds_;
  for (const auto& stepper : steppers_) {
    if (stepper->started) add(stepper->integrator->counters(), out.counters);
    out.dense_solves += stepper->system.dense_solves();
    if (&stepper->loads != &stepper->system) out.dense_solves += stepper->loads.dense_solves();
  }
  if (contacts_) out.energy_lost = contacts_->energy_lost();
  out.rank = rank_.report();
  return out;
}

}  // namespace seacrane
