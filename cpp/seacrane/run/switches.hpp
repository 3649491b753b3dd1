#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "seacrane/elements/loads/load_kind.hpp"
#include "seacrane/run/stepper.hpp"

namespace seacrane {

/// A bound that a load of the scene ran into, such as "hoist.stroke", or what a point of a contact did.
struct LimitReached {
  double time = 0.0;  // s
  std::string name;
  const char* kind = "limit";
  double speed = 0.0;  // m/s, of a point that touches
};

/// A line on the quasi-static rung that would go slack, or whose winch has hauled in to its end.
class LineSlackError : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// Kinks that loads have in the state: where a soft stop is touched, left or lets go, the corners of a
/// spring's table, where a line goes slack or taut. They have no time to offer. A step that ends on another
/// side of one is taken again, up to where it crossed, so that every step sees one side only. A load that may
/// have kinks has margins(input); or side(input), and across(input, from, to), which changes its sign
/// between two sides; and has_sides(), where not every one has them. What it may have besides:
///
/// - look(input): its side, and how near it is to what it may meet and leave again within a step.
/// - jumps(from, to), whether states of its own jump there, and settle(input, side, states), which writes
/// them.
/// - happened(input, from, to), and reached(from, to): names of bounds that a user has to know of.
/// - refused(side), why it cannot be there: the run ends.
class Switches {
 public:
  /// Whether loads of a model have such kinks.
  static bool any(const Model& model);
  /// The first load whose states jump where a kink is passed, "contact 'feet'"; empty: there is none. Where
  /// there is one, every method ends its steps on kinks.
  static std::string first_that_jumps(const Model& model);

  /// Takes the sides at the state (t, y) of what is stepped, where a step starts. Throws std::domain_error
  /// where a load cannot be on its side.
  void watch(Stepper& at, double t, const double* y);
  /// Begins a run that goes on: what is at a bound there has been noted before.
  void resume(Stepper& at, double t, const double* y);
  /// The time at which the last step of `at` is to end when it is taken again: that of the first crossing
  /// inside it. If a load jumped as the step began, and the step still began on the old side, that time is
  /// just after the step's start. If the step came no nearer to its crossing, it is made longer, to lead
  /// across. Nothing, if the step stands: the next one starts from the sides at its end.
  std::optional<double> find(Stepper& at, LastStep& step);
  /// As find(), of a step whose own crossings are left to the step control: where it is to end on what it
  /// would step over, or a little before, and from there a little behind. Nothing: the step stands.
  std::optional<double> find_between(Stepper& at, LastStep& step, bool ends_before);
  /// Writes such states of the described or the stepped bodies, all states of loads in a row, for the last
  /// step's end (t, y); before the first step as far as the state shows that they are not given.
  void settle(Stepper& at, double t, const double* y, double* load_states);
  /// Whether the last step ended on a kink where states jump.
  bool has_jumped() const { return has_jumped_; }
  /// Where the next step is to end at the latest, after one that ended at time `now` where something was
  /// struck, if steps of length `step` lead far beyond: infinity otherwise. See look_between().
  double end_of_strike(double now, double step) const;
  /// Cuts the last step: only its part until t counts.
  void shorten(double t);
  /// Bounds reached so far.
  const std::vector<LimitReached>& reached() const { return reached_; }

 private:
  /// A crossing that a step is to end on, the length of that which found it, and the load's margin to it
  /// where both start.
  struct Aim {
    double time = std::numeric_limits<double>::quiet_NaN();
    double length = 0.0;
    std::size_t load = 0;
    Side to;
    double from_start = 0.0;
  };

  /// What a step met and left again: when, on which side it was then, and how far across.
  struct Between {
    double time;
    Side side;
    double across;
  };

  /// A load with sides, on which side it is as the last step begins and as it ends, and what it sees there.
  struct Watched {
    const LoadList* list;
    LoadList::Place place;
    Side before, after;
    Side passed;                              // on that just after the step's start
    std::optional<Side> left = std::nullopt;  // where its states last jumped or the last step began
    Sight from = {}, to = {};
    double instant = 0.0;  // of the change

    bool changes() const { return before != after; }
    double across(const LoadInput<double>& in, const Side& first, const Side& second) const {
      return list->across(place, in, first, second);
    }
    double across(const LoadInput<double>& in) const { return across(in, before, after); }
    /// m or rad to what it may meet, where the step ends.
    double clear_at_end() const { return changes() ? 0.0 : to.clear; }
  };

  void look(Stepper& at, double t, const double* y);
  void begin_from(Stepper& at, double t, const double* y, LastStep* step = nullptr);
  void turn();
  std::optional<double> look_between(Stepper& at, LastStep& step);
  std::optional<Between> look_between(Stepper& at, const LastStep& step, const Watched& load, double pace,
                                      bool on_cubic);
  void end_on(Stepper& at, LastStep& step, const Between& met, std::size_t load,
              std::optional<double>& first);
  double before_touch(const LastStep& step, double found, const Watched& load) const;
  void refuse_long(Stepper& at, const LastStep& step);
  void refuse(double t) const;
  void list_loads(const Stepper& at);
  void note();
  void note_happenings(Stepper& at, double t, const double* y);
  void finish(Stepper& at, const LastStep& step);
  bool fell_short(Stepper& at, const LastStep& step);
  bool began_behind(Stepper& at, const LastStep& step, double margin);
  void pass_start(Stepper& at, const LastStep& step);
  LoadInput<double> read(Stepper& at, double t, const double* y);
  LoadInput<double> read_within(Stepper& at, const LastStep& step, double t, bool on_cubic);

  std::vector<Watched> watched_;
  bool has_begun_ = false, is_new_ = true;  // the run; the list: no sides are known of it
  double settled_at_ = std::numeric_limits<double>::quiet_NaN();
  bool has_jumped_ = false;
  double strike_pace_ = 0.0, strike_thin_ = Sight::kFar;  // of what the last step ended on, as of Sight
  Aim aim_;                                               // of the step that is taken again
  bool ends_before_ = false;                              // of a method that cannot restart where it touches
  bool leads_across_ = false;                             // the step under way, a jump: it is not taken again
  std::vector<LimitReached> reached_;
  std::vector<double> state_, rate_, late_rate_, end_rate_, scale_;  // of what is stepped
};

}  // namespace seacrane
