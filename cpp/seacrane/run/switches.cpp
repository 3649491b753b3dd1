#include "seacrane/run/switches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "seacrane/elements/loads/contact.hpp"
#include "seacrane/elements/loads/load_kind.hpp"

namespace seacrane {
namespace {

constexpr double kAtEnd = 1e-6;  // of a step: a crossing that near to its ends is at them
/// Change of a rate at a step's start, over that of the whole step, beyond which it jumps there; and over the
/// scale of its state, below which that is rounding.
constexpr double kJump = 1e-3, kRounding = 1e-10;
/// Part of the way to a crossing that is left behind a step up to it, beyond which the step missed it.
constexpr double kShort = 0.5;
/// Part of a step so near whose start a crossing may be led across.
constexpr double kNear = 1e-3;

/// Calls f(list, place) for every load with sides, in the order of the model.
template <class F>
void for_each_switch(const Model& model, F&& f) {
  model.loads.for_each([&](const LoadList& list, std::size_t i) {
    if (list.has_sides(i)) f(list, i);
  });
}

/// Null for a load of another kind.
const Contact* contact_of(const LoadList& list, std::size_t i) {
  if (&list.kind != &load_kind<Contact>()) return nullptr;
  return &static_cast<const LoadsOf<Contact>&>(list).items[i];
}

const char* kind_of(Contact::Change change) {
  switch (change) {
    case Contact::Change::touch:
      return "contact";
    case Contact::Change::lift:
      return "release";
    case Contact::Change::slip:
      return "slip";
    case Contact::Change::stick:
      break;
  }
  return "stick";
}

}  // namespace

bool Switches::any_jumps(const Model& model) {
  return std::ranges::any_of(model.loads.of<Contact>(), [](const Contact& c) { return c.states.count > 0; });
}

bool Switches::any(const Model& model) {
  bool found = false;
  for_each_switch(model, [&](const LoadList&, std::size_t) { found = true; });
  return found;
}

/// What loads look at; of a tree without loops from its own kinematics.
LoadInput<double> Switches::read(Stepper& at, double t, const double* y) {
  if (at.stepped.closes_joints()) {
    const StateLayout& layout = at.model->layout;
    at.bodies.place(t, y);
    return at.system.terms().load_input(t, y + at.stepped.size() - idx(layout.size - layout.memory));
  }
  bodies_.resize(at.system.size());
  at.write_bodies(t, y, bodies_.data());
  Terms& terms = at.system.terms();
  terms.read(t, bodies_.data());
  return terms.load_input(t, bodies_.data() + at.model->layout.memory);
}

void Switches::find_sides(Stepper& at, double t, const double* y, std::vector<int>& sides) {
  const LoadInput<double> in = read(at, t, y);
  sides.clear();
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) { sides.push_back(list.side(i, in)); });
}

double Switches::across(const Stepper& at, const LoadInput<double>& in, std::size_t load, int from, int to) {
  double out = 1.0;
  std::size_t k = 0;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    if (k++ == load) out = list.across(i, in, from, to);
  });
  return out;
}

void Switches::refuse(const Stepper& at, double t, const std::vector<int>& sides) const {
  std::size_t k = 0;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    const int side = sides[k++];
    const std::string why = list.refused(i, side);
    if (why.empty()) return;
    const std::string text = why + ", at t = " + to_text(t) + " s";
    if (list.slack(i, side)) throw LineSlackError(text);
    throw std::domain_error(text);
  });
}

void Switches::watch(Stepper& at, double t, const double* y) {
  make_room(at);
  find_sides(at, t, y, after_);
  refuse(at, t, after_);
  const bool begins = before_.empty();
  if (begins) before_.assign(after_.size(), 0);
  if (before_.size() != after_.size()) before_ = after_;  // of another set of limits
  instants_.assign(after_.size(), t);
  note(at);
  if (!begins) note_contacts(at, t, y);  // what stands as a run begins has not touched
  before_.swap(after_);
}

void Switches::make_room(const Stepper& at) {
  std::size_t count = 0;
  for_each_switch(*at.model, [&](const LoadList&, std::size_t) { ++count; });
  for (std::vector<int>* sides : {&before_, &after_, &passed_, &left_}) sides->reserve(count);
  for (std::vector<double>* values : {&state_, &rate_, &late_rate_, &end_rate_}) {
    values->resize(at.stepped.size());
  }
  if (scale_.size() != at.stepped.size()) scale_ = at.stepped.scale();  // the same of every set of limits
}

void Switches::resume(Stepper& at, double t, const double* y) {
  make_room(at);
  find_sides(at, t, y, before_);
  refuse(at, t, before_);
  settled_at_ = t;
}

void Switches::note(const Stepper& at) {
  std::size_t k = 0;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    const int from = before_[k], to = after_[k];
    const double t = instants_[k++];
    if (from == to) return;
    for (const std::string& name : list.reached(i, from, to)) {
      if (!name.empty()) reached_.push_back({t, name});
    }
  });
}

/// What points of contacts did until (t, y), where it is read.
void Switches::note_contacts(Stepper& at, double t, const double* y) {
  std::size_t k = 0;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    const int from = before_[k], to = after_[k];
    const double instant = instants_[k++];
    const Contact* const contact = contact_of(list, i);
    if (from == to || contact == nullptr) return;
    for (const auto& [point, change] : contact->happened(from, to)) {
      const bool touches = change == Contact::Change::touch;
      const double speed = touches ? std::max(contact->touch(read(at, t, y), point).rate, 0.0) : 0.0;
      reached_.push_back({instant, contact->point_name(point), kind_of(change), speed});
    }
  });
}

/// The step ends where it does: the next one begins on the sides there.
void Switches::finish(Stepper& at, const LastStep& step) {
  note(at);
  note_contacts(at, step.time(), step.state());
  has_jumped_ = false;
  std::size_t k = 0;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    const Contact* const contact = contact_of(list, i);
    has_jumped_ = has_jumped_ || (contact != nullptr && contact->touches(left_[k], after_[k]));
    ++k;
  });
  before_.swap(after_);
}

void Switches::settle(Stepper& at, double t, const double* y, double* load_states) {
  settled_at_ = t;
  std::size_t k = 0;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    const std::optional<int> side = left_.empty() ? std::nullopt : std::optional(left_[k]);
    ++k;
    if (const Contact* const contact = contact_of(list, i)) {
      contact->take_anchors(read(at, t, y), side, load_states);
    }
  });
}

void Switches::shorten(double t) {
  std::erase_if(reached_, [t](const LimitReached& one) { return one.time > t; });
  before_.swap(after_);
}

/// Whether the step crossed something as it began, and its first stage, still on the old side, saw other
/// rates than all the rest of it.
bool Switches::began_behind(Stepper& at, const LastStep& step, double margin) {
  const double start = step.previous_time();
  step.interpolate(start + margin, state_.data());
  find_sides(at, start + margin, state_.data(), passed_);
  if (passed_ == before_) return false;
  at.stepped.derivative(start, step.previous_state(), rate_.data());
  at.stepped.derivative(start + margin, state_.data(), late_rate_.data());
  at.stepped.derivative(step.time(), step.state(), end_rate_.data());
  const double length = step.time() - start;
  for (std::size_t i = 0; i < rate_.size(); ++i) {
    const double jump = std::abs(late_rate_[i] - rate_[i]), change = std::abs(end_rate_[i] - rate_[i]);
    if (jump > kJump * change && jump * length > kRounding * scale_[i]) return true;
  }
  return false;
}

/// Takes as passed what the step crossed as it began: a crossing that the last one ended on.
void Switches::pass_start(Stepper& at, const LastStep& step) {
  passed_.swap(after_);
  instants_.assign(after_.size(), step.previous_time());
  note(at);
  note_contacts(at, step.previous_time(), step.previous_state());
  if (settled_at_ == step.previous_time()) left_ = after_;
  before_.swap(after_);
  passed_.swap(after_);
}

/// Whether the step was taken up to a crossing and came no nearer to it. An explicit method weighs its last
/// stages by more than one: where these fall on the new side of a jump, the step turns back, however short.
bool Switches::fell_short(Stepper& at, const LastStep& step) {
  const Aim aim = std::exchange(aim_, {});
  if (step.time() != aim.time || after_[aim.load] != before_[aim.load]) return false;
  if (aim.time - step.previous_time() > kNear * aim.length) return false;
  const LoadInput<double> in = read(at, step.time(), step.state());
  const double left = across(at, in, aim.load, before_[aim.load], aim.to);
  return std::abs(left) > kShort * std::abs(aim.from_start);
}

std::optional<double> Switches::find(Stepper& at, LastStep& step) {
  find_sides(at, step.time(), step.state(), after_);
  const double start = step.previous_time(), end = step.time(),
               margin = std::max(kAtEnd * (end - start), 100.0 * smallest_step(end));
  refuse(at, end, after_);
  instants_.assign(after_.size(), end);
  left_ = before_;
  if (std::exchange(leads_across_, false)) {
    finish(at, step);
    return std::nullopt;
  }
  if (fell_short(at, step)) {
    leads_across_ = true;
    return start + 2.0 * (end - start);
  }
  std::optional<double> first;
  if (after_ != before_ && start + margin < end) {
    leads_across_ = began_behind(at, step, margin);
    if (leads_across_) return start + margin;
    pass_start(at, step);
    instants_.assign(after_.size(), end);
  }
  for (std::size_t i = 0; i < after_.size(); ++i) {
    if (after_[i] == before_[i]) continue;
    const auto margin_at = [&](double t, const double* y) {
      return across(at, read(at, t, y), i, before_[i], after_[i]);
    };
    const std::optional<double> found = step.locate(std::cref(margin_at));
    if (!found) continue;
    instants_[i] = *found;
    if (*found - start <= margin || end - *found <= margin) continue;
    if (first && *first <= *found) continue;
    first = found;
    aim_ = {.time = *found,
            .length = end - start,
            .load = i,
            .to = after_[i],
            .from_start = margin_at(start, step.previous_state())};
  }
  if (!first) finish(at, step);
  return first;
}

}  // namespace seacrane
