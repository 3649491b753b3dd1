#include "seacrane/hydro/convolution.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace seacrane {
namespace {

constexpr int kTerms = Convolution::kTerms;
constexpr std::size_t kFewest = 8, kMost = 20000;  // samples of K

/// Gauss points of a step, as fractions of it.
constexpr std::array<double, Convolution::kPoints> kGauss = {0.5 - std::numbers::inv_sqrt3 / 2.0,
                                                             0.5 + std::numbers::inv_sqrt3 / 2.0};

using Cubic = std::array<double, kTerms>;

double value(const Cubic& c, double x) { return c[0] + x * (c[1] + x * (c[2] + x * c[3])); }

void check(const RetardationFunctions& f) {
  const auto fail = [](const std::string& what) {
    throw std::invalid_argument("retardation functions: " + what);
  };
  if (!(f.step > 0.0) || !std::isfinite(f.step)) {
    fail("step is " + std::to_string(f.step) + " s; make it positive and finite");
  }
  if (f.kernel.size() < kFewest || f.kernel.size() > kMost) {
    fail("the kernel has " + std::to_string(f.kernel.size()) + " samples; give " + std::to_string(kFewest) +
         " to " + std::to_string(kMost));
  }
  for (const Mat6d& k : f.kernel) {
    if (!k.allFinite()) fail("the kernel holds a value that is not finite");
  }
}

/// Lobatto points of a step, as fractions of it.
Eigen::Vector4d lobatto() {
  const double inner = 0.5 / std::sqrt(5.0);
  return {0.0, 0.5 - inner, 0.5 + inner, 1.0};
}

/// Takes the values of a cubic at four points to its coefficients.
Eigen::Matrix4d coefficients_from(const Eigen::Vector4d& x) {
  Eigen::Matrix4d powers;
  powers << Eigen::Vector4d::Ones(), x, x.cwiseAbs2(), x.cwiseProduct(x.cwiseAbs2());
  return powers.inverse();
}

/// One entry of K in powers of the fraction of each step: the cubic through the four nearest samples.
std::vector<Cubic> cubics(const RetardationFunctions& f, int output, int input) {
  const std::size_t samples = f.kernel.size();
  std::vector<Cubic> out(samples - 1);
  for (std::size_t i = 0; i + 1 < samples; ++i) {
    const std::size_t first = std::min(i == 0 ? 0 : i - 1, samples - 4);
    Eigen::Vector4d x, values;
    for (int node = 0; node < 4; ++node) {
      x[node] = static_cast<double>(first) + node - static_cast<double>(i);
      values[node] = f.kernel[first + idx(node)](output, input);
    }
    const Eigen::Vector4d c = coefficients_from(x) * values;
    std::copy_n(c.data(), 4, out[i].data());
  }
  return out;
}

}  // namespace

Convolution::Convolution(const RetardationFunctions& functions) : step_(functions.step) {
  check(functions);
  const auto cells = static_cast<Eigen::Index>(functions.kernel.size()) - 1;
  length_ = kPoints * cells;
  for (int j = 0; j < 6; ++j) {
    for (int k = 0; k < 6; ++k) {
      const auto present = [&](const Mat6d& sample) { return sample(j, k) != 0.0; };
      if (std::any_of(functions.kernel.begin(), functions.kernel.end(), present)) {
        pairs_.push_back({j, k, cubics(functions, j, k).front()});
      }
    }
  }
  weights_.resize(kTerms, length_ * static_cast<Eigen::Index>(pairs_.size()));
  const Eigen::Vector4d points = lobatto();
  const Eigen::Matrix4d to_powers = coefficients_from(points);
  Eigen::Index column = 0;
  for (const Pair& pair : pairs_) {
    const std::vector<Cubic> k = cubics(functions, pair.output, pair.input);
    for (Eigen::Index steps_ago = cells; steps_ago > 0; --steps_ago) {
      for (const double fraction : kGauss) {
        Eigen::Vector4d at;
        for (int i = 0; i < kTerms; ++i) {
          const double tau = static_cast<double>(steps_ago) - fraction + points[i];
          const auto cell = static_cast<std::size_t>(tau);
          at[i] = cell < k.size() ? value(k[cell], tau - std::floor(tau)) : 0.0;
        }
        weights_.col(column++) = step_ / kPoints * (to_powers * at);
      }
    }
  }
}

void Convolution::add_past(const Eigen::Ref<const MatXd>& past, Polynomial& out) const {
  Eigen::Index column = 0;
  for (const Pair& pair : pairs_) {
    const Eigen::Vector4d sum = weights_.middleCols(column, length_) * past.col(pair.input);
    out.row(pair.output) += sum.transpose();
    column += length_;
  }
}

RunningConvolution::RunningConvolution(const Convolution& tables)
    : tables_(&tables), ring_(MatXd::Zero(2 * tables.length(), 6)) {
  recent_.fill(Vec6d::Zero());
  past_.setZero();
}

void RunningConvolution::start(double t, const Vec6d& twist, const Vec6d& rate) {
  start_ = newest_ = t;
  intervals_ = 0;
  recent_ = {twist, tables_->step() * rate, Vec6d::Zero()};
  ring_.setZero();
  oldest_ = 0;
  past_.setZero();
}

void RunningConvolution::restore(double t, const TwistHistory& history) {
  const auto length = static_cast<std::size_t>(tables_->length());
  if (history.recent.size() != recent_.size() || history.quadrature.size() != length) {
    throw std::invalid_argument("state: its history holds " + std::to_string(history.quadrature.size()) +
                                " points of the past, the model's convolution needs " +
                                std::to_string(length) + "; give a state of this scene");
  }
  const auto finite = [](const Vec6d& v) { return v.allFinite(); };
  if (!std::isfinite(history.start) || history.intervals < 0 ||
      !std::all_of(history.recent.begin(), history.recent.end(), finite) ||
      !std::all_of(history.quadrature.begin(), history.quadrature.end(), finite)) {
    throw std::invalid_argument("state: its history holds a value that is not finite or negative intervals");
  }
  start_ = history.start;
  intervals_ = history.intervals;
  newest_ = start_ + static_cast<double>(intervals_) * tables_->step();
  if (!(t >= newest_ && t < next())) {
    throw std::invalid_argument("state: at t = " + std::to_string(t) + " s its history ends at " +
                                std::to_string(newest_) +
                                " s, not within one step before; give the state as a run left it");
  }
  std::copy(history.recent.begin(), history.recent.end(), recent_.begin());
  // The place in the ring where a run that was not interrupted would be: sums are then rounded alike.
  oldest_ = (intervals_ % tables_->length()) * Convolution::kPoints % tables_->length();
  for (auto v = history.quadrature.rbegin(); v != history.quadrature.rend(); ++v) keep(*v);
  expand_past();
}

TwistHistory RunningConvolution::save() const {
  TwistHistory out{start_, intervals_, {recent_.begin(), recent_.end()}, {}};
  for (Eigen::Index i = tables_->length(); i-- > 0;) out.quadrature.push_back(ring_.row(oldest_ + i));
  return out;
}

double RunningConvolution::next() const {
  return start_ + static_cast<double>(intervals_ + 1) * tables_->step();
}

void RunningConvolution::sample(const Vec6d& twist) {
  for (const double fraction : kGauss) keep(interpolate(1.0, fraction, twist));
  recent_ = {twist, recent_[0], intervals_ == 0 ? Vec6d(Vec6d::Zero()) : recent_[1]};
  ++intervals_;
  newest_ = start_ + static_cast<double>(intervals_) * tables_->step();
  expand_past();
}

Vec6d RunningConvolution::evaluate(double t, const Vec6d& twist) const {
  const double s = std::clamp((t - newest_) / tables_->step(), 0.0, 1.0);
  Vec6d mu = past_.col(0) + s * (past_.col(1) + s * (past_.col(2) + s * past_.col(3)));
  std::array<Vec6d, kTerms> moments;
  moments.fill(Vec6d::Zero());
  for (const double fraction : kGauss) {
    const double age = s * (1.0 - fraction);
    Vec6d term = tables_->step() * s / Convolution::kPoints * interpolate(s, fraction, twist);
    for (Vec6d& moment : moments) {
      moment += term;
      term *= age;
    }
  }
  tables_->add_present(moments, mu);
  return mu;
}

/// Twist at the fraction of the present step, of length s (in steps) so far, by the polynomial through the
/// twist now and the samples. Nothing before the start is used, where the rate may jump: in the first step
/// recent_[1] holds the rate there (times the step), in the second there are two samples.
Vec6d RunningConvolution::interpolate(double s, double fraction, const Vec6d& twist) const {
  const double x = fraction * s, rest = 1.0 - fraction;
  if (intervals_ == 0) {
    return fraction * fraction * twist + (1.0 - fraction * fraction) * recent_[0] + rest * x * recent_[1];
  }
  if (intervals_ == 1) {
    return fraction * (x + 1.0) / (s + 1.0) * twist + rest * (x + 1.0) * recent_[0] +
           (x - s) * x / (s + 1.0) * recent_[1];
  }
  return fraction * (x + 1.0) * (x + 2.0) / ((s + 1.0) * (s + 2.0)) * twist +
         0.5 * rest * (x + 1.0) * (x + 2.0) * recent_[0] + (x - s) * x * (x + 2.0) / (s + 1.0) * recent_[1] -
         0.5 * (x - s) * x * (x + 1.0) / (s + 2.0) * recent_[2];
}

void RunningConvolution::keep(const Vec6d& twist) {
  ring_.row(oldest_) = twist;
  ring_.row(oldest_ + tables_->length()) = twist;
  oldest_ = (oldest_ + 1) % tables_->length();
}

void RunningConvolution::expand_past() {
  past_.setZero();
  tables_->add_past(ring_.middleRows(oldest_, tables_->length()), past_);
}

}  // namespace seacrane
