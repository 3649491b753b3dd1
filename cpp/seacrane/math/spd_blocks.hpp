#pragma once

#include <vector>

#include "seacrane/math/spd_inverse.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

/// A symmetric positive definite matrix of 6 x 6 blocks as L D L^T. Allocates at construction alone.
template <class T>
class SpdBlocks {
 public:
  explicit SpdBlocks(int count)
      : count_(count), blocks_(idx(count * count), Mat6<T>::Zero()), inverse_(blocks_), pivot_(idx(count)) {}

  int count() const { return count_; }
  /// A block on or below the diagonal, for the next factor(), which uses it up.
  Mat6<T>& at(int i, int j) { return blocks_[idx(i * count_ + j)]; }
  void factor() {
    for (int j = 0; j < count_; ++j) {
      pivot_[idx(j)] = SpdFactor<6, T>(at(j, j));
      for (int i = j + 1; i < count_; ++i) {
        const Mat6<T> scaled = divide(at(i, j), pivot_[idx(j)]);
        for (int k = j + 1; k < i; ++k) at(i, k).noalias() -= scaled * at(k, j).transpose();
        subtract_lower(scaled, at(i, j), at(i, i));
      }
    }
  }
  /// In place, by block.
  void solve(Vec6<T>* x) const {
    for (int j = 0; j < count_; ++j) {
      x[j] = pivot_[idx(j)].forward(x[j]);
      for (int i = j + 1; i < count_; ++i) x[i] -= l(i, j) * x[j];
    }
    for (int j = count_; j-- > 0;) {
      for (int n = 0; n < 6; ++n) x[j][n] *= pivot_[idx(j)].over_pivot[n];
      for (int i = j + 1; i < count_; ++i) x[j] -= l(i, j).transpose() * x[i];
      x[j] = pivot_[idx(j)].backward(x[j]);
    }
  }
  /// L^-T D^-1 L^-1, after factor().
  void invert() {
    for (int j = 0; j < count_; ++j) {
      for (int i = j; i < count_; ++i) {  // on and above the diagonal: (L^-1)^T
        Mat6<T> sum = i == j ? Mat6<T>(Mat6<T>::Identity()) : Mat6<T>(Mat6<T>::Zero());
        for (int k = j; k < i; ++k) sum -= l(i, k) * at(j, k);
        for (int n = 0; n < 6; ++n) at(j, i).col(n) = pivot_[idx(i)].forward(sum.col(n));
      }
    }
    for (int j = 0; j < count_; ++j) {
      for (int i = j; i < count_; ++i) {
        Mat6<T> sum = Mat6<T>::Zero();
        for (int k = i; k < count_; ++k) {
          const Eigen::Map<const Vec6<T>> over_pivot(pivot_[idx(k)].over_pivot);
          sum += at(i, k).transpose() * (over_pivot.asDiagonal() * at(j, k));
        }
        inverse_[idx(i * count_ + j)] = sum;
      }
    }
  }
  /// A block of the inverse on or below the diagonal, after invert().
  const Mat6<T>& inverse(int i, int j) const { return inverse_[idx(i * count_ + j)]; }

 private:
  const Mat6<T>& l(int i, int j) const { return blocks_[idx(i * count_ + j)]; }
  /// To a block A of L: A L^-T D^-1 with those of its pivot; returned is that times D.
  static Mat6<T> divide(Mat6<T>& block, const SpdFactor<6, T>& pivot) {
    Mat6<T> scaled = block;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
#pragma GCC unroll 6
      for (int k = 0; k < j; ++k) scaled.col(j) -= pivot.l(j, k) * scaled.col(k);
      block.col(j) = pivot.over_pivot[j] * scaled.col(j);
    }
    return scaled;
  }
  /// From `to` a b^T, which is symmetric: its lower triangle.
  static void subtract_lower(const Mat6<T>& a, const Mat6<T>& b, Mat6<T>& to) {
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k) {
#pragma GCC unroll 6
        for (int i = j; i < 6; ++i) to(i, j) -= a(i, k) * b(j, k);
      }
    }
  }

  int count_;
  std::vector<Mat6<T>> blocks_, inverse_;
  std::vector<SpdFactor<6, T>> pivot_;
};

}  // namespace seacrane
