#include "seacrane/run/output_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "seacrane/dynamics/energy.hpp"
#include "seacrane/elements/check.hpp"

namespace seacrane {
namespace {

[[noreturn]] void report_open_joint(const Terms& terms, double t) {
  double worst = -1.0;
  std::string name;
  for (std::size_t e = 0; e < terms.model().elements.size(); ++e) {
    const ElementModel& element = terms.model().elements[e];
    if (element.rows == 0) continue;
    const double open = terms.blocks()[e].phi.head(element.rows).cwiseAbs().maxCoeff();
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

}  // namespace

OutputSampler::OutputSampler(const Model& model, const RunOptions& options, RankWatch& rank)
    : model_(model),
      rank_(rank),
      energy_(options.energy_limit),
      times_(options.output_times),
      recording_(model, options.channels, options.capacity.value_or(options.output_times.size()),
                 options.extremes),
      extremes_(model, recording_, options.trail),
      bodies_(idx(model.layout.size), 0.0),
      rate_(idx(model.layout.size), 0.0),
      tensions_(VecXd::Zero(model.inertial_tensions)),
      coordinates_(model.coordinates.size()),
      one_load_(idx(model.body_count() + 1)) {
  if (options.energy_limit && model.paper_kinematics) {
    throw std::invalid_argument(
        "energy_limit: kinematics 'paper' has no energy balance; leave energy_limit out");
  }
}

void OutputSampler::start(Stepper& at, double t, const double* bodies) {
  while (next_ < times_.size() && times_[next_] < t) ++next_;
  start_energy_ = mechanical_energy_at(at.system.terms(), t, bodies);
  start_work_ = bodies[model_.layout.work];
}

void OutputSampler::continue_from(const RecordHistory& history) {
  start_energy_ = history.start_energy;
  start_work_ = history.start_work;
  largest_residual_ = history.residual;
  recording_.set_last("quaternion", history.quaternions);
  extremes_.load(history.extremes);
}

RecordHistory OutputSampler::history(double t, double impact_loss) const {
  // A run that continues from an output writes it once more.
  const double residual = last_time_ == t ? std::max(largest_residual_, last_residual_) : largest_residual_;
  return {start_energy_, start_work_, residual, impact_loss, recording_.last("quaternion"), extremes_.save()};
}

void OutputSampler::take_residual(Stepper& at) {
  largest_residual_ = std::max(largest_residual_, at.stepped.take_residual_before_projection());
}

/// Projects state_, and returns the largest residual before projection since the last output.
double OutputSampler::project(Stepper& at, double t) {
  at.stepped.project(t, state_.data(), false);
  return std::max(largest_residual_, at.stepped.take_residual_before_projection());
}

/// What is stepped has accelerations, tensions of quasi-static lines, and forces that hold: whether all that
/// are asked for.
bool OutputSampler::evaluate_stepped(Stepper& at, double t, const Needs& needs, const StepStates& states) {
  if (!states.solve(t, state_.data())) at.stepped.place_bodies(t, state_.data());
  if (needs.accelerations) accelerations_ = at.bodies.accelerations();
  tensions_ = at.loads.inertial();
  if (!needs.held) return true;
  held_.read_stepped(at);
  return held_.known();
}

/// The described system at state_, as far as the channels need it. Where kinematics are enough, bodies_ gets
/// no poses.
ConstraintResidual OutputSampler::evaluate(Stepper& at, double t, const Needs& needs,
                                           const StepStates& states) {
  const bool moves = !needs.solution && (needs.accelerations || needs.held),
             solves = needs.solution || (moves && !evaluate_stepped(at, t, needs, states));
  Terms& terms = at.system.terms();
  if (at.stepped.closes_joints() && !(solves || needs.residual || needs.loads || needs.energy)) {
    moves ? at.bodies.spread() : at.bodies.place(t, state_.data());
    const auto memory = bodies_.begin() + model_.layout.memory;
    std::copy(state_.end() - (bodies_.end() - memory), state_.end(), memory);
    terms.set_inertial(tensions_);
    return {0.0, 0.0};
  }
  at.write_bodies(t, state_.data(), bodies_.data());
  if (solves) {
    at.system.derivative(t, bodies_.data(), rate_.data());
    if (needs.reactions || needs.held) at.system.shorten_multipliers();
    accelerations_ = at.system.accelerations();
    held_.read_described(at);
    // The tree factors no constraints of its own joints.
    if (&at.stepped != &at.system) watch_rank(at, t);
    return constraint_residual(terms, bodies_.data());
  }
  const bool loads = needs.loads || needs.energy;
  if (loads) terms.evaluate(t, bodies_.data(), rate_.data());
  terms.set_inertial(tensions_);
  return loads ? constraint_residual(terms, bodies_.data()) : constraint_residual(terms, t, bodies_.data());
}

void OutputSampler::evaluate_coordinates(const Terms& terms) {
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const CoordinateData& c = terms.model().coordinates[i];
    const auto& bodies = terms.bodies();
    coordinates_[i] = evaluate_coordinate(c, bodies[idx(c.joint.first)], bodies[idx(c.joint.second)]);
  }
}

/// Watches the rank of the rows described: fewer rows are stepped in the recursive form.
void OutputSampler::watch_rank(Stepper& at, double t) {
  if (at.stepped.take_dependence().ratio > 0.0) return;
  const Dependence found = at.system.take_dependence();
  if (rank_.sees(found)) rank_.keep(t, found, at.model, bodies_.data());
}

void OutputSampler::write(Stepper& at, double t, double residual_before, double impact_loss,
                          const StepStates& states, Recording& out) {
  Needs needs = out.needs();
  needs.energy = needs.energy || energy_.has_limit();
  const ConstraintResidual residual = evaluate(at, t, needs, states);
  if (!(residual.position <= kLargestResidual)) report_open_joint(at.system.terms(), t);
  if (needs.coordinates) evaluate_coordinates(at.system.terms());
  const double* const work = bodies_.data() + model_.layout.work;
  const double energy =
      needs.energy ? mechanical_energy(at.system.terms(), t, bodies_.data()) : start_energy_;
  const double balance = energy - start_energy_ - (work[0] - start_work_);
  out.append({t, bodies_.data(), at.system, at.system.terms(), accelerations_, coordinates_, held_.links(),
              held_.drivers(), one_load_, rate_.data() + model_.layout.loads, residual.position,
              residual.rate, residual_before, balance, impact_loss});
  if (energy_.has_limit()) energy_.check(t, bodies_.data(), at.system.terms(), balance, work[1], energy);
}

void OutputSampler::record_until(Stepper& at, double t, double impact_loss) {
  record_until(at, t, impact_loss, states_of(at));
}

/// Those of the integrator, which are projected at the end of its step alone.
StepStates OutputSampler::states_of(Stepper& at) {
  const auto state = [&at](double t, double* y) {
    if (t >= at.integrator->time()) {
      std::copy_n(at.integrator->state(), at.stepped.size(), y);
    } else {
      at.integrator->interpolate(t, y);
    }
  };
  return {state, [this, &at](double t, const double* y) {
            stepped_rate_.resize(at.stepped.size());
            at.stepped.derivative(t, y, stepped_rate_.data());
            return true;
          }};
}

void OutputSampler::read_evaluation(Stepper& at) {
  const Integrator& in = *at.integrator;
  if (!extremes_.has_evaluations() || !(in.time() > in.previous_time())) return;
  if (at.stepped.evaluated_at() != in.time()) states_of(at).solve(in.time(), in.state());
  extremes_.read_evaluation(at, in.time(), in.state(), true);
}

void OutputSampler::take_step(Stepper& at, double to, const double* forces) {
  const double from = at.integrator->previous_time();
  const StepStates states = states_of(at);
  extremes_.take(at, from, to, states.at, forces);
  take_ends(at, from, to, states);
  if (next_ == times_.size()) extremes_.end_stretch();
}

/// What is not known without an evaluation as at outputs.
void OutputSampler::take_ends(Stepper& at, double from, double to, const StepStates& states) {
  if (!extremes_.has_ends() || !(to > from)) return;
  state_.resize(at.stepped.size());
  const Needs& needs = extremes_.needs_of_ends();
  const auto take = [&](double t) {
    states.at(t, state_.data());
    take_residual(at);
    at.stepped.project(t, state_.data(), false);
    at.stepped.take_residual_before_projection();  // what is interpolated is no residual of the steps
    evaluate(at, t, needs, states);
    if (needs.coordinates) evaluate_coordinates(at.system.terms());
    extremes_.see_end({t, bodies_.data(), at.system, at.system.terms(), accelerations_, coordinates_,
                       held_.links(), held_.drivers(), one_load_, rate_.data() + model_.layout.loads});
  };
  if (extremes_.begins_ends()) take(from);
  take(to);
}

void OutputSampler::take_step_beside(Stepper& at, double from, double to, double impact_loss,
                                     const StepStates& states) {
  state_.resize(at.stepped.size());
  if (extremes_.has_evaluations()) {
    states.at(to, state_.data());
    extremes_.read_evaluation(at, to, state_.data(), states.solve(to, state_.data()));
  }
  record_until(at, to, impact_loss, states);
  extremes_.take_end(at, from, to, states.at);
  take_ends(at, from, to, states);
  if (next_ == times_.size()) extremes_.end_stretch();
}

void OutputSampler::record_until(Stepper& at, double t, double impact_loss, const StepStates& states) {
  state_.resize(at.stepped.size());
  while (next_ < times_.size() && times_[next_] <= t) {
    const double now = times_[next_++];
    states.at(now, state_.data());
    last_time_ = now;
    last_residual_ = project(at, now);
    largest_residual_ = 0.0;
    write(at, now, last_residual_, impact_loss, states, recording_);
  }
}

Recording OutputSampler::snapshot(Stepper& at, double impact_loss) {
  const std::vector<std::string> names = channel_names(model_, false);
  Recording out(model_, {names.begin(), names.end()}, 1);
  const double t = at.integrator->time();
  state_.assign(at.integrator->state(), at.integrator->state() + at.stepped.size());
  take_residual(at);
  write(at, t, project(at, t), impact_loss, states_of(at), out);
  return out;
}

}  // namespace seacrane
