#include "seacrane/run/guards.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "seacrane/dynamics/energy.hpp"
#include "seacrane/dynamics/non_finite.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/run/stepper.hpp"

namespace seacrane {
namespace {

/// Rates and states of the fluid this far beyond their scale (0.1 m/s, 0.01 rad/s) belong to no motion of a
/// body.
constexpr double kGrown = 1e5;
/// s ahead of a step size that has collapsed, times max(1, |t|).
constexpr double kAhead[] = {1e-12, 1e-9, 1e-6};
/// Energies cancel to this fraction of the largest of them.
constexpr double kEnergyRounding = 1e-12;
/// Steps of 1e-8 s on average: a second of the motion would take longer than anybody waits, and cylinders a
/// thousand times stiffer than a crane's between rods of grams ask for no shorter ones.
constexpr long kStallSteps = 100'000;
constexpr double kStallTime = 1e-3;  // s

/// What is not finite at the last good state or shortly after it, on the tangent there; empty: nothing.
std::string find_non_finite(double step, Stepper& at) {
  const Integrator& integrator = *at.integrator;
  const double t = integrator.time();
  const std::size_t n = at.stepped.size();
  std::vector<double> y(n), rate(n), described(at.system.size());
  at.stepped.derivative(t, integrator.state(), rate.data());
  if (!all_finite(rate.data(), n)) std::fill(rate.begin(), rate.end(), 0.0);
  std::vector<double> ahead = {0.0};
  if (std::isfinite(step)) ahead.insert(ahead.end(), {0.5 * std::abs(step), std::abs(step)});
  for (const double a : kAhead) ahead.push_back(a * std::max(1.0, std::abs(t)));
  for (const double a : ahead) {
    for (std::size_t i = 0; i < n; ++i) y[i] = integrator.state()[i] + a * rate[i];
    at.write_bodies(t + a, y.data(), described.data());
    const std::string found = name_non_finite(at.system, t + a, described.data());
    if (!found.empty()) return found + ", at t = " + to_text(t + a) + " s";
  }
  return "";
}

/// The rate or memory state that is largest over its scale, where no body moves like that; else empty.
std::string find_grown(Stepper& at) {
  const Model& m = *at.model;
  std::vector<double> described(at.system.size());
  at.write_bodies(at.integrator->time(), at.integrator->state(), described.data());
  int worst = -1;
  double largest = kGrown;
  for (int i = m.layout.velocity; i < m.layout.loads; ++i) {
    const double ratio = std::abs(described[idx(i)]) / m.scale[idx(i)];
    if (!(ratio > largest)) continue;
    largest = ratio;
    worst = i;
  }
  if (worst < 0) return "";
  return "the " + at.system.describe(idx(worst)) + " had grown to " + to_text(described[idx(worst)]) +
         " before, as no body moves: the step is too long for the method, or a load or the fluid memory "
         "feeds "
         "the motion; give a smaller dt or rtol, or mend that load";
}

/// As `find`, or nothing where the equations themselves cannot be evaluated.
template <class Find>
std::string attempt(Find&& find) {
  try {
    return find();
  } catch (const std::exception&) {
    return "";
  }
}

}  // namespace

void require_finite(const Integrator& integrator, const Formulation& stepped) {
  if (all_finite(integrator.state(), stepped.size())) return;
  throw IntegrationError(integrator.name(), integrator.time(), integrator.time() - integrator.previous_time(),
                         first_non_finite(integrator.state(), stepped.size()), "the state is not finite");
}

void explain(const IntegrationError& error, Stepper& at) {
  std::string text = error.reason();
  if (error.component() < at.stepped.size()) {
    text += ", worst in the " + at.stepped.describe(error.component());
  }
  const std::string bad = attempt([&] { return find_non_finite(error.step_size(), at); });
  if (!bad.empty()) text += "; not finite is the " + bad;
  const std::string grown = attempt([&] { return find_grown(at); });
  if (!grown.empty()) text += "; " + grown;
  throw IntegrationError(error.method(), error.time(), error.step_size(), error.component(), text);
}

void StallWatch::step(double t) {
  if (++steps_ < kStallSteps) return;
  if (t - from_ < kStallTime) {
    throw std::domain_error(
        "the run stands still: the last " + std::to_string(kStallSteps) +
        " steps took it from t = " + to_text(from_) + " s only to " + to_text(t) +
        " s. A load that switches where a motion stops chatters, or a part is far stiffer than all others; "
        "smooth the switch, soften the part or give a larger rtol");
  }
  steps_ = 0;
  from_ = t;
}

EnergyWatch::EnergyWatch(std::optional<double> limit) : limit_(limit) {
  if (!limit || (*limit > 0.0 && std::isfinite(*limit))) return;
  throw std::invalid_argument("energy_limit is " + to_text(*limit) +
                              "; give a positive number, such as 1e-3");
}

void EnergyWatch::check(double t, const double* y, const Terms& terms, double balance, double absolute_work,
                        double energy) {
  largest_kinetic_ = std::max(largest_kinetic_, kinetic_energy(terms, y));
  const double handled = absolute_work + largest_kinetic_;
  if (std::abs(balance) <= *limit_ * handled + kEnergyRounding * std::abs(energy)) return;
  throw std::domain_error(
      "energy_balance is " + to_text(balance) + " J at t = " + to_text(t) + " s, beyond " +
      "energy_limit = " + to_text(*limit_) + " times the " + to_text(handled) +
      " J of absolute work and kinetic energy so far: the integration is not accurate; give "
      "a smaller rtol or dt, or a larger energy_limit");
}

void RankWatch::keep(double t, const Dependence& found, const std::shared_ptr<const Model>& model,
                     const double* bodies) {
  if (found.gained_rank()) {
    worst_ = std::numeric_limits<double>::infinity();
    t = 0.0;
    bodies = model->initial_state.data();
  }
  worst_ = std::max(worst_, found.ratio);
  changed_ = changed_ || found.lost_rank() || found.gained_rank();
  redundant_ = std::min(found.redundant, std::max(found.left_out, 0));
  time_ = t;
  model_ = model;
  bodies_.assign(bodies, bodies + model->layout.size);
}

std::optional<RankReport> RankWatch::report() const {
  if (!model_ || model_->rows() == 0) return std::nullopt;
  RankReport out;
  MaximalSystem system(model_);
  const ConstraintRank rank = system.rank(time_, bodies_.data(), redundant_);
  out.time = time_;
  out.pivot = redundant_ > 0 ? std::pow(rank.smallest_singular_value, 2) : 1.0 / rank.condition;
  if (!std::isfinite(out.pivot)) return std::nullopt;  // redundant rows of a set too large to tell them
  out.singular_value = rank.smallest_singular_value;
  out.rank_changed = changed_;
  if (rank.weakest >= 0) out.element = model_->elements[idx(rank.weakest)].name;
  return out;
}

}  // namespace seacrane
