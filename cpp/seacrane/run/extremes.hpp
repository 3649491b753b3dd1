#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "seacrane/run/held_forces.hpp"
#include "seacrane/run/peak_window.hpp"
#include "seacrane/run/recording.hpp"
#include "seacrane/run/stepper.hpp"

namespace seacrane {

/// Values of channels at the middle and the end of every step, for what is made of them elsewhere. Memory
/// grows with the steps.
struct Trail {
  std::vector<const RecordedChannel*> channels;
  std::vector<double> times, rows;

  std::size_t width() const {
    std::size_t out = 0;
    for (const RecordedChannel* c : channels) out += c->size;
    return out;
  }
  /// Drops what was until a time.
  void drop(double until) {
    const auto kept = std::ranges::upper_bound(times, until) - times.begin();
    times.erase(times.begin(), times.begin() + kept);
    rows.erase(rows.begin(), rows.begin() + kept * static_cast<std::ptrdiff_t>(width()));
  }
};

/// Least and largest values of recorded channels between outputs, from the steps of a run. What follows from
/// a state is taken at the middle and the end of every step; what needs a solution, from the last evaluation
/// of the step, which the integrator has made. Peaks between these are those of the polynomial through five
/// of them, see PeakWindow. Nothing is allocated while the run goes on.
class Extremes {
 public:
  using StateAt = std::function<void(double t, double* y)>;

  /// Of the channels of a recording that have least and largest values, which outlives this. `trail`: those
  /// of them whose values are kept at every step, as far as they follow from a state.
  Extremes(const Model& model, Recording& recording, const std::set<std::string>& trail);

  /// Whether anything is taken from the last evaluation of a step.
  bool has_evaluations() const { return !evaluations_.curves.empty(); }
  /// Takes what the last evaluation tells right after a step, before anything else is evaluated. `placed`:
  /// what is stepped has its bodies there.
  void read_evaluation(Stepper& at, double t, const double* y, bool placed);
  /// Takes a step, or its part, from a time to another. `forces`: of limits in its
  /// middle, then at its end; null: not known.
  void take(Stepper& at, double from, double to, const StateAt& state_at, const double* forces);
  /// What a run that continues needs, of the same channels: values since the last output, and of the stretch.
  std::vector<double> save() const;
  void load(const std::vector<double>& saved);
  /// Takes the end of a step alone: of a run that is stepped beside others.
  void take_end(Stepper& at, double from, double to, const StateAt& state_at);
  /// What is evaluated at the ends of steps as at outputs: nothing where no channel is.
  bool has_ends() const { return !ends_.curves.empty(); }
  bool begins_ends() const { return ends_.window.empty(); }
  const Needs& needs_of_ends() const { return needs_of_ends_; }
  void see_end(const Output& output);
  const Trail& trail() const { return trail_; }
  void drop_trail(double until) { trail_.drop(until); }
  /// The next step begins on the other side of a kink, or the run ends.
  void end_stretch();
  /// The step has kinks inside: no curve goes through its values.
  void forget_stretch();

 private:
  struct Curve {
    const RecordedChannel* channel;
    std::size_t at;
  };
  /// Curves that are known at the same times.
  struct Group {
    std::vector<const RecordedChannel*> channels;
    std::vector<Curve> curves;
    PeakWindow window{0};

    void begin();
  };

  std::array<Group*, 4> groups() { return {&states_, &evaluations_, &limits_, &ends_}; }
  std::array<const Group*, 4> groups() const { return {&states_, &evaluations_, &limits_, &ends_}; }
  double layout() const;
  void take_state(Stepper& at, double t, const StateAt& state_at);
  void place(Stepper& at, double t, const double* y);
  Output output(Stepper& at, double t, const double* state, const Terms& terms);
  void add(Group& group, double t, const double* values);
  auto seeing(const Group& group) {
    return [this, &group](std::size_t k, double t, double value) {
      const Curve& curve = group.curves[k];
      recording_.see(*curve.channel, curve.at, t, value);
    };
  }

  const Model& model_;
  Recording& recording_;
  Group states_, evaluations_, limits_, ends_;
  Needs needs_of_ends_;
  Trail trail_;
  bool needs_coordinates_ = false, has_accelerations_ = false, has_held_ = false, has_lines_ = false;
  std::vector<Vec6d> accelerations_;  // of the described bodies, at the last evaluation
  double evaluated_ = 0.0;            // time of evaluation_
  std::vector<double> evaluation_;    // of the last step
  HeldForces held_;
  std::vector<double> row_, end_, state_, bodies_, stepped_;
  std::vector<CoordinateRow<double>> coordinates_;
  std::vector<BodyLoad<double>> one_load_;
};

}  // namespace seacrane
