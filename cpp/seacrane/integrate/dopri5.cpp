#include <algorithm>
#include <cmath>

#include "seacrane/integrate/one_step.hpp"
#include "seacrane/integrate/registry.hpp"

namespace seacrane {
namespace {

// Dormand and Prince 5(4), and its dense output of order 4
// [Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, table II.5.2 and section II.6].
constexpr double c2 = 1.0 / 5, c3 = 3.0 / 10, c4 = 4.0 / 5, c5 = 8.0 / 9;
constexpr double a21 = 1.0 / 5;
constexpr double a31 = 3.0 / 40, a32 = 9.0 / 40;
constexpr double a41 = 44.0 / 45, a42 = -56.0 / 15, a43 = 32.0 / 9;
constexpr double a51 = 19372.0 / 6561, a52 = -25360.0 / 2187, a53 = 64448.0 / 6561, a54 = -212.0 / 729;
constexpr double a61 = 9017.0 / 3168, a62 = -355.0 / 33, a63 = 46732.0 / 5247, a64 = 49.0 / 176,
                 a65 = -5103.0 / 18656;
constexpr double b1 = 35.0 / 384, b3 = 500.0 / 1113, b4 = 125.0 / 192, b5 = -2187.0 / 6784, b6 = 11.0 / 84;
constexpr double e1 = 71.0 / 57600, e3 = -71.0 / 16695, e4 = 71.0 / 1920, e5 = -17253.0 / 339200,
                 e6 = 22.0 / 525, e7 = -1.0 / 40;
constexpr double d1 = -12715105075.0 / 11282082432, d3 = 87487479700.0 / 32700410799,
                 d4 = -10690763975.0 / 1880347072, d5 = 701980252875.0 / 199316789632,
                 d6 = -1453857185.0 / 822651844, d7 = 69997945.0 / 29380423;

// PI step size control [Hairer, Wanner II, IV.2], with the constants of Hairer's code.
constexpr double beta = 0.04, alpha = 0.2 - 0.75 * beta, safety = 0.9;
constexpr double strongest_cut = 0.2, strongest_growth = 10.0;
/// Cut after a derivative that was not finite, where no error estimate tells the size.
constexpr double blind_cut = 0.25;

class DormandPrince final : public OneStepIntegrator {
 public:
  DormandPrince(System& system, const IntegratorOptions& options)
      : OneStepIntegrator("dopri5", system, options),
        stage_state_(size()),
        k2_(size()),
        k3_(size()),
        k4_(size()),
        k5_(size()),
        k6_(size()),
        max_step_(options.max_step) {}

  int order() const override { return 5; }
  bool is_adaptive() const override { return true; }
  void step(double t_limit) override;
  void interpolate(double t, double* y) const override;

 private:
  double starting_step(double remaining);
  bool try_step(double h, double t_end);
  bool stage(double t, const double* y, std::vector<double>& k);
  double error(double h) const;
  std::size_t dominant_component(double h) const;
  void after_success(double h, double error, bool cut_before, bool truncated);

  std::vector<double> stage_state_, k2_, k3_, k4_, k5_, k6_;
  double max_step_;
  std::size_t bad_component_ = IntegrationError::no_component;
};

/// Evaluates into k; false, with the component noted, when the result is not finite.
bool DormandPrince::stage(double t, const double* y, std::vector<double>& k) {
  evaluate(t, y, k.data());
  if (all_finite(k.data(), size())) return true;
  bad_component_ = first_non_finite(k.data(), size());
  return false;
}

/// All stages of a step of length h; false when a derivative is not finite.
bool DormandPrince::try_step(double h, double t_end) {
  const std::size_t n = size();
  const double t = time_;
  const double* const y = state_.data();
  const double* const k1 = start_derivative_.data();
  const double* const k2 = k2_.data();
  const double* const k3 = k3_.data();
  const double* const k4 = k4_.data();
  const double* const k5 = k5_.data();
  const double* const k6 = k6_.data();
  double* __restrict const z = stage_state_.data();
  double* __restrict const end = end_state_.data();
  bad_component_ = IntegrationError::no_component;

  for (std::size_t i = 0; i < n; ++i) z[i] = y[i] + h * (a21 * k1[i]);
  if (!stage(t + c2 * h, z, k2_)) return false;
  for (std::size_t i = 0; i < n; ++i) z[i] = y[i] + h * (a31 * k1[i] + a32 * k2[i]);
  if (!stage(t + c3 * h, z, k3_)) return false;
  for (std::size_t i = 0; i < n; ++i) z[i] = y[i] + h * (a41 * k1[i] + a42 * k2[i] + a43 * k3[i]);
  if (!stage(t + c4 * h, z, k4_)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    z[i] = y[i] + h * (a51 * k1[i] + a52 * k2[i] + a53 * k3[i] + a54 * k4[i]);
  }
  if (!stage(t + c5 * h, z, k5_)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    z[i] = y[i] + h * (a61 * k1[i] + a62 * k2[i] + a63 * k3[i] + a64 * k4[i] + a65 * k5[i]);
  }
  if (!stage(t_end, z, k6_)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    end[i] = y[i] + h * (b1 * k1[i] + b3 * k3[i] + b4 * k4[i] + b5 * k5[i] + b6 * k6[i]);
  }
  bad_component_ = all_finite(end, n) ? IntegrationError::no_component : first_non_finite(end, n);
  if (bad_component_ != IntegrationError::no_component) return false;
  return stage(t_end, end, end_derivative_);
}

double DormandPrince::error(double h) const {
  const std::size_t n = size();
  const double* const absolute = norm_.absolute();
  const double relative = norm_.relative();
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double slope = e1 * start_derivative_[i] + e3 * k3_[i] + e4 * k4_[i] + e5 * k5_[i] + e6 * k6_[i] +
                         e7 * end_derivative_[i];
    const double tolerance = absolute[i] + relative * std::max(std::abs(state_[i]), std::abs(end_state_[i]));
    const double ratio = slope / tolerance;
    sum += ratio * ratio;
  }
  return h * std::sqrt(sum * norm_.inverse_count());
}

std::size_t DormandPrince::dominant_component(double h) const {
  if (bad_component_ != IntegrationError::no_component) return bad_component_;
  std::size_t worst = 0;
  double largest = -1.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double slope = e1 * start_derivative_[i] + e3 * k3_[i] + e4 * k4_[i] + e5 * k5_[i] + e6 * k6_[i] +
                         e7 * end_derivative_[i];
    const double tolerance = norm_.absolute()[i] + norm_.relative() * std::abs(state_[i]);
    const double ratio = h * std::abs(slope) / tolerance;
    if (ratio > largest) {
      largest = ratio;
      worst = i;
    }
  }
  return worst;
}

/// First step size from the derivative and its change over a small Euler step
/// [Hairer, Norsett, Wanner I, II.4].
double DormandPrince::starting_step(double remaining) {
  const double size_of_state = norm_.norm(state_.data(), state_.data());
  const double size_of_slope = norm_.norm(start_derivative_.data(), state_.data());
  double h0 = size_of_state < 1e-5 || size_of_slope < 1e-5 ? 1e-6 : 0.01 * size_of_state / size_of_slope;
  h0 = std::min(h0, remaining);
  if (max_step_ > 0.0) h0 = std::min(h0, max_step_);
  for (std::size_t i = 0; i < size(); ++i) stage_state_[i] = state_[i] + h0 * start_derivative_[i];
  if (!stage(time_ + h0, stage_state_.data(), k2_)) return blind_cut * h0;
  for (std::size_t i = 0; i < size(); ++i) k3_[i] = k2_[i] - start_derivative_[i];
  const double curvature = norm_.norm(k3_.data(), state_.data()) / h0;
  const double steepest = std::max(size_of_slope, curvature);
  const double h1 = steepest <= 1e-15 ? std::max(1e-6, 1e-3 * h0) : std::pow(0.01 / steepest, 0.2);
  return std::max(std::min(100.0 * h0, h1), 2.0 * smallest_step(time_));
}

void DormandPrince::step(double t_limit) {
  check_limit(t_limit);
  if (t_limit == time_) return;
  begin_step();
  const double remaining = t_limit - time_;
  if (step_ <= 0.0) step_ = starting_step(remaining);
  if (max_step_ > 0.0) step_ = std::min(step_, max_step_);
  for (bool cut_before = false;; cut_before = true) {
    // A step cut short by a hard stop may be as short as it likes; only the wish itself can collapse.
    if (step_ < smallest_step(time_)) {
      const bool finite = bad_component_ == IntegrationError::no_component;
      fail(step_, dominant_component(step_),
           finite ? "the step size has collapsed"
                  : "the step size has collapsed: the derivative is not finite");
    }
    const double h = limited_step(step_, remaining);
    const double t_end = h == remaining ? t_limit : time_ + h;
    if (!try_step(h, t_end)) {
      ++counters_.rejected_steps;
      step_ = blind_cut * h;
      continue;
    }
    const double e = error(h);
    if (e <= 1.0) {
      accept(t_end);
      after_success(h, e, cut_before, h < step_);
      return;
    }
    ++counters_.rejected_steps;
    // Not finite where components beyond the tolerances overflow: cut as hard as allowed.
    step_ = h * std::max(strongest_cut, std::isfinite(e) ? safety * std::pow(e, -alpha) : 0.0);
  }
}

void DormandPrince::after_success(double h, double error, bool cut_before, bool truncated) {
  double growth = strongest_growth;
  if (error > 0.0) {
    growth = std::clamp(safety * std::pow(error_memory_, beta) * std::pow(error, -alpha), strongest_cut,
                        strongest_growth);
  }
  if (cut_before) growth = std::min(growth, 1.0);
  // The error of a step cut short tells nothing of the wish when it only asks for the largest growth.
  if (truncated && growth == strongest_growth) {
    step_ = std::max(step_, growth * h);
    return;
  }
  step_ = growth * h;
  if (!truncated) error_memory_ = std::max(error, 1e-4);
}

void DormandPrince::interpolate(double t, double* y) const {
  t = inside_last_step(t);
  const std::size_t n = size();
  if (previous_time_ == time_) {
    std::copy_n(state_.data(), n, y);
    return;
  }
  const double h = time_ - previous_time_;
  const double s = (t - previous_time_) / h;
  const double r = 1.0 - s;
  for (std::size_t i = 0; i < n; ++i) {
    const double rise = end_state_[i] - previous_state_[i];
    const double bend = h * start_derivative_[i] - rise;
    const double twist = rise - h * end_derivative_[i] - bend;
    const double quartic = h * (d1 * start_derivative_[i] + d3 * k3_[i] + d4 * k4_[i] + d5 * k5_[i] +
                                d6 * k6_[i] + d7 * end_derivative_[i]);
    y[i] = previous_state_[i] + s * (rise + r * (bend + s * (twist + r * quartic)));
  }
}

}  // namespace

std::unique_ptr<Integrator> make_dopri5(System& system, ResidualSystem* /*residual*/,
                                        const IntegratorOptions& options) {
  return std::make_unique<DormandPrince>(system, options);
}

}  // namespace seacrane
