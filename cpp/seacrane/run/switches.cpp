#include "seacrane/run/switches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

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

/// The fastest that a load came near to what it saw within a step of length h; 0 where it could not reach it.
double pace_between(const Sight& from, const Sight& to, double clear_at_end, double h) {
  if (!(from.clear < Sight::kFar && h > 0.0)) return 0.0;
  const double pace = fastest(from, to, h);
  return from.clear + clear_at_end > pace * h ? 0.0 : pace;
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

}  // namespace

std::string Switches::first_that_jumps(const Model& model) {
  std::string out;
  model.loads.for_each([&](const LoadList& list, std::size_t i) {
    if (out.empty() && list.jumps(i, Side(), ~Side())) out = name_of(list, i);
  });
  return out;
}

bool Switches::any(const Model& model) {
  bool found = false;
  for_each_switch(model, [&](const LoadList&, std::size_t) { found = true; });
  return found;
}

/// What loads look at.
LoadInput<double> Switches::read(Stepper& at, double t, const double* y) {
  at.stepped.place_bodies(t, y);
  const StateLayout& layout = at.loads.model().layout;
  return at.loads.load_input(t, y + at.stepped.size() - idx(layout.size - layout.memory));
}

/// Takes the sides at the end of a step, and what is seen from there.
void Switches::look(Stepper& at, double t, const double* y) {
  const LoadInput<double> in = read(at, t, y);
  for (Watched& one : watched_) {
    one.to = one.list->look(one.place, in);
    one.after = one.to.side;
    one.instant = t;
  }
}

/// The next step starts where the last one ended.
void Switches::turn() {
  for (Watched& one : watched_) {
    std::swap(one.before, one.after);
    std::swap(one.from, one.to);
  }
}

void Switches::refuse(double t) const {
  for (const Watched& one : watched_) {
    const std::string why = one.list->refused(one.place, one.after);
    if (why.empty()) continue;
    const std::string text = why + ", at t = " + to_text(t) + " s";
    if (one.list->slack(one.place, one.after)) throw LineSlackError(text);
    throw std::domain_error(text);
  }
}

void Switches::watch(Stepper& at, double t, const double* y) {
  list_loads(at);
  look(at, t, y);
  begin_from(at, t, y);
}

/// From the sides just found there, behind a step.
void Switches::begin_from(Stepper& at, double t, const double* y, LastStep* step) {
  refuse(t);
  const bool begins = !std::exchange(has_begun_, true);
  for (Watched& one : watched_) {
    if (is_new_ && !begins) one.before = one.after;
    if (step == nullptr || !one.changes()) continue;
    const auto margin_at = [&](double now, const double* state) { return one.across(read(at, now, state)); };
    one.instant = step->locate(std::cref(margin_at)).value_or(t);
  }
  is_new_ = false;
  note();
  if (!begins) note_happenings(at, t, y);  // what stands as a run begins has not touched
  turn();
}

/// Of a stepper. Another set of limits may leave others.
void Switches::list_loads(const Stepper& at) {
  std::size_t count = 0;
  const Model& model = at.loads.model();
  for_each_switch(model, [&](const LoadList&, std::size_t) { ++count; });
  if (watched_.size() != count) {
    is_new_ = true;
    watched_.assign(count, Watched{});
  }
  count = 0;
  for_each_switch(model, [&](const LoadList& list, std::size_t i) {
    watched_[count].list = &list;
    watched_[count++].place = i;
  });
  for (std::vector<double>* values : {&state_, &rate_, &late_rate_, &end_rate_}) {
    values->resize(at.stepped.size());
  }
  if (scale_.size() != at.stepped.size()) scale_ = at.stepped.scale();  // the same of every set of limits
}

void Switches::resume(Stepper& at, double t, const double* y) {
  list_loads(at);
  look(at, t, y);
  refuse(t);
  turn();
  has_begun_ = true;
  is_new_ = false;
  settled_at_ = t;
}

void Switches::note() {
  for (const Watched& one : watched_) {
    if (!one.changes()) continue;
    for (const std::string& name : one.list->reached(one.place, one.before, one.after)) {
      if (!name.empty()) reached_.push_back({one.instant, name});
    }
  }
}

/// What loads did until (t, y), where it is read.
void Switches::note_happenings(Stepper& at, double t, const double* y) {
  for (const Watched& one : watched_) {
    if (!one.changes()) continue;
    for (const Happening& now : one.list->happened(one.place, read(at, t, y), one.before, one.after)) {
      reached_.push_back({one.instant, now.name, now.kind, now.speed});
    }
  }
}

/// The step ends where it does: the next one begins on the sides there.
void Switches::finish(Stepper& at, const LastStep& step) {
  note();
  note_happenings(at, step.time(), step.state());
  has_jumped_ = false;
  strike_pace_ = 0.0;
  strike_thin_ = Sight::kFar;
  for (const Watched& one : watched_) {
    const Side left = one.left.value_or(one.before);
    has_jumped_ = has_jumped_ || one.list->jumps(one.place, left, one.after);
    if (one.from.strikes && ((left ^ one.after) & one.from.watched).any()) {
      strike_pace_ = std::max({strike_pace_, one.from.pace, one.to.pace});
      strike_thin_ = std::min(strike_thin_, one.from.thin);
    }
  }
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
  list_loads(at);
  for (const Watched& one : watched_) {
    if (one.list->jumps(one.place, Side(), ~Side()))
      one.list->settle(one.place, read(at, t, y), one.left, load_states);
  }
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
  const LoadInput<double> in = read(at, start + margin, state_.data());
  bool is_passed = false;
  for (Watched& one : watched_) {
    one.passed = one.list->look(one.place, in).side;
    is_passed = is_passed || one.passed != one.before;
  }
  if (!is_passed) return false;
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
  const double start = step.previous_time();
  for (Watched& one : watched_) {
    std::swap(one.passed, one.after);
    one.instant = start;
  }
  note();
  note_happenings(at, start, step.previous_state());
  for (Watched& one : watched_) {
    if (settled_at_ == start) one.left = one.after;
    one.before = one.after;
    one.after = one.passed;
  }
}

/// Whether the step was taken up to a crossing and came no nearer to it. An explicit method weighs its last
/// stages by more than one: where these fall on the new side of a jump, the step turns back, however short.
bool Switches::fell_short(Stepper& at, const LastStep& step) {
  const Aim aim = std::exchange(aim_, {});
  const Watched& load = watched_[aim.load];
  if (step.time() != aim.time || load.changes()) return false;
  if (aim.time - step.previous_time() > kNear * aim.length) return false;
  const double left = load.across(read(at, step.time(), step.state()), load.before, aim.to);
  return std::abs(left) > kShort * std::abs(aim.from_start);
}

std::optional<double> Switches::find(Stepper& at, LastStep& step) {
  look(at, step.time(), step.state());
  const double start = step.previous_time(), end = step.time(), margin = rounding_of(step);
  refuse(end);
  for (Watched& one : watched_) one.left = one.before;
  if (std::exchange(leads_across_, false)) {
    finish(at, step);
    return std::nullopt;
  }
  if (fell_short(at, step)) {
    leads_across_ = true;
    return start + 2.0 * (end - start);
  }
  std::optional<double> first;
  if (start + margin < end && std::ranges::any_of(watched_, &Watched::changes)) {
    leads_across_ = began_behind(at, step, margin);
    if (leads_across_) return start + margin;
    pass_start(at, step);
    for (Watched& one : watched_) one.instant = end;
  }
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    Watched& one = watched_[i];
    if (!one.changes()) continue;
    const auto margin_at = [&](double t, const double* y) { return one.across(read(at, t, y)); };
    const std::optional<double> found = step.locate(std::cref(margin_at));
    if (!found) continue;
    one.instant = *found;
    if (*found - start <= margin || end - *found <= margin) continue;
    if (first && *first <= *found) continue;
    first = found;
    aim_ = {.time = *found,
            .length = end - start,
            .load = i,
            .to = one.after,
            .from_start = margin_at(start, step.previous_state())};
  }
  if (!first) first = look_between(at, step);
  if (!first) finish(at, step);
  return first;
}

std::optional<double> Switches::find_between(Stepper& at, LastStep& step, bool ends_before) {
  ends_before_ = ends_before;
  look(at, step.time(), step.state());
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
  const double h = step.time() - step.previous_time();
  std::optional<double> first;
  bool has_slopes = false;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const Watched& load = watched_[i];
    const double pace = pace_between(load.from, load.to, load.clear_at_end(), h);
    const bool ends_in_it = ends_before_ && ((load.after ^ load.before) & load.from.watched).any();
    if (!(pace > 0.0) || (ends_in_it && load.from.thin == Sight::kFar)) continue;
    std::optional<Between> met = look_between(at, step, load, pace, false);
    if (!met && leads_far(pace * h, load.from.thin)) {
      if (!std::exchange(has_slopes, true)) {
        at.stepped.derivative(step.previous_time(), step.previous_state(), rate_.data());
        at.stepped.derivative(step.time(), step.state(), end_rate_.data());
      }
      met = look_between(at, step, load, pace, true);
    }
    if (met) end_on(at, step, *met, i, first);
  }
  return first;
}

/// Steps of a given length are as long as was asked for, whatever they meet. What they meet and leave again
/// is of the size of their errors, but where they lead through what is thin.
void Switches::refuse_long(Stepper& at, const LastStep& step) {
  const double h = step.time() - step.previous_time();
  for (const Watched& load : watched_) {
    const Sight& from = load.from;
    if (!(h > 0.0) || !(from.pace * h > kLongest * from.thin)) continue;
    const double pace = pace_between(from, load.to, load.clear_at_end(), h);
    const bool passes = from.presses || (pace > 0.0 && look_between(at, step, load, pace, false).has_value());
    if (!passes) continue;
    throw std::domain_error(name_of(*load.list, load.place) + ": a step of " + to_text(h) + " s leads " +
                            to_text(from.pace * h) + " m, where it is " + to_text(2.0 * from.thin) +
                            " m thick, at t = " + to_text(step.previous_time()) +
                            " s: a point would pass through it; give a dt of at most " +
                            to_text(kLongest * from.thin / from.pace) +
                            " s, or a method that chooses its steps, such as 'dopri5'");
  }
}

/// The step is to end on what a load met, unless it ends there anyway, or something comes first.
void Switches::end_on(Stepper& at, LastStep& step, const Between& met, std::size_t load,
                      std::optional<double>& first) {
  const double start = step.previous_time(), end = step.time(), margin = rounding_of(step);
  const Watched& one = watched_[load];
  const auto margin_at = [&](double t, const double* y) {
    return t >= met.time ? met.across : one.across(read(at, t, y), one.before, met.side);
  };
  double found = std::min(step.locate(std::cref(margin_at)).value_or(met.time), met.time);
  if (ends_before_) found = before_touch(step, found, one);
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
double Switches::before_touch(const LastStep& step, double found, const Watched& load) const {
  const double pace = fastest(load.from, load.to, step.time() - step.previous_time());
  const double into = first_way(load.from.thin) / pace, short_of = found - kBefore * into;
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
                                                        const Watched& load, double pace, bool on_cubic) {
  const Sight& from = load.from;
  const double start = step.previous_time(), end = step.time(), whole = pace * (end - start);
  const double least = std::min(kPartOfThin * from.thin, std::max(kPart * whole, kShallow));
  std::optional<Between> met;
  const auto clear_at = [&](double t) {
    const LoadInput<double> in = read_within(at, step, t, on_cubic);
    const Sight now = load.list->look(load.place, in);
    const Side changed = (now.side ^ load.before) & from.watched, side = load.before ^ changed;
    if (changed.any()) met = Between{t, side, load.across(in, load.before, side)};
    return now.clear;
  };
  struct {
    double time, clear;
  } before{start, from.clear}, here = before, next = before;
  while (true) {
    next.time = here.time + std::max(here.clear, least) / pace;
    const bool ends = next.time >= end;
    next = ends ? decltype(next){end, load.clear_at_end()} : decltype(next){next.time, clear_at(next.time)};
    if (met) return met;
    const bool is_over = ends || next.clear + load.clear_at_end() > pace * (end - next.time);
    const bool dips = here.clear <= before.clear && (here.clear <= next.clear || is_over);
    if (dips && here.clear < least) look_into_dip(before.time, next.time, pace, clear_at, met);
    if (met || is_over) return met;
    before = here;
    here = next;
  }
}

}  // namespace seacrane
