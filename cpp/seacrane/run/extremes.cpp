#include "seacrane/run/extremes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace seacrane {

void Extremes::Group::begin() {
  for (const RecordedChannel* c : channels) {
    for (std::size_t i = 0; c->least && i < c->size; ++i) curves.push_back({c, i});
  }
  window = PeakWindow(curves.size());
}

Extremes::Extremes(const Model& model, Recording& recording, const std::set<std::string>& trail)
    : model_(model),
      recording_(recording),
      bodies_(idx(model.layout.size), 0.0),
      stepped_(idx(model.stepped().layout.size), 0.0),
      coordinates_(model.coordinates.size()),
      one_load_(idx(model.body_count() + 1)) {
  for (const RecordedChannel& c : recording.channels()) {
    const Peaks peaks = c.channel->peaks;
    const bool of_lines = peaks == Peaks::of_lines, settles = of_lines && model.inertial_tensions > 0,
               of_states = peaks == Peaks::of_states || peaks == Peaks::of_poses || (of_lines && !settles),
               is_followed = of_states && trail.count(c.channel->name) > 0;
    if (is_followed) trail_.channels.push_back(&c);
    if (!c.least && !is_followed) continue;
    if (of_states) {
      states_.channels.push_back(&c);
      needs_coordinates_ |= c.channel->needs.coordinates;
    } else if (peaks == Peaks::of_ends) {
      ends_.channels.push_back(&c);
      needs_of_ends_ |= needs_of(*c.channel, model);
    } else if (peaks == Peaks::of_limits) {
      limits_.channels.push_back(&c);
    } else {
      evaluations_.channels.push_back(&c);
      has_accelerations_ |= peaks == Peaks::of_accelerations;
      has_held_ |= peaks == Peaks::of_held;
      has_lines_ |= of_lines;
    }
  }
  std::ranges::stable_partition(evaluations_.channels, [](const RecordedChannel* c) {
    return c->channel->peaks != Peaks::of_accelerations;  // which place bodies anew
  });
  // Those of a trail alone behind what has curves.
  std::ranges::stable_partition(states_.channels,
                                [](const RecordedChannel* c) { return c->least.has_value(); });
  for (Group* group : groups()) group->begin();
  for (const RecordedChannel* c : states_.channels) row_.resize(row_.size() + c->size);
  end_.resize(ends_.curves.size());
  evaluation_.resize(evaluations_.curves.size());
}

Output Extremes::output(Stepper& at, double t, const double* state, const Terms& terms) {
  return {t,         state,  at.system, terms, accelerations_, coordinates_, held_.links(), held_.drivers(),
          one_load_, nullptr};
}

void Extremes::read_evaluation(Stepper& at, double t, const double* y, bool placed) {
  if (!placed && (has_accelerations_ || has_lines_)) at.stepped.place_bodies(t, y);
  if (has_held_) held_.read_stepped(at);
  const Terms& terms = at.loads;
  stepped_.resize(idx(terms.model().layout.size));
  const std::size_t memory = idx(terms.model().layout.size - terms.model().layout.memory);
  std::copy_n(y + at.stepped.size() - memory, memory, stepped_.end() - static_cast<std::ptrdiff_t>(memory));
  if (has_accelerations_) accelerations_ = at.bodies.accelerations();
  double* out = evaluation_.data();
  for (const RecordedChannel* c : evaluations_.channels) {
    if (c->channel->peaks == Peaks::of_accelerations) {
      place(at, t, y);  // the last of them
      c->channel->write(output(at, t, bodies_.data(), at.system.terms()), out);
    } else {
      c->channel->write(output(at, t, stepped_.data(), terms), out);
    }
    out += c->size;
  }
  evaluated_ = t;
}

void Extremes::take_end(Stepper& at, double from, double to, const StateAt& state_at) {
  if (!(to > from)) return;
  if (!states_.channels.empty()) {
    if (states_.window.empty()) take_state(at, from, state_at);
    take_state(at, to, state_at);
  }
  if (has_evaluations() && evaluated_ == to) add(evaluations_, to, evaluation_.data());
}

void Extremes::take(Stepper& at, double from, double to, const StateAt& state_at, const double* forces) {
  if (!(to > from)) return;
  if (!states_.channels.empty() && states_.window.empty()) take_state(at, from, state_at);
  // What lies within a step of a given length costs an evaluation.
  if (!states_.channels.empty() && at.integrator->is_adaptive()) take_state(at, 0.5 * (from + to), state_at);
  take_end(at, from, to, state_at);
  if (!limits_.curves.empty() && forces != nullptr) {
    add(limits_, 0.5 * (from + to), forces);
    add(limits_, to, forces + limits_.curves.size());
  }
}

void Extremes::take_state(Stepper& at, double t, const StateAt& state_at) {
  state_.resize(at.stepped.size());
  state_at(t, state_.data());
  place(at, t, state_.data());
  double* out = row_.data();
  for (const RecordedChannel* c : states_.channels) {
    c->channel->write(output(at, t, bodies_.data(), at.system.terms()), out);
    if (std::ranges::count(trail_.channels, c) > 0) trail_.rows.insert(trail_.rows.end(), out, out + c->size);
    out += c->size;
  }
  if (!trail_.channels.empty()) trail_.times.push_back(t);
  add(states_, t, row_.data());
}

void Extremes::see_end(const Output& output) {
  double* out = end_.data();
  for (const RecordedChannel* c : ends_.channels) {
    c->channel->write(output, out);
    out += c->size;
  }
  add(ends_, output.time, end_.data());
}

/// The kinematics of the described bodies at a state that is stepped, and its part behind these.
void Extremes::place(Stepper& at, double t, const double* y) {
  Terms& terms = at.system.terms();
  if (at.stepped.closes_joints()) {
    at.bodies.place(t, y);
    const std::size_t memory = idx(model_.layout.size - model_.layout.memory);
    std::copy_n(y + at.stepped.size() - memory, memory, bodies_.end() - static_cast<std::ptrdiff_t>(memory));
  } else {
    at.write_bodies(t, y, bodies_.data());
    terms.read(t, bodies_.data());
  }
  if (!needs_coordinates_) return;
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const CoordinateData& c = model_.coordinates[i];
    coordinates_[i] =
        evaluate_coordinate(c, terms.bodies()[idx(c.joint.first)], terms.bodies()[idx(c.joint.second)]);
  }
}

void Extremes::add(Group& group, double t, const double* values) {
  group.window.add(t, values, seeing(group));
}

/// Tells channels, how many values each has, and where they come from (FNV-1a): what was saved of others may
/// be as long.
double Extremes::layout() const {
  std::string text;
  for (const RecordedChannel& c : recording_.channels()) {
    if (c.least) text += c.channel->name + " " + std::to_string(c.size) + " ";
  }
  for (const Group* group : groups()) text += std::to_string(group->curves.size()) + " ";
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return static_cast<double>(hash >> 11);
}

std::vector<double> Extremes::save() const {
  std::vector<double> out = {layout()};
  recording_.save_pending(out);
  for (const Group* group : groups()) group->window.save(out);
  return out;
}

void Extremes::load(const std::vector<double>& saved) {
  if (saved.size() != save().size() || saved.front() != layout()) return;  // of other channels
  const double* next = recording_.load_pending(saved.data() + 1);
  for (Group* group : groups()) next = group->window.load(next);
}

void Extremes::forget_stretch() {
  for (Group* group : groups()) group->window.forget();
}

void Extremes::end_stretch() {
  for (Group* group : groups()) group->window.end(seeing(*group));
}

}  // namespace seacrane
