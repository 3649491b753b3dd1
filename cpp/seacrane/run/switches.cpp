#include "seacrane/run/switches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "seacrane/elements/loads/contact.hpp"
#include "seacrane/elements/loads/load_kind.hpp"
#include "seacrane/integrate/one_step.hpp"

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
/// A way within a step that is not looked at: what is met and left on it is shallower, m or rad; and a part
/// of the longest way that the step may have led, and of what is thin.
constexpr double kShallow = 1e-4, kPart = 0.01, kPartOfThin = 0.125;
constexpr double kGolden = 0.381966;  // of an interval, to close in on a least value in it
/// m or rad, into what is struck: the first step there, where steps would lead that many times as far.
constexpr double kFirst = 0.01, kFar = 4.0;
double first_way(double thin) { return std::min(kFirst, 0.25 * thin); }
bool leads_far(double way, double thin) { return way > kFar * first_way(thin); }
/// Of half of what is thin: the longest way of a step of a given length where it presses.
constexpr double kLongest = 0.5;
/// Of the first way into what is struck: so far before it a step ends that may not end there.
constexpr double kBefore = 0.1;

/// The fastest that a load came near to something within a step of length h: what its speeds at both ends
/// tell, and in the middle the parabola that leads through these and over its way. Speeds have no direction
/// here.
double fastest(const Sight& from, const Sight& to, double h) {
  const double middle = 1.5 * (to.at - from.at).norm() / h + 0.25 * (from.pace + to.pace);
  return std::max({from.pace, to.pace, middle});
}

/// Part of a step so near to its ends that a crossing there is at them, s.
double rounding_of(const LastStep& step) {
  return std::max(kAtEnd * (step.time() - step.previous_time()), 100.0 * smallest_step(step.time()));
}

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

bool presses(const Contact& contact, int side) {
  bool out = false;
  for (std::size_t i = 0; i < contact.points.size(); ++i) out = out || (side & Contact::closed(i)) != 0;
  return out;
}

/// Closes in on the time between two at which something is nearest, until it is met there, or is not. Looks
/// lie far apart beside an edge or the side of a post, which are thinner than the rest.
template <class F, class Met>
void look_into_dip(double first, double last, double pace, F&& clear_at, const Met& met) {
  while (last - first > std::max(kShallow / pace, 100.0 * smallest_step(last))) {
    const double part = kGolden * (last - first);
    const double early = clear_at(first + part);
    if (met) return;
    const double late = clear_at(last - part);
    if (met || std::min(early, late) > pace * part) return;
    (early < late ? last : first) = early < late ? last - part : first + part;
  }
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

void Switches::find_sides(Stepper& at, double t, const double* y, std::vector<int>& sides,
                          std::vector<Sight>& sights) {
  const LoadInput<double> in = read(at, t, y);
  sides.clear();
  sights.clear();
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    sights.push_back(look(list, i, in));
    sides.push_back(sights.back().side);
  });
}

/// The next step starts where the last one ended.
void Switches::turn() {
  before_.swap(after_);
  seen_before_.swap(seen_after_);
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
  find_sides(at, t, y, after_, seen_after_);
  begin_from(at, t, y);
}

/// From the sides just found there, behind a step.
void Switches::begin_from(Stepper& at, double t, const double* y, LastStep* step) {
  refuse(at, t, after_);
  const bool begins = before_.empty();
  if (begins) before_.assign(after_.size(), 0);
  if (before_.size() != after_.size()) before_ = after_;  // of another set of limits
  instants_.assign(after_.size(), t);
  for (std::size_t i = 0; step != nullptr && i < after_.size(); ++i) {
    if (after_[i] == before_[i]) continue;
    const auto margin_at = [&](double now, const double* state) {
      return across(at, read(at, now, state), i, before_[i], after_[i]);
    };
    instants_[i] = step->locate(std::cref(margin_at)).value_or(t);
  }
  note(at);
  if (!begins) note_contacts(at, t, y);  // what stands as a run begins has not touched
  turn();
}

void Switches::make_room(const Stepper& at) {
  std::size_t count = 0;
  for_each_switch(*at.model, [&](const LoadList&, std::size_t) { ++count; });
  for (std::vector<int>* sides : {&before_, &after_, &passed_, &left_}) sides->reserve(count);
  for (std::vector<Sight>* sights : {&seen_before_, &seen_after_, &seen_passed_}) sights->reserve(count);
  for (std::vector<double>* values : {&state_, &rate_, &late_rate_, &end_rate_}) {
    values->resize(at.stepped.size());
  }
  if (scale_.size() != at.stepped.size()) scale_ = at.stepped.scale();  // the same of every set of limits
}

void Switches::resume(Stepper& at, double t, const double* y) {
  make_room(at);
  find_sides(at, t, y, before_, seen_before_);
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
  strike_pace_ = 0.0;
  strike_thin_ = Sight::kFar;
  std::size_t k = 0;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    const Contact* const contact = contact_of(list, i);
    has_jumped_ = has_jumped_ || (contact != nullptr && contact->touches(left_[k], after_[k]));
    const Sight &from = seen_before_[k], &to = seen_after_[k];
    if (from.strikes && ((left_[k] ^ after_[k]) & from.watched) != 0) {
      strike_pace_ = std::max({strike_pace_, from.pace, to.pace});
      strike_thin_ = std::min(strike_thin_, from.thin);
    }
    ++k;
  });
  turn();
}

/// A stage without weight may be the only one that sees what is struck: it throws the others clear of it, and
/// the step leads through. The next one sees it at its start.
double Switches::end_of_strike(double now, double step) const {
  if (!leads_far(strike_pace_ * step, strike_thin_)) return Sight::kFar;
  return now + first_way(strike_thin_) / strike_pace_;
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
  turn();
}

/// Whether the step crossed something as it began, and its first stage, still on the old side, saw other
/// rates than all the rest of it.
bool Switches::began_behind(Stepper& at, const LastStep& step, double margin) {
  const double start = step.previous_time();
  step.interpolate(start + margin, state_.data());
  find_sides(at, start + margin, state_.data(), passed_, seen_passed_);
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
  find_sides(at, step.time(), step.state(), after_, seen_after_);
  const double start = step.previous_time(), end = step.time(), margin = rounding_of(step);
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
  if (!first) first = look_between(at, step);
  if (!first) finish(at, step);
  return first;
}

std::optional<double> Switches::find_between(Stepper& at, LastStep& step, bool ends_before) {
  ends_before_ = ends_before;
  find_sides(at, step.time(), step.state(), after_, seen_after_);
  const std::optional<double> found = look_between(at, step);
  if (!found) begin_from(at, step.time(), step.state(), ends_before ? &step : nullptr);
  return found;
}

/// Where the last step is to end because loads met something within it and left it again, which ends of steps
/// do not tell and errors do not either: nothing else may press. Just after its start where they met it
/// there. A method that ends before them is led to what is thin, and to what it has left again. A method
/// whose dense output takes evaluations of its own may have lost its way there by what they met: steps that
/// lead far are looked at on the cubic of their ends too.
std::optional<double> Switches::look_between(Stepper& at, LastStep& step) {
  if (!at.integrator->is_adaptive()) {
    refuse_long(at, step);
    return std::nullopt;
  }
  std::optional<double> first;
  std::size_t k = 0;
  bool has_slopes = false;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    const std::size_t load = k++;
    const double pace = pace_between(step, load);
    const Sight& from = seen_before_[load];
    const bool ends_in_it = ends_before_ && ((after_[load] ^ before_[load]) & from.watched) != 0;
    if (!(pace > 0.0) || (ends_in_it && from.thin == Sight::kFar)) return;
    std::optional<Between> met = look_between(at, step, list, i, load, pace, false);
    const double h = step.time() - step.previous_time();
    if (!met && leads_far(pace * h, from.thin)) {
      if (!std::exchange(has_slopes, true)) {
        at.stepped.derivative(step.previous_time(), step.previous_state(), rate_.data());
        at.stepped.derivative(step.time(), step.state(), end_rate_.data());
      }
      met = look_between(at, step, list, i, load, pace, true);
    }
    if (met) end_on(at, step, *met, load, first);
  });
  return first;
}

/// Steps of a given length are as long as was asked for, whatever they meet. What they meet and leave again
/// is of the size of their errors, but where they lead through what is thin.
void Switches::refuse_long(Stepper& at, const LastStep& step) {
  const double h = step.time() - step.previous_time();
  std::size_t k = 0;
  for_each_switch(*at.model, [&](const LoadList& list, std::size_t i) {
    const std::size_t load = k++;
    const Contact* const contact = contact_of(list, i);
    if (contact == nullptr || !(h > 0.0)) return;
    const Sight& from = seen_before_[load];
    if (!(from.pace * h > kLongest * from.thin)) return;
    const double pace = pace_between(step, load);
    const bool passes = presses(*contact, from.side) ||
                        (pace > 0.0 && look_between(at, step, list, i, load, pace, false).has_value());
    if (!passes) return;
    throw std::domain_error("contact '" + contact->d.name + "': a step of " + to_text(h) + " s leads " +
                            to_text(from.pace * h) + " m, where it is " + to_text(2.0 * from.thin) +
                            " m thick, at t = " + to_text(step.previous_time()) +
                            " s: a point would pass through it; give a dt of at most " +
                            to_text(kLongest * from.thin / from.pace) +
                            " s, or a method that chooses its steps, such as 'dopri5'");
  });
}

/// The fastest that a load came near to what it saw within the last step; 0 where it could not reach it.
double Switches::pace_between(const LastStep& step, std::size_t load) const {
  const Sight &from = seen_before_[load], &to = seen_after_[load];
  const double h = step.time() - step.previous_time();
  if (!(from.clear < Sight::kFar && h > 0.0)) return 0.0;
  const double pace = fastest(from, to, h);
  return from.clear + clear_at_end(load) > pace * h ? 0.0 : pace;
}

double Switches::clear_at_end(std::size_t load) const {
  return after_[load] == before_[load] ? seen_after_[load].clear : 0.0;
}

/// The step is to end on what a load met, unless it ends there anyway, or something comes first.
void Switches::end_on(Stepper& at, LastStep& step, const Between& met, std::size_t load,
                      std::optional<double>& first) {
  const double start = step.previous_time(), end = step.time(), margin = rounding_of(step);
  const auto margin_at = [&](double t, const double* y) {
    return t >= met.time ? met.across : across(at, read(at, t, y), load, before_[load], met.side);
  };
  double found = std::min(step.locate(std::cref(margin_at)).value_or(met.time), met.time);
  if (ends_before_) found = before_touch(step, found, load);
  if (end - found <= margin || (first && *first <= found)) return;
  leads_across_ = !ends_before_ && found <= start + margin;
  first = leads_across_ ? found + 10.0 * smallest_step(end) : found;
  aim_ = {};
  if (leads_across_ || ends_before_) return;
  aim_ = {.time = found,
          .length = end - start,
          .load = load,
          .to = met.side,
          .from_start = margin_at(start, step.previous_state())};
}

/// Just before a load meets something at time `found`; from there, on the first way into it.
double Switches::before_touch(const LastStep& step, double found, std::size_t load) const {
  const double pace = fastest(seen_before_[load], seen_after_[load], step.time() - step.previous_time());
  const double into = first_way(seen_before_[load].thin) / pace, short_of = found - kBefore * into;
  return short_of - step.previous_time() > kBefore * into ? short_of : found + into;
}

/// On the dense output, or on the cubic of both ends' states and slopes.
LoadInput<double> Switches::read_within(Stepper& at, const LastStep& step, double t, bool on_cubic) {
  if (on_cubic) {
    const double start = step.previous_time(), h = step.time() - start, part = (t - start) / h;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      state_[i] =
          cubic_hermite(step.previous_state()[i], step.state()[i], h * rate_[i], h * end_rate_[i], part);
    }
  } else {
    step.interpolate(t, state_.data());
  }
  return read(at, t, state_.data());
}

/// Conservative advancement (B. Mirtich, Impulse-based dynamic simulation of rigid body systems, thesis,
/// Berkeley 1996): what is that far away is not met before that way is gone, and need not be looked at
/// earlier.
std::optional<Switches::Between> Switches::look_between(Stepper& at, const LastStep& step,
                                                        const LoadList& list, std::size_t i, std::size_t load,
                                                        double pace, bool on_cubic) {
  const Sight& from = seen_before_[load];
  const double start = step.previous_time(), end = step.time(), whole = pace * (end - start);
  const double least = std::min(kPartOfThin * from.thin, std::max(kPart * whole, kShallow));
  std::optional<Between> met;
  const auto clear_at = [&](double t) {
    const LoadInput<double> in = read_within(at, step, t, on_cubic);
    const Sight now = look(list, i, in);
    const int changed = (now.side ^ before_[load]) & from.watched, side = before_[load] ^ changed;
    if (changed != 0) met = Between{t, side, list.across(i, in, before_[load], side)};
    return now.clear;
  };
  struct {
    double time, clear;
  } before{start, from.clear}, here = before, next = before;
  while (true) {
    next.time = here.time + std::max(here.clear, least) / pace;
    const bool ends = next.time >= end;
    next = ends ? decltype(next){end, clear_at_end(load)} : decltype(next){next.time, clear_at(next.time)};
    if (met) return met;
    const bool is_over = ends || next.clear + clear_at_end(load) > pace * (end - next.time);
    const bool dips = here.clear <= before.clear && (here.clear <= next.clear || is_over);
    if (dips && here.clear < least) look_into_dip(before.time, next.time, pace, clear_at, met);
    if (met || is_over) return met;
    before = here;
    here = next;
  }
}

}  // namespace seacrane
