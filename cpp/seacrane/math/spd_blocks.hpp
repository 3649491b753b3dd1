#pragma once

#include <vector>

#include "seacrane/math/spd_inverse.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

/// A symmetric positive definite matrix of 6 x 6 blocks, factored as L D L^T block by block. Allocates at
/// construction alone.
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
      pivot_[idx(j)] = spd_inverse<6, T>(at(j, j));
      for (int i = j + 1; i < count_; ++i) {
        const Mat6<T> row = at(i, j);
        at(i, j).noalias() = row * pivot_[idx(j)];
        for (int k = j + 1; k <= i; ++k) at(i, k).noalias() -= row * at(k, j).transpose();
      }
    }
  }
  /// In place, by block.
  void solve(Vec6<T>* x) const {
    for (int j = 0; j < count_; ++j) {
      for (int i = j + 1; i < count_; ++i) x[i] -= l(i, j) * x[j];
    }
    for (int j = count_; j-- > 0;) {
      x[j] = pivot_[idx(j)] * x[j];
      for (int i = j + 1; i < count_; ++i) x[j] -= l(i, j).transpose() * x[i];
    }
  }
  /// L^-T D^-1 L^-1, after factor().
  void invert() {
    for (int j = 0; j < count_; ++j) {
      for (int i = j + 1; i < count_; ++i) {  // above the diagonal: (L^-1)^T
        Mat6<T> sum = -l(i, j);
        for (int k = j + 1; k < i; ++k) sum -= l(i, k) * at(j, k);
        at(j, i) = sum;
      }
    }
    for (int j = 0; j < count_; ++j) {
      for (int i = j; i < count_; ++i) {
        Mat6<T> sum = i == j ? pivot_[idx(i)] : Mat6<T>(pivot_[idx(i)] * at(j, i));
        for (int k = i + 1; k < count_; ++k) sum += at(i, k).transpose() * (pivot_[idx(k)] * at(j, k));
        inverse_[idx(i * count_ + j)] = sum;
      }
    }
  }
  /// A block of the inverse on or below the diagonal, after invert().
  const Mat6<T>& inverse(int i, int j) const { return inverse_[idx(i * count_ + j)]; }

 private:
  const Mat6<T>& l(int i, int j) const { return blocks_[idx(i * count_ + j)]; }

  int count_;
  std::vector<Mat6<T>> blocks_, inverse_;
  std::vector<Mat6<T>> pivot_;  // their inverses
};

}  // namespace seacrane
