#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace seacrane {

/// A quantity whose change of sign is an event.
using EventFunction = std::function<double(double t, const double* y)>;

/// The last step of a method, or of one of the systems that it steps side by side.
class LastStep {
 public:
  LastStep(std::string name, std::size_t size);
  virtual ~LastStep() = default;

  const std::string& name() const { return name_; }
  std::size_t size() const { return state_.size(); }
  double time() const { return time_; }
  /// Start of the last step; time() right after init, reset and load.
  double previous_time() const { return previous_time_; }
  /// State at time(), projected where the method projects.
  const double* state() const { return state_.data(); }
  /// State at previous_time(), projected likewise.
  const double* previous_state() const { return previous_state_.data(); }

  /// Dense output of the last step at t in [previous_time(), time()]; not projected.
  virtual void interpolate(double t, double* y) const = 0;

  /// Time in the last step at which `event` changes sign, to rounding, on the side where it has changed;
  /// nothing when its sign at time() is that at previous_time(). An event that is zero at the start of the
  /// step has been found by the step before. Of several events in one step it finds one.
  std::optional<double> locate(const EventFunction& event);

 protected:
  double time_ = 0.0;
  double previous_time_ = 0.0;
  std::vector<double> state_;
  std::vector<double> previous_state_;

 private:
  std::string name_;
  std::vector<double> event_state_;
};

}  // namespace seacrane
