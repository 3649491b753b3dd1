#include "seacrane/run/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "seacrane/dynamics/merged.hpp"
#include "seacrane/model/validate.hpp"

namespace seacrane {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kAskInterval{20};
constexpr double kLargestTolerance = 0.1;  // beyond, an error estimate of one step means nothing
constexpr double kLargestTurn = 3.14159265358979323846;  // rad in one step: no method resolves more
constexpr double kClosed = 1e-6;  // m, rad: a state that projection leaves open by more is none

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

IntegratorOptions integrator_options(const Formulation& stepped, const RunOptions& run) {
  if (!(run.tolerance > 0.0) || !(run.tolerance <= kLargestTolerance)) {
    throw std::invalid_argument("rtol is " + to_text(run.tolerance) +
                                "; give a positive number up to 0.1, e.g. 1e-6");
  }
  IntegratorOptions out;
  out.name = run.integrator;
  out.relative_tolerance = 0.0;
  out.absolute_tolerance = stepped.scale();
  for (double& value : out.absolute_tolerance) value *= run.tolerance;
  out.fixed_step = run.fixed_step;
  out.max_step = run.max_step;
  out.spectral_radius = run.spectral_radius;
  return out;
}

}  // namespace

State initial_state(const Model& model) {
  return {
      0.0, model.initial_state, std::vector<double>(static_cast<std::size_t>(model.slot_count), 0.0), {}, {}};
}

Simulation::Simulation(std::shared_ptr<const Model> model, State start, RunOptions options)
    : model_(std::move(model)),
      options_(std::move(options)),
      system_(model_),
      reduced_(make_formulation(options_.formulation, system_)),
      stepped_(reduced_ ? *reduced_ : system_),
      loads_(stepped_.loads_from()),
      residual_(loads_),
      integrator_(make_integrator(stepped_, options_.formulation == "redundant" ? &residual_ : nullptr,
                                  integrator_options(stepped_, options_))),
      recording_(*model_, options_.channels, options_.output_times.size()),
      inputs_(start.inputs),
      stepped_state_(stepped_.size(), 0.0),
      output_state_(start.values),
      merged_state_(loads_.size(), 0.0),
      rate_(start.values.size(), 0.0) {
  if (start.values.size() != static_cast<std::size_t>(model_->layout.size)) {
    throw std::invalid_argument("state: has " + std::to_string(start.values.size()) +
                                " values, the model needs " + std::to_string(model_->layout.size));
  }
  for (double v : start.values) {
    if (!std::isfinite(v)) throw std::invalid_argument("state: holds a value that is not finite");
  }
  check_inputs(inputs_);
  apply_inputs();
  const State given = start;
  system_.project(start.time, start.values.data(), false);
  const double open = system_.residual(start.time, start.values.data()).position;
  if (!(open <= kClosed)) {
    throw std::invalid_argument("state: leaves joints or drivers open by " + to_text(open) +
                                " m or rad; give a state of this scene at its own time");
  }
  system_.take_residual_before_projection();
  start_histories(start);
  start_energy_ = system_.energy(start.time, start.values.data());
  start_work_ = start.values[static_cast<std::size_t>(model_->layout.work)];
  if (!resume(given)) {
    stepped_.read_bodies(start.time, start.values.data(), stepped_state_.data());
    integrator_->init(start.time, stepped_state_.data());
  }
  next_jump();
  while (next_output_ < options_.output_times.size() && options_.output_times[next_output_] < start.time) {
    ++next_output_;
  }
  record_until(start.time);
}

/// Goes on from the integrator's own state where the history belongs to this formulation and integrator and
/// to exactly these values, inputs and scene.
bool Simulation::resume(const State& given) {
  const StepHistory& history = given.steps;
  if (history.formulation != stepped_.name() || history.integrator != options_.integrator) return false;
  stepped_.read_bodies(given.time, given.values.data(), stepped_state_.data());
  integrator_->init(given.time, stepped_state_.data());
  if (integrator_->save().size() != history.values.size()) return false;
  integrator_->load(history.values);
  write_present(output_state_.data());
  return integrator_->time() == given.time && output_state_ == given.values && present_rate() == history.rate;
}

std::vector<double> Simulation::present_rate() const {
  std::vector<double> out(stepped_.size());
  stepped_.derivative(integrator_->time(), integrator_->state(), out.data());
  return out;
}

/// Time of the next jump of a reference curve.
double Simulation::next_jump() {
  const auto& stops = model_->breakpoints;
  while (next_breakpoint_ < stops.size() && stops[next_breakpoint_] <= integrator_->time())
    ++next_breakpoint_;
  const double stop =
      next_breakpoint_ < stops.size() ? stops[next_breakpoint_] : std::numeric_limits<double>::infinity();
  system_.set_curve_limit(stop);
  loads_.set_curve_limit(stop);
  return stop;
}

void Simulation::apply_inputs() {
  system_.set_inputs(inputs_);
  loads_.set_inputs(inputs_);
}

const double* Simulation::stepped_bodies(const double* bodies) {
  if (&loads_ == &system_) return bodies;
  merge_state(*model_, loads_.model(), bodies, merged_state_.data());
  return merged_state_.data();
}

/// One history of the vessel's motion for the steps and the outputs: two would differ by rounding, and a run
/// that goes on from one of them would too.
void Simulation::start_histories(const State& start) {
  loads_.start_histories(start.time, stepped_bodies(start.values.data()), start.histories);
  if (&loads_ != &system_) system_.take_histories(loads_);
}

void Simulation::sample_histories(double now) {
  write_present(output_state_.data());
  loads_.sample(now, stepped_bodies(output_state_.data()));
  if (&loads_ != &system_) system_.take_histories(loads_);
}

void Simulation::report_open(double t) const {
  double worst = -1.0;
  std::string name;
  for (std::size_t e = 0; e < model_->elements.size(); ++e) {
    const ElementModel& element = model_->elements[e];
    if (element.rows == 0) continue;
    const double open = system_.blocks()[e].phi.head(element.rows).cwiseAbs().maxCoeff();
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
  stepped_.project(t, y, false);
  const double before = stepped_.take_residual_before_projection();
  double* const bodies = output_state_.data();
  stepped_.write_bodies(t, y, bodies);
  if (out.wants_solution()) {
    system_.derivative(t, bodies, rate_.data());
  } else {
    system_.evaluate_terms(t, bodies, rate_.data());
  }
  const ConstraintResidual after = system_.residual_here(bodies);
  if (!(after.position <= kClosed)) report_open(t);
  const double energy = model_->paper_kinematics ? 0.0 : system_.energy_here(t, bodies);
  const double work = bodies[model_->layout.work] - start_work_;
  out.append(t, bodies, system_, after, before, energy - start_energy_ - work);
}

void Simulation::record_until(double t) {
  const auto& times = options_.output_times;
  while (next_output_ < times.size() && times[next_output_] <= t) {
    const double at = times[next_output_++];
    if (at >= t) {
      std::copy_n(integrator_->state(), stepped_state_.size(), stepped_state_.data());
    } else {
      integrator_->interpolate(at, stepped_state_.data());
    }
    write(at, stepped_state_.data(), recording_);
  }
}

void Simulation::step(double limit) {
  try {
    integrator_->step(limit);
  } catch (const IntegrationError& error) {
    std::string text = error.reason();
    if (error.component() != IntegrationError::no_component && error.component() < stepped_.size()) {
      text += ", worst in the " + stepped_.describe(error.component());
    }
    throw IntegrationError(error.method(), error.time(), error.step_size(), error.component(), text);
  }
}

/// A coordinate that turns keeps its joint closed however wrong it is: where no error is estimated, only the
/// turn itself can tell.
void Simulation::check_turning() const {
  const double h = integrator_->time() - integrator_->previous_time();
  for (int b = 0; b < loads_.model().body_count(); ++b) {
    const double turn = h * loads_.bodies()[idx(b)].angular_velocity.norm();
    if (turn <= kLargestTurn) continue;
    throw std::domain_error("body '" + loads_.model().bodies[idx(b)].name + "': turns by " + to_text(turn) +
                            " rad in one step of " + to_text(h) +
                            " s at t = " + to_text(integrator_->time()) +
                            " s: the step is too long for the method; give a smaller dt");
  }
}

bool Simulation::advance(double t_end, const std::function<bool(double)>& keep_going) {
  if (!std::isfinite(t_end)) throw std::invalid_argument("t_end is not finite");
  const auto start = Clock::now();
  auto asked = start;
  bool going = true;
  while (going && integrator_->time() < t_end) {
    const double jump = next_jump();
    step(std::min({jump, system_.next_sample(), t_end}));
    const double now = integrator_->time();
    if (!integrator_->is_adaptive()) check_turning();
    record_until(now);
    // The memory's load goes on smoothly over a sample: no derivative is thrown away.
    if (now >= system_.next_sample()) sample_histories(now);
    if (now >= jump) {
      // A curve jumps here: go on from the other side with a fresh derivative.
      next_jump();
      std::copy_n(integrator_->state(), stepped_state_.size(), stepped_state_.data());
      stepped_.project(now, stepped_state_.data(), false);
      integrator_->reset(now, stepped_state_.data());
    }
    if (Clock::now() - asked > kAskInterval) {
      wall_seconds_ += seconds_since(asked);
      going = !keep_going || keep_going(integrator_->time());
      asked = Clock::now();
    }
  }
  wall_seconds_ += seconds_since(asked);
  return going && integrator_->time() >= t_end;
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
  std::copy_n(integrator_->state(), stepped_state_.size(), stepped_state_.data());
  integrator_->reset(integrator_->time(), stepped_state_.data());
}

Recording Simulation::snapshot() {
  const std::vector<std::string> names = channel_names(*model_, false);
  Recording out(*model_, {names.begin(), names.end()}, 1);
  std::copy_n(integrator_->state(), stepped_state_.size(), stepped_state_.data());
  write(integrator_->time(), stepped_state_.data(), out);
  return out;
}

void Simulation::write_present(double* bodies) const {
  stepped_.write_bodies(integrator_->time(), integrator_->state(), bodies);
}

State Simulation::state() const {
  std::vector<double> values(idx(model_->layout.size));
  write_present(values.data());
  return {integrator_->time(),
          std::move(values),
          inputs_,
          system_.histories(),
          {stepped_.name(), options_.integrator, integrator_->save(), present_rate()}};
}

RunStatistics Simulation::statistics() const {
  long dense = system_.dense_solves();
  if (&loads_ != &system_) dense += loads_.dense_solves();
  return {integrator_->counters(), dense, wall_seconds_};
}

}  // namespace seacrane
