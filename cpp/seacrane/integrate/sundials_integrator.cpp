#include "seacrane/integrate/sundials_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "seacrane/integrate/difference_jacobian.hpp"

namespace seacrane {
namespace {

void add(Counters& sum, const Counters& part) {
  sum.steps += part.steps;
  sum.rejected_steps += part.rejected_steps;
  sum.newton_iterations += part.newton_iterations;
}

}  // namespace

SundialsIntegrator::SundialsIntegrator(const IntegratorProperties& properties, const Problem& problem,
                                       const IntegratorOptions& options, const sundials::Solver& solver,
                                       const Tolerances& tolerances, std::size_t unknowns)
    : Integrator(properties, problem.system.size()),
      system_(problem.system),
      options_(options),
      solver_(solver),
      norm_(tolerances, unknowns),
      context_(sundials::create_context(messages_)),
      solution_(unknowns),
      solution_vector_(sundials::view(solution_, context_)),
      memory_(nullptr, sundials::FreeMemory{solver.free}),
      dense_(unknowns),
      dense_vector_(sundials::view(dense_, context_)),
      errors_(unknowns),
      weights_(unknowns),
      errors_vector_(sundials::view(errors_, context_)),
      weights_vector_(sundials::view(weights_, context_)) {
  if (!context_) throw std::runtime_error("SUNDIALS could not create its context");
  check_step_sizes(options);
}

void SundialsIntegrator::init(double t0, const double* y0) {
  set_state(t0, y0);
  counters_ = before_restart_ = Counters{};
  started_ = false;
  must_restart_ = true;
  step_before_restart_ = std::numeric_limits<double>::infinity();
  carried_ = false;
}

void SundialsIntegrator::create() {
  memory_.reset(make());
  if (!memory_) throw std::runtime_error(name() + ": " + solver_.name + " could not be created");
  require(solver_.set_user_data(memory(), this), "SetUserData");
  require(solver_.set_weights(memory(), weigh), "WFtolerances");
  require(solver_.set_max_step(memory(), options_.max_step), "SetMaxStep");
  require(solver_.set_init_step(memory(), options_.initial_step), "SetInitStep");
  attach(memory());
}

void SundialsIntegrator::restart() {
  expand();
  if (memory_) {
    reinitialise(memory());
    return;
  }
  try {
    create();
  } catch (...) {
    memory_.reset();
    throw;
  }
}

int SundialsIntegrator::derivative(sunrealtype t, N_Vector y, N_Vector ydot, void* user_data) {
  return self(user_data).evaluate(t, sundials::data(y), sundials::data(ydot));
}

int SundialsIntegrator::weigh(N_Vector y, N_Vector weights, void* user_data) {
  self(user_data).fill_weights(sundials::data(y), sundials::data(weights));
  return 0;
}

double SundialsIntegrator::attempted_step() const {
  double h = 0.0;
  solver_.current_step(memory(), &h);
  return h;
}

Counters SundialsIntegrator::solver_counters() const {
  Counters now;
  solver_.steps(memory(), &now.steps);
  solver_.error_test_failures(memory(), &now.rejected_steps);
  solver_.newton_iterations(memory(), &now.newton_iterations);
  return now;
}

void SundialsIntegrator::project_state(double t) {
  if (!system_.has_projection()) return;
  ++counters_.projections;
  system_.project(t, state_.data(), false);
  if (check_finite(state_.data(), size()) != 0) {
    messages_.last_error = "the projected state is not finite";
    fail("the projection");
  }
}

double SundialsIntegrator::step_in_use() const {
  return must_restart_ ? step_before_restart_ : attempted_step();
}

void SundialsIntegrator::reset(double t, const double* y) {
  if (!must_restart_) step_before_restart_ = std::max(attempted_step(), time_ - previous_time_);
  set_state(t, y);
  ++counters_.restarts;
  must_restart_ = true;
  carried_ = false;
}

Counters SundialsIntegrator::counters() const {
  Counters all = counters_;
  add(all, before_restart_);
  if (started_) add(all, solver_counters());
  return all;
}

std::vector<double> SundialsIntegrator::save() const {
  std::vector<double> saved = {time_};
  saved.insert(saved.end(), state_.begin(), state_.end());
  return saved;
}

void SundialsIntegrator::load(std::span<const double> saved) {
  if (saved.size() != 1 + size()) {
    throw std::invalid_argument(name() + ": the saved integrator state holds " +
                                std::to_string(saved.size()) + " values, this system needs " +
                                std::to_string(1 + size()));
  }
  reset(saved[0], saved.data() + 1);
}

void SundialsIntegrator::step(double t_limit) {
  check_limit(t_limit);
  if (t_limit == time_) return;
  const double before = time_;
  previous_time_ = time_;
  previous_state_ = state_;
  carried_ = t_limit - time_ <= 64.0 * kEpsilon * std::max(std::abs(time_), std::abs(t_limit));
  if (carried_) {
    // The solvers refuse such a step; over it the state changes by rounding only.
    time_ = t_limit;
    must_restart_ = true;
    return;
  }
  pending_ = nullptr;
  bad_component_ = IntegrationError::no_component;
  messages_.last_error.clear();
  // A solver starts as short as it likes and grows from there: far from t = 0 by few roundings of the time.
  const double shortest = must_restart_ ? 0.0 : 0.1 * smallest_step(time_);
  try {
    if (must_restart_) {
      if (started_) add(before_restart_, solver_counters());
      started_ = false;
      restart();
      started_ = true;
      must_restart_ = false;
    }
    const double reached = advance(t_limit);
    if (reached < t_limit && reached - before < shortest) {
      messages_.last_error = "the step size has collapsed";
      fail("step");
    }
    time_ = reached;
  } catch (...) {
    previous_time_ = before;
    state_ = previous_state_;
    must_restart_ = true;
    throw;
  }
}

void SundialsIntegrator::interpolate(double t, double* y) const {
  t = inside_last_step(t);
  if (carried_ || must_restart_ || previous_time_ == time_) {
    std::copy(state_.begin(), state_.end(), y);
    return;
  }
  if (solver_.dense_output(memory(), t, 0, dense_vector_.get()) < 0) fail("dense output");
  contract(t, dense_, y);
}

int SundialsIntegrator::check_finite(const double* values, std::size_t size) {
  if (all_finite(values, size)) return 0;
  bad_component_ = first_non_finite(values, size);
  return 1;
}

int SundialsIntegrator::evaluate(double t, const double* y, double* ydot) {
  return guarded([&] {
    ++counters_.evaluations;
    system_.derivative(t, y, ydot);
    return check_finite(ydot, size());
  });
}

int SundialsIntegrator::dense_jacobian(sunrealtype t, N_Vector y, N_Vector slope, SUNMatrix matrix,
                                       void* user_data, N_Vector, N_Vector, N_Vector) {
  return self(user_data).fill_jacobian(t, sundials::data(y), sundials::data(slope),
                                       SUNDenseMatrix_Data(matrix));
}

int SundialsIntegrator::fill_jacobian(double t, const double* y, const double* slope, double* columns) {
  ++counters_.jacobians;
  bool exact = false;
  const int flag = guarded([&] {
    exact = exact_jacobian(system_, t, y, columns, counters_);
    return 0;
  });
  if (exact || flag != 0) return flag;
  trial_.resize(size());
  trial_slope_.resize(size());
  return difference_jacobian(
      y, slope, attempted_step(), norm_, trial_, trial_slope_,
      [&](const double* at, double* f) { return evaluate(t, at, f); },
      [&](std::size_t j) { return columns + j * size(); });
}

std::size_t SundialsIntegrator::dominant_component() const {
  if (bad_component_ != IntegrationError::no_component) return bad_component_;
  if (solver_.local_errors(memory(), errors_vector_.get()) < 0 ||
      solver_.weights(memory(), weights_vector_.get()) < 0) {
    return IntegrationError::no_component;
  }
  std::size_t worst = IntegrationError::no_component;
  double largest = 0.0;
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    const double ratio = std::abs(errors_[i]) * weights_[i];
    if (ratio > largest) {
      largest = ratio;
      worst = i;
    }
  }
  return worst;
}

void SundialsIntegrator::fail(const std::string& call) const {
  if (pending_) std::rethrow_exception(std::exchange(pending_, nullptr));
  std::string reason = messages_.last_error.empty() ? call + " failed" : messages_.last_error;
  if (bad_component_ != IntegrationError::no_component) reason = "the derivative is not finite; " + reason;
  throw IntegrationError(name(), time_, attempted_step(), dominant_component(), reason);
}

void SundialsIntegrator::require(int flag, const char* call) const {
  if (flag >= 0) return;
  throw std::runtime_error(name() + ": " + call + " failed with flag " + std::to_string(flag) +
                           (messages_.last_error.empty() ? "" : ": " + messages_.last_error));
}

}  // namespace seacrane
