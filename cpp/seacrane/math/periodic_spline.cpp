#include "seacrane/math/periodic_spline.hpp"

#include <utility>

#include "seacrane/math/dense.hpp"

namespace seacrane {

PeriodicKnots::PeriodicKnots(std::vector<double> angles) : angles_(std::move(angles)) {
  for (std::size_t i = 0; i + 1 < angles_.size(); ++i) gaps_.push_back(angles_[i + 1] - angles_[i]);
  gaps_.push_back(angles_.front() + turn - angles_.back());
}

MatXd PeriodicKnots::curvature() const {
  const auto n = static_cast<Eigen::Index>(angles_.size());
  MatXd left = MatXd::Zero(n, n), right = MatXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index before = (i + n - 1) % n, after = (i + 1) % n;
    const double h0 = gaps_[static_cast<std::size_t>(before)], h1 = gaps_[static_cast<std::size_t>(i)];
    left(i, i) += 2.0 * (h0 + h1);
    left(i, before) += h0;
    left(i, after) += h1;
    right(i, i) -= 6.0 / h0 + 6.0 / h1;
    right(i, before) += 6.0 / h0;
    right(i, after) += 6.0 / h1;
  }
  return left.partialPivLu().solve(right);
}

}  // namespace seacrane
