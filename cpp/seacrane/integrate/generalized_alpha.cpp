#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "seacrane/integrate/difference_jacobian.hpp"
#include "seacrane/integrate/fixed_step.hpp"
#include "seacrane/integrate/registration.hpp"
#include "seacrane/integrate/sparse_lu.hpp"

namespace seacrane {
namespace {

constexpr double default_radius = 0.8;
constexpr int most_iterations = 12;
/// Newton's last correction of the velocities, in the error norm.
constexpr double newton_tolerance = 1e-3;
/// A slower contraction than this asks for a new Jacobian, and so do more iterations.
constexpr double slow_contraction = 0.25;
constexpr int patience = 6;

/// Generalised-alpha method of order 2 on the equations of motion with multipliers, M v' = f + D^T lambda,
/// with the constraints on position level (index 3) [J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371;
/// on Lie groups: O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121]:
///   (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) v1' + alpha_f v0',
///   v1 = v0 + h ((1 - gamma) a0 + gamma a1),
///   q1 = q0 moved by h v0 + h^2 ((1/2 - beta) a0 + beta a1), rotations by the exponential.
/// First-order states (memory, work) follow the second line [K. E. Jansen, C. H. Whiting, G. M. Hulbert,
/// Comput. Methods Appl. Mech. Eng. 190 (2000) 305]. v0' is the acceleration of the projected state. Unknown
/// are v1' and lambda; Newton's matrix is exact where the system has a Jacobian, else made by differences,
/// and kept while it contracts.
class GeneralizedAlpha final : public FixedStep {
 public:
  static constexpr IntegratorProperties properties{
      .name = "generalized-alpha",
      .kind = "implicit, fixed step, constraints on position level (index 3)",
      .order = 2,
      .dense_order = 2,
      .default_step = 0.01,  // half of rk4's: order 2 needs it
      .uses_jacobian = true,
      .uses_positions = true,
      .residual_form = true,
      .has_spectral_radius = true,
      .joints = "the method, projection",
      .purpose = "what finite-element and offshore programs step with, for comparison with them"};

  GeneralizedAlpha(const Problem& problem, const IntegratorOptions& options);

  void init(double t0, const double* y0) override {
    FixedStep::init(t0, y0);
    forget();
  }
  void reset(double t, const double* y) override {
    FixedStep::reset(t, y);
    forget();
  }

 private:
  void advance(double h, double t_end) override;
  std::size_t history_size() const override { return 2 + rates_ + unknowns_ + jacobian_.size(); }
  void save_history(std::span<double> history) const override;
  void load_history(std::span<const double> history) override;

  void forget();
  void start_history();
  void place(double h, const double* unknown);
  void evaluate_residual(double h, double t_end, const double* unknown, double* r);
  void refresh_jacobian(double h, double t_end);
  bool exact_jacobian(double h, double t_end);
  void difference_jacobian(double h, double t_end);
  void factor(double h);
  double correct(double h);

  ResidualSystem& residual_system_;
  PositionMap& position_map_;
  std::size_t positions_, rates_, rows_, unknowns_;
  double alpha_m_, alpha_f_, gamma_, beta_;
  /// a1 changes by this when v1' does by one.
  double share_;
  /// a at the end of the last step and the end's time; NaN where there is none.
  std::vector<double> a_, next_a_;
  double a_time_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> unknown_, trial_, residual_, trial_residual_;
  std::vector<double> y_, ydot_, full_residual_, velocity_change_;
  std::vector<double> jacobian_;  // by columns
  std::vector<double> full_jacobian_, move_slopes_;
  SparseLu lu_;
  double factored_step_ = 0.0;
};

GeneralizedAlpha::GeneralizedAlpha(const Problem& problem, const IntegratorOptions& options)
    : FixedStep(properties, problem, options),
      residual_system_(*problem.residual),
      position_map_(*problem.positions),
      positions_(position_map_.position_size()),
      rates_(size() - positions_),
      rows_((residual_system_.size() - size()) / 2),
      unknowns_(rates_ + rows_),
      a_(rates_),
      next_a_(rates_),
      unknown_(unknowns_),
      trial_(unknowns_),
      residual_(unknowns_),
      trial_residual_(unknowns_),
      y_(residual_system_.size()),
      ydot_(residual_system_.size()),
      full_residual_(residual_system_.size()),
      velocity_change_(size()),
      jacobian_(unknowns_ * unknowns_),
      full_jacobian_(residual_system_.size() * residual_system_.size()),
      move_slopes_(positions_ * rates_),
      lu_(unknowns_) {
  const double radius = options.spectral_radius.value_or(default_radius);
  if (!(radius >= 0.0 && radius <= 1.0)) {
    throw std::invalid_argument("spectral_radius is " + std::to_string(radius) +
                                "; give a value from 0 (strongest damping) to 1 (none)");
  }
  alpha_m_ = (2.0 * radius - 1.0) / (radius + 1.0);
  alpha_f_ = radius / (radius + 1.0);
  gamma_ = 0.5 + alpha_f_ - alpha_m_;
  beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
  share_ = (1.0 - alpha_f_) / (1.0 - alpha_m_);
}

void GeneralizedAlpha::forget() {
  a_time_ = std::numeric_limits<double>::quiet_NaN();
  factored_step_ = 0.0;
}

/// a of a fresh start, and the multipliers there as a first guess.
void GeneralizedAlpha::start_history() {
  ++counters_.evaluations;
  residual_system_.expand(time_, state_.data(), y_.data(), ydot_.data());
  std::copy_n(start_derivative_.data() + positions_, rates_, a_.data());
  std::copy_n(y_.data() + size(), rows_, unknown_.data() + rates_);
}

/// y_, ydot_ and next_a_ at the end of the step for v1' and lambda in `unknown`.
void GeneralizedAlpha::place(double h, const double* unknown) {
  const double* const v0 = state_.data() + positions_;
  double* const v1 = y_.data() + positions_;
  std::copy_n(state_.data(), positions_, y_.data());
  for (std::size_t i = 0; i < rates_; ++i) {
    next_a_[i] = share_ * unknown[i] +
                 (alpha_f_ * start_derivative_[positions_ + i] - alpha_m_ * a_[i]) / (1.0 - alpha_m_);
    v1[i] = v0[i] + h * ((0.5 - beta_) * a_[i] + beta_ * next_a_[i]);
  }
  position_map_.move(h, y_.data());
  for (std::size_t i = 0; i < rates_; ++i) {
    v1[i] = v0[i] + h * ((1.0 - gamma_) * a_[i] + gamma_ * next_a_[i]);
    ydot_[positions_ + i] = unknown[i];
  }
  std::copy_n(unknown + rates_, rows_, y_.data() + size());
}

/// Equations of motion and of first-order states, then the constraints, scaled so that all are accelerations.
void GeneralizedAlpha::evaluate_residual(double h, double t_end, const double* unknown, double* r) {
  place(h, unknown);
  ++counters_.evaluations;
  residual_system_.residual(t_end, y_.data(), ydot_.data(), full_residual_.data());
  std::copy_n(full_residual_.data() + positions_, rates_, r);
  const double scale = 1.0 / (share_ * (beta_ * h * h));
  const double* const rows = full_residual_.data() + size() + rows_;
  for (std::size_t i = 0; i < rows_; ++i) r[rates_ + i] = scale * rows[i];
  if (all_finite(r, unknowns_)) return;
  const std::size_t bad = first_non_finite(r, unknowns_);
  fail(h, bad < rates_ ? positions_ + bad : IntegrationError::no_component,
       "the equations of motion are not finite; take a shorter fixed step");
}

void GeneralizedAlpha::refresh_jacobian(double h, double t_end) {
  ++counters_.jacobians;
  factored_step_ = 0.0;
  if (!exact_jacobian(h, t_end)) difference_jacobian(h, t_end);
  factor(h);
}

/// Chain rule through place(): v1 changes by gamma h share per v1', the velocity that moves q0 by beta h
/// share.
bool GeneralizedAlpha::exact_jacobian(double h, double t_end) {
  const std::size_t n = residual_system_.size();
  const double of_velocity = share_ * gamma_ * h, of_motion = share_ * beta_ * h;
  place(h, unknown_.data());
  const double* const f = full_jacobian_.data();
  if (!residual_system_.jacobian(t_end, 1.0 / of_velocity, y_.data(), ydot_.data(), full_jacobian_.data())) {
    return false;
  }
  for (std::size_t i = 0; i < rates_; ++i) {
    y_[positions_ + i] = state_[positions_ + i] + h * ((0.5 - beta_) * a_[i] + beta_ * next_a_[i]);
  }
  std::copy_n(state_.data(), positions_, y_.data());
  if (!position_map_.move_jacobian(h, y_.data(), move_slopes_.data())) return false;
  ++counters_.evaluations;
  const double scale = 1.0 / (of_motion * h);
  const std::size_t rows = size() + rows_;
  const auto add = [&](double factor, const double* from, double* column) {
    for (std::size_t i = 0; i < rates_; ++i) column[i] += factor * from[positions_ + i];
    for (std::size_t i = 0; i < rows_; ++i) column[rates_ + i] += factor * scale * from[rows + i];
  };
  std::fill(jacobian_.begin(), jacobian_.end(), 0.0);
  for (std::size_t j = 0; j < unknowns_; ++j) {
    double* const column = jacobian_.data() + j * unknowns_;
    add(j < rates_ ? of_velocity : 1.0, f + (positions_ + j) * n, column);
    for (std::size_t k = 0; j < rates_ && k < positions_; ++k) {
      const double moved = move_slopes_[j * positions_ + k];
      if (moved != 0.0) add(of_motion * moved, f + k * n, column);
    }
  }
  return all_finite(jacobian_.data(), jacobian_.size());
}

void GeneralizedAlpha::difference_jacobian(double h, double t_end) {
  double multiplier = 1.0;
  for (std::size_t j = rates_; j < unknowns_; ++j) multiplier = std::max(multiplier, std::abs(unknown_[j]));
  trial_ = unknown_;
  for (std::size_t j = 0; j < unknowns_; ++j) {
    const std::size_t component = positions_ + j;
    // The residual is linear in the multipliers.
    const double increment =
        j >= rates_ ? multiplier
                    : difference_increment(state_[component], h * unknown_[j], norm_.typical(component)) /
                          (share_ * gamma_ * h);
    trial_[j] = unknown_[j] + increment;
    evaluate_residual(h, t_end, trial_.data(), trial_residual_.data());
    trial_[j] = unknown_[j];
    double* const column = jacobian_.data() + j * unknowns_;
    for (std::size_t i = 0; i < unknowns_; ++i) column[i] = (trial_residual_[i] - residual_[i]) / increment;
  }
}

void GeneralizedAlpha::factor(double h) {
  for (std::size_t j = 0; j < unknowns_; ++j) {
    std::copy_n(jacobian_.data() + j * unknowns_, unknowns_, lu_.column(j));
  }
  if (!lu_.factor()) {
    fail(h, IntegrationError::no_component,
         "the iteration matrix is singular: constraints depend on each other; use a projecting method");
  }
  factored_step_ = h;
}

/// One Newton correction; its size in the velocities.
double GeneralizedAlpha::correct(double h) {
  lu_.solve(residual_.data());
  for (std::size_t j = 0; j < unknowns_; ++j) unknown_[j] -= residual_[j];
  for (std::size_t i = 0; i < rates_; ++i)
    velocity_change_[positions_ + i] = h * gamma_ * share_ * residual_[i];
  return norm_.norm(velocity_change_.data(), state_.data());
}

void GeneralizedAlpha::advance(double h, double t_end) {
  if (a_time_ == time_) {
    a_.swap(next_a_);
  } else {
    start_history();
  }
  // Until the step is done there is no history to continue from.
  a_time_ = std::numeric_limits<double>::quiet_NaN();
  std::copy_n(start_derivative_.data() + positions_, rates_, unknown_.data());
  double last = std::numeric_limits<double>::infinity();
  bool fresh = false;
  for (int i = 0; i < most_iterations; ++i) {
    evaluate_residual(h, t_end, unknown_.data(), residual_.data());
    if (h != factored_step_) {
      refresh_jacobian(h, t_end);
      fresh = true;
    }
    const double change = correct(h);
    ++counters_.newton_iterations;
    // A Jacobian of this very step is as good as it gets.
    if (!fresh && (change > slow_contraction * last || i >= patience)) factored_step_ = 0.0;
    // Within the tolerances, a correction that falls no more is rounding.
    if (change < newton_tolerance || (change < 1.0 && change > 0.5 * last)) {
      place(h, unknown_.data());
      std::copy_n(y_.data(), size(), end_state_.data());
      a_time_ = t_end;
      return;
    }
    last = change;
  }
  std::size_t worst = positions_;
  for (std::size_t i = positions_; i < size(); ++i) {
    const auto part = [&](std::size_t j) { return std::abs(velocity_change_[j]) / norm_.absolute()[j]; };
    if (part(i) > part(worst)) worst = i;
  }
  fail(h, worst, "Newton's iteration does not converge; take a shorter fixed step");
}

void GeneralizedAlpha::save_history(std::span<double> history) const {
  auto out = history.begin();
  *out++ = a_time_;
  *out++ = factored_step_;
  out = std::copy(next_a_.begin(), next_a_.end(), out);
  out = std::copy(unknown_.begin(), unknown_.end(), out);
  std::copy(jacobian_.begin(), jacobian_.end(), out);
}

void GeneralizedAlpha::load_history(std::span<const double> history) {
  const double* in = history.data();
  a_time_ = *in++;
  const double step = *in++;
  std::copy_n(in, rates_, next_a_.data());
  std::copy_n(in + rates_, unknowns_, unknown_.data());
  std::copy_n(in + rates_ + unknowns_, jacobian_.size(), jacobian_.data());
  factored_step_ = 0.0;
  if (step > 0.0) factor(step);
}

}  // namespace

extern const Registration generalized_alpha = registration<GeneralizedAlpha>();

}  // namespace seacrane
