#pragma once

#include <array>
#include <limits>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// Retardation functions K(tau) sampled at tau = 0, step, 2 step ...; cubic in between, zero beyond.
struct RetardationFunctions {
  double step = 0.0;  // s, also the interval at which the twist is sampled
  std::vector<Mat6d> kernel;
};

/// What a convolution keeps of a vessel's motion; at rest before `start`.
struct TwistHistory {
  double start = 0.0;             // s
  long intervals = 0;             // whole steps since then
  std::vector<Vec6d> recent;      // twist at the last three samples, newest first
  std::vector<Vec6d> quadrature;  // twist at the quadrature points of past steps, newest first
};

/// Fluid memory by direct convolution, mu_j(t) = sum_k int_0^T K_jk(tau) v_k(t - tau) dtau: tables made
/// once for all runs.
///
/// The twist is sampled every `step`. Each past step counts by its two Gauss points, where the cubic through
/// the sample at its end and the three before it stands for the twist; the present step, from the newest
/// sample to t, likewise with the twist at t as the newest node, so that mu is continuous at the samples. The
/// past's share is a smooth function of t over one step: a cubic through its values at four Lobatto points.
/// All errors are O(step^4).
class Convolution {
 public:
  static constexpr int kPoints = 2;  // Gauss points per step
  static constexpr int kTerms = 4;   // of cubics
  using Polynomial = Eigen::Matrix<double, 6, kTerms>;

  /// Throws std::invalid_argument.
  explicit Convolution(const RetardationFunctions& functions);

  double step() const { return step_; }
  /// Quadrature points kept of the past.
  Eigen::Index length() const { return length_; }
  std::size_t pairs() const { return pairs_.size(); }

  /// Adds the share of the past, in powers of (t - newest) / step. Column k of `past` (length, 6) holds
  /// motion k at the quadrature points, oldest first.
  void add_past(const Eigen::Ref<const MatXd>& past, Polynomial& out) const;

  /// Adds the share of the present step, sum_r K^(r) moments_r, with K = sum_r K^(r) (tau / step)^r there.
  void add_present(const std::array<Vec6d, kTerms>& moments, Vec6d& mu) const {
    for (const Pair& pair : pairs_) {
      for (std::size_t r = 0; r < kTerms; ++r) mu[pair.output] += pair.first[r] * moments[r][pair.input];
    }
  }

 private:
  struct Pair {
    int output, input;
    std::array<double, kTerms> first;  // K over the first step
  };

  double step_ = 0.0;
  Eigen::Index length_ = 0;
  std::vector<Pair> pairs_;
  /// A column per pair and quadrature point, oldest first: powers of the past's share.
  Eigen::Matrix<double, kTerms, Eigen::Dynamic> weights_;
};

/// The convolution of one run: the history of the twist and the past's share over the present step.
class RunningConvolution {
 public:
  explicit RunningConvolution(const Convolution& tables);

  /// At rest before t; `rate` is that of the twist's components just after.
  void start(double t, const Vec6d& twist, const Vec6d& rate);
  /// Goes on from a history at t. Throws std::invalid_argument.
  void restore(double t, const TwistHistory& history);
  TwistHistory save() const;

  /// Time of the next sample; mu may be asked for until then.
  double next() const;
  /// The sample at next().
  void sample(const Vec6d& twist);

  /// mu at t, where the twist is `twist`; before start() the vessel has never moved.
  Vec6d evaluate(double t, const Vec6d& twist) const;

 private:
  Vec6d interpolate(double s, double fraction, const Vec6d& twist) const;
  void keep(const Vec6d& twist);
  void expand_past();

  const Convolution* tables_;
  double start_ = 0.0, newest_ = std::numeric_limits<double>::infinity();
  long intervals_ = 0;
  std::array<Vec6d, 3> recent_;
  /// Ring of the quadrature points, stored twice so that any window of it is contiguous.
  MatXd ring_;
  Eigen::Index oldest_ = 0;
  Convolution::Polynomial past_;
};

}  // namespace seacrane
