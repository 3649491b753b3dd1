#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "seacrane/integrate/adaptive_step.hpp"
#include "seacrane/integrate/dense_lu.hpp"
#include "seacrane/integrate/linear_combination.hpp"
#include "seacrane/integrate/registration.hpp"
#include "seacrane/integrate/tableaus/dormand_prince54.hpp"
#include "seacrane/integrate/tableaus/dormand_prince54_implicit.hpp"

namespace seacrane {
namespace {

/// Accepted steps with one linearisation.
constexpr int steps_per_linearisation = 10;
/// A step is not lengthened by less: its factors would be lost for little.
constexpr double least_growth_dopri5 = 1.1;

/// The pair of Dormand and Prince, and for the stiff part of the system its implicit companion. With the
/// matrix A = out in of StiffPart at some state of the last steps,
///
///   Y_i = y + h sum_j<i a_ij (f_j - A d_j) + h sum_j<=i g_ij A d_j,   d_j = Y_j - y.
///
/// Only z_i = in d_i, as many numbers as the part has, is solved for:
///
///   (1 - h g_ii C) z_i = in e_i + C w_i,   d_i = e_i + out (w_i + h g_ii z_i),   C = in out,
///   e_i = h sum a_ij f_j,   w_i = h sum_j<i (g_ij - a_ij) z_j.
///
/// Where the system has no stiff part this is the pair itself. Dense output is that of the pair, written as
/// the cubic Hermite polynomial of the step and a bump of degree four; of stiff states that of their values
/// at the stages.
class Dopri5Stiff final : public AdaptiveStep {
 public:
  static constexpr IntegratorProperties properties{
      .name = "dopri5-stiff",
      .kind = "explicit pair (Dormand, Prince), its stiff directions implicit",
      .order = 5,
      .error_order = 4,
      .dense_order = 4,
      .purpose = "loads with stiff states of their own, such as oil; order 4 there, and `dopri5` elsewhere"};

  Dopri5Stiff(const Problem& problem, const IntegratorOptions& options);

  void init(double t0, const double* y0) override {
    AdaptiveStep::init(t0, y0);
    forget();
  }
  void reset(double t, const double* y) override {
    const bool back = t < time_;  // to take a step again: what was linearised belongs there
    AdaptiveStep::reset(t, y);
    tried_ = false;
    if (!back) forget();
  }
  void interpolate(double t, double* y) const override;

 private:
  using Explicit = tableaus::DormandPrince54;
  using Implicit = tableaus::DormandPrince54Implicit;
  static constexpr std::size_t last = Explicit::stages;  // the stage at the end of the step

  template <std::size_t row>
  struct Stage {
    static constexpr double at(std::size_t j) { return static_cast<double>(Explicit::a[row][j]); }
  };
  struct Error {
    static constexpr double at(std::size_t j) { return static_cast<double>(Explicit::error[j]); }
  };
  struct Bump {
    static constexpr double at(std::size_t j) { return static_cast<double>(Explicit::dense[j][3]); }
  };
  template <std::size_t row>
  static constexpr double node() {
    long double sum = 0.0L;
    for (std::size_t j = 0; j < row; ++j) sum += Explicit::a[row][j];
    return static_cast<double>(sum);
  }
  using Slopes = std::array<const double*, last + 1>;

  bool try_step(double h, double t_end) override;
  double error(double h) const override;
  std::size_t dominant_component(double h) const override;
  double preferred_step(double h, double wish) const override {
    return rank_ > 0 && wish >= h && wish < least_growth_dopri5 * h ? h : wish;
  }
  std::size_t history_size() const override { return rank_ > 0 ? 2 + 2 * rank_ * size() : 0; }
  void save_history(std::span<double> history) const override;
  void load_history(std::span<const double> history) override;

  void forget() {
    age_ = steps_per_linearisation;
    factored_step_ = 0.0;
  }
  bool prepare(double h);
  void couple();
  bool factor(double h);
  Slopes slopes() const;
  template <std::size_t row>
  bool take_stage(double h, double t_end, const Slopes& k);
  template <std::size_t... row>
  bool take_stages(double h, double t_end, const Slopes& k, std::index_sequence<row...>) {
    return (... && take_stage<row + 1>(h, t_end, k));
  }
  void correct(std::size_t row, double h, double* y);
  void read(const double* change, double* z) const;
  template <class Weights>
  void filtered_sum(double h, std::vector<double>& sum) const;
  void add_out(const double* z, double* y) const;

  StiffPart* const part_;
  const std::size_t rank_;
  std::vector<double> stage_state_, inner_;
  std::vector<double> in_, out_, coupling_;  // by numbers; C by columns
  std::vector<double> z_;                    // by stages
  std::vector<double> change_, weight_;      // scratch
  // Const to the caller: the error, and the bump of dense output, made on the first look into a step.
  mutable std::vector<double> estimate_, bump_, filtered_;
  mutable bool bump_known_ = false;
  std::vector<std::size_t> own_;      // by numbers: the component that it is, or size()
  std::vector<std::size_t> touched_;  // components that the numbers depend on, or act on
  std::array<std::unique_ptr<DenseLu>, last + 1> lu_;
  int age_ = steps_per_linearisation;
  double factored_step_ = 0.0;
  /// Start of the last try: a second one from the same state has been rejected.
  double tried_time_ = 0.0;
  bool tried_ = false;
};

Dopri5Stiff::Dopri5Stiff(const Problem& problem, const IntegratorOptions& options)
    : AdaptiveStep(properties, problem, options, properties.error_order + 1),
      part_(problem.stiff),
      rank_(part_ ? part_->rank() : 0),
      stage_state_(size()),
      inner_((last - 1) * size()),
      in_(rank_ * size()),
      out_(rank_ * size()),
      coupling_(rank_ * rank_),
      z_((last + 1) * rank_),
      change_(size()),
      weight_(rank_),
      estimate_(size()),
      bump_(size()),
      filtered_(rank_) {
  if (rank_ == 0) return;
  own_.assign(rank_, size());
  touched_.reserve(size());
  for (std::size_t row = 1; row <= last; ++row) lu_[row] = std::make_unique<DenseLu>(rank_);
}

/// A linearisation that is young enough, and factors for the step.
bool Dopri5Stiff::prepare(double h) {
  const bool again = tried_ && tried_time_ == time_;
  tried_ = true;
  tried_time_ = time_;
  if (!again) ++age_;
  if (age_ > steps_per_linearisation || (again && age_ > 0)) {
    ++counters_.jacobians;
    ++counters_.evaluations;
    forget();  // an exception on the way leaves none
    part_->linearise(time_, state_.data(), in_.data(), out_.data());
    if (!all_finite(in_.data(), in_.size()) || !all_finite(out_.data(), out_.size())) return false;
    couple();
    age_ = 0;
  }
  return h == factored_step_ || factor(h);
}

void Dopri5Stiff::couple() {
  touched_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    bool any = false;
    for (std::size_t j = 0; j < rank_; ++j) any |= in_[j * size() + i] != 0.0 || out_[j * size() + i] != 0.0;
    if (any) touched_.push_back(i);
  }
  for (std::size_t j = 0; j < rank_; ++j) {
    read(out_.data() + j * size(), coupling_.data() + j * rank_);
    const double* const in = in_.data() + j * size();
    const auto entries = std::count_if(in, in + size(), [](double value) { return value != 0.0; });
    const double* const one = std::find(in, in + size(), 1.0);
    own_[j] = entries == 1 ? static_cast<std::size_t>(one - in) : size();
  }
}

bool Dopri5Stiff::factor(double h) {
  factored_step_ = 0.0;
  for (std::size_t row = 1; row <= last; ++row) {
    const double scale = -h * Implicit::a[row][row];
    for (std::size_t j = 0; j < rank_; ++j) {
      double* const column = lu_[row]->column(j);
      for (std::size_t i = 0; i < rank_; ++i) column[i] = scale * coupling_[j * rank_ + i];
      column[j] += 1.0;
    }
    if (!lu_[row]->factor()) return false;
  }
  factored_step_ = h;
  return true;
}

/// z = in change.
void Dopri5Stiff::read(const double* change, double* z) const {
  for (std::size_t j = 0; j < rank_; ++j) {
    const double* const in = in_.data() + j * size();
    double sum = 0.0;
    for (const std::size_t i : touched_) sum += in[i] * change[i];
    z[j] = sum;
  }
}

/// y += out z.
void Dopri5Stiff::add_out(const double* z, double* y) const {
  for (std::size_t j = 0; j < rank_; ++j) {
    const double* const out = out_.data() + j * size();
    for (const std::size_t i : touched_) y[i] += z[j] * out[i];
  }
}

/// What the implicit part changes of a stage that the explicit pair has made.
void Dopri5Stiff::correct(std::size_t row, double h, double* y) {
  for (const std::size_t i : touched_) change_[i] = y[i] - state_[i];
  double* const z = z_.data() + row * rank_;
  read(change_.data(), z);
  std::fill(weight_.begin(), weight_.end(), 0.0);
  for (std::size_t j = 1; j < row; ++j) {
    const double w = h * (Implicit::a[row][j] - static_cast<double>(Explicit::a[row][j]));
    for (std::size_t i = 0; i < rank_; ++i) weight_[i] += w * z_[j * rank_ + i];
  }
  for (std::size_t j = 0; j < rank_; ++j) {
    for (std::size_t i = 0; i < rank_; ++i) z[i] += coupling_[j * rank_ + i] * weight_[j];
  }
  lu_[row]->solve(z);
  for (std::size_t i = 0; i < rank_; ++i) weight_[i] += h * Implicit::a[row][row] * z[i];
  add_out(weight_.data(), y);
}

Dopri5Stiff::Slopes Dopri5Stiff::slopes() const {
  Slopes k;
  k[0] = start_derivative_.data();
  for (std::size_t j = 1; j < last; ++j) k[j] = inner_.data() + (j - 1) * size();
  k[last] = end_derivative_.data();
  return k;
}

template <std::size_t row>
bool Dopri5Stiff::take_stage(double h, double t_end, const Slopes& k) {
  double* const y = row == last ? end_state_.data() : stage_state_.data();
  LinearCombination<Stage<row>, row>::add(size(), state_.data(), h, k, y);
  if (rank_ > 0) correct(row, h, y);
  if (row == last && !end_is_finite()) return false;
  const double t = node<row>() == 1.0 ? t_end : time_ + node<row>() * h;
  return stage(t, y, row == last ? end_derivative_.data() : inner_.data() + (row - 1) * size());
}

bool Dopri5Stiff::try_step(double h, double t_end) {
  bump_known_ = false;
  if (rank_ > 0 && !prepare(h)) return false;
  end_derivative_known_ = true;
  return take_stages(h, t_end, slopes(), std::make_index_sequence<last>());
}

/// h times a sum of the stages' slopes; what it says of the stiff part is taken through the factors of the
/// end.
template <class Weights>
void Dopri5Stiff::filtered_sum(double h, std::vector<double>& sum) const {
  const Slopes k = slopes();
  for (std::size_t i = 0; i < size(); ++i) sum[i] = h * LinearCombination<Weights, last + 1>::slope(k, i);
  if (rank_ == 0) return;
  read(sum.data(), filtered_.data());
  lu_[last]->solve(filtered_.data());
  for (double& z : filtered_) z *= h * Implicit::a[last][last];
  add_out(filtered_.data(), sum.data());
}

double Dopri5Stiff::error(double h) const {
  filtered_sum<Error>(h, estimate_);
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double ratio =
        estimate_[i] / norm_.tolerance(i, std::max(std::abs(state_[i]), std::abs(end_state_[i])));
    sum += ratio * ratio;
  }
  return std::sqrt(sum * norm_.inverse_count());
}

std::size_t Dopri5Stiff::dominant_component(double) const {
  const auto ratio = [&](std::size_t i) {
    return std::abs(estimate_[i]) / norm_.tolerance(i, std::abs(state_[i]));
  };
  std::size_t worst = 0;
  for (std::size_t i = 1; i < size(); ++i) {
    if (ratio(i) > ratio(worst)) worst = i;
  }
  return worst;
}

void Dopri5Stiff::interpolate(double t, double* y) const {
  t = inside_last_step(t);
  if (previous_time_ == time_) {
    std::copy_n(state_.data(), size(), y);
    return;
  }
  const double h = time_ - previous_time_;
  const double s = (t - previous_time_) / h, rise = s * s * (1.0 - s) * (1.0 - s);
  if (!bump_known_) filtered_sum<Bump>(h, bump_);
  bump_known_ = true;
  for (std::size_t i = 0; i < size(); ++i) {
    y[i] = rise * bump_[i] + cubic_hermite(previous_state_[i], end_state_[i], h * start_derivative_[i],
                                           h * end_derivative_[i], s);
  }
  // Slopes of what is fast tell little of the step: its values at the stages do.
  const double at[3] = {s * (s - 0.8) * (s - 1.0) / 0.105, s * (s - 0.3) * (1.0 - s) / 0.08,
                        s * (s - 0.3) * (s - 0.8) / 0.14};
  for (std::size_t j = 0; j < rank_; ++j) {
    if (own_[j] == size()) continue;
    y[own_[j]] = previous_state_[own_[j]] + at[0] * z_[2 * rank_ + j] + at[1] * z_[3 * rank_ + j] +
                 at[2] * z_[last * rank_ + j];
  }
}

void Dopri5Stiff::save_history(std::span<double> history) const {
  if (history.empty()) return;
  history[0] = age_;
  history[1] = factored_step_;
  std::copy(in_.begin(), in_.end(), history.begin() + 2);
  std::copy(out_.begin(), out_.end(), history.begin() + 2 + std::ssize(in_));
}

void Dopri5Stiff::load_history(std::span<const double> history) {
  tried_ = false;
  if (history.empty()) return;
  age_ = static_cast<int>(history[0]);
  std::copy_n(history.begin() + 2, in_.size(), in_.begin());
  std::copy_n(history.begin() + 2 + std::ssize(in_), out_.size(), out_.begin());
  couple();
  factored_step_ = 0.0;
  if (history[1] > 0.0) factor(history[1]);
}

}  // namespace

extern const Registration dopri5_stiff = registration<Dopri5Stiff>();

}  // namespace seacrane
