#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/integrate/integrator.hpp"

namespace seacrane {

struct Stepper;

/// What can go wrong with a run, reported by the names of the scene. Only require_finite(),
/// StallWatch::step() and RankWatch::sees() are in the loop: a sum over the state and two comparisons per
/// step.

/// rad that a body turns in one step: no method resolves more.
inline constexpr double kLargestTurn = 3.14159265358979323846;

/// Throws IntegrationError, with the component named, when the state that was stepped to is not finite.
void require_finite(const Integrator& integrator, const Formulation& stepped);

/// Throws `error` again, in the words of the scene: the state that dominates, what is not finite from the
/// last good state of `at` on (body, load and time), and what has grown beyond any motion.
[[noreturn]] void explain(const IntegrationError& error, Stepper& at);

/// Stops a run whose steps have become so short that it would never end, as around a force that switches its
/// sign at rest. Of adaptive methods: a fixed step is what was asked for.
class StallWatch {
 public:
  /// After each step. Throws std::domain_error.
  void step(double t);

 private:
  long steps_ = 0;
  double from_ = -std::numeric_limits<double>::infinity();  // s, where the steps counted began
};

/// Stops a run whose energy does not close.
class EnergyWatch {
 public:
  /// `limit`: largest balance over the absolute work and the largest kinetic energy so far; none: no limit.
  explicit EnergyWatch(std::optional<double> limit);

  bool has_limit() const { return limit_.has_value(); }
  /// Where there is a limit, at an output, after `terms` were evaluated there: the energy balance, the
  /// absolute work since the start and the energy itself (J). Throws std::domain_error beyond the limit.
  void check(double t, const double* y, const Terms& terms, double balance, double absolute_work,
             double energy);

 private:
  std::optional<double> limit_;
  double largest_kinetic_ = 0.0;
};

/// How near constraints came to depending on each other, and where.
struct RankReport {
  double pivot = 1.0;  // smallest d_i / S_ii: what earlier rows leave of a row, masses included; with
                       // redundant rows the square of the singular value
  double singular_value = 1.0;  // smallest but those of redundant rows over largest, by geometry alone; NaN
                                // for large systems
  double time = 0.0;            // s
  std::string element;          // joint or driver with the largest part in it; empty for large systems
  bool rank_changed = false;    // rows independent before were not enforced, or the start was singular
};

/// Keeps the state at which constraints came nearest to depending on each other, by the ratio that every
/// factorisation tells anyway.
class RankWatch {
 public:
  /// Whether the ratio here is clearly above all before, or the rank has changed: then the state is to be
  /// kept. The ratio grows by a tenth at least each time, so that a run keeps few.
  bool sees(const Dependence& found) const {
    return found.ratio > 1.1 * worst_ || (!changed_ && (found.lost_rank() || found.gained_rank()));
  }
  /// `bodies`: the state of the bodies of `model`, whose rows they are.
  void keep(double t, const Dependence& found, const std::shared_ptr<const Model>& model,
            const double* bodies);
  /// Evaluates the model at the state kept, which is its start where that has turned out to be singular;
  /// nothing where there are no constraints.
  std::optional<RankReport> report() const;

 private:
  double worst_ = 0.5, time_ = 0.0;  // every ratio is at least 1: the first is kept
  bool changed_ = false;
  int redundant_ = 0;
  std::shared_ptr<const Model> model_;
  std::vector<double> bodies_;
};

}  // namespace seacrane
