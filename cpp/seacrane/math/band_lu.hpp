#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// LU factors, with partial pivoting, of a square matrix that is zero more than `band` places off its
/// diagonal; exchanges of rows fill as many places more above it (G. H. Golub, C. F. Van Loan, Matrix
/// Computations, 2013, sec. 4.3.3). Allocates when it is made.
class BandLu {
 public:
  BandLu() = default;
  BandLu(Eigen::Index size, Eigen::Index band)
      : band_(band), matrix_(MatXd::Identity(size, size)), pivot_(static_cast<std::size_t>(size)) {}

  /// To be written within the band, as a whole or after clear(); until factor(), which overwrites it.
  MatXd& matrix() { return matrix_; }
  /// Zeros where factor() writes.
  void clear() {
    for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
      const Eigen::Index first = std::max<Eigen::Index>(0, j - 2 * band_);
      matrix_.col(j).segment(first, below(j) + 1 - first).setZero();
    }
  }

  void factor() {
    MatXd& a = matrix_;
    for (Eigen::Index k = 0; k < a.rows(); ++k) {
      const Eigen::Index last = below(k), end = above(k);
      double* const by = a.col(k).data();
      Eigen::Index row = k;
      for (Eigen::Index i = k + 1; i <= last; ++i) {
        if (std::abs(by[i]) > std::abs(by[row])) row = i;
      }
      pivot_[static_cast<std::size_t>(k)] = row;
      for (Eigen::Index j = k; row != k && j <= end; ++j) std::swap(a(k, j), a(row, j));
      for (Eigen::Index i = k + 1; i <= last; ++i) by[i] /= by[k];
      for (Eigen::Index j = k + 1; j <= end; ++j) {
        double* const to = a.col(j).data();
        for (Eigen::Index i = k + 1; i <= last; ++i) to[i] -= by[i] * to[k];
      }
    }
  }

  /// In place of a right-hand side its solution.
  void solve(VecXd& x) const {
    const MatXd& a = matrix_;
    for (Eigen::Index k = 0; k < a.rows(); ++k) {
      std::swap(x[k], x[pivot_[static_cast<std::size_t>(k)]]);
      for (Eigen::Index i = k + 1; i <= below(k); ++i) x[i] -= a(i, k) * x[k];
    }
    for (Eigen::Index k = a.rows(); k-- > 0;) {
      x[k] /= a(k, k);
      for (Eigen::Index i = std::max<Eigen::Index>(0, k - 2 * band_); i < k; ++i) x[i] -= a(i, k) * x[k];
    }
  }

 private:
  Eigen::Index below(Eigen::Index k) const { return std::min(k + band_, matrix_.rows() - 1); }
  Eigen::Index above(Eigen::Index k) const { return std::min(k + 2 * band_, matrix_.rows() - 1); }

  Eigen::Index band_ = 0;
  MatXd matrix_;
  std::vector<Eigen::Index> pivot_;
};

}  // namespace seacrane
