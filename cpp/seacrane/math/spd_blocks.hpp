#pragma once

#include <array>
#include <type_traits>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// A symmetric positive definite matrix of 6 x 6 blocks, factored as L D L^T in parts of 3 x 3, whose pivots
/// take one division each. Allocates at construction alone.
template <class T>
class SpdBlocks {
 public:
  explicit SpdBlocks(int count)
      : count_(count), parts_(2 * count), l_(idx(parts_ * parts_)), pivot_(idx(parts_)), inverse_(l_) {}

  int count() const { return count_; }
  /// A block on or below the diagonal, for the next factor(), which uses it up.
  void set(int i, int j, const Mat6<T>& block) {
    for (int c = 0; c < 6; ++c) {
      for (int r = 0; r < 6; ++r) l(2 * i + r / 3, 2 * j + c / 3)[idx(c % 3)][r % 3] = block(r, c);
    }
  }
  void factor() {
    if constexpr (std::is_same_v<T, double>) {
      factor_numbers();
    } else {
      factor_all();
    }
  }
  /// In place, by block.
  void solve(Vec6<T>* x) const {
    const auto part = [&](int i) { return x[i / 2].data() + i % 2 * 3; };
    for (int j = 0; j < parts_; ++j) {
      for (int i = j + 1; i < parts_; ++i) {
        const Column moved = times(l(i, j), part(j));
        for (int r = 0; r < 3; ++r) part(i)[r] -= moved[r];
      }
    }
    for (int j = parts_; j-- > 0;) {
      Column sum = times(pivot_[idx(j)], part(j));
      for (int i = j + 1; i < parts_; ++i) {
        for (int c = 0; c < 3; ++c) sum[c] -= dot(l(i, j)[idx(c)], part(i));
      }
      for (int r = 0; r < 3; ++r) part(j)[r] = sum[r];
    }
  }
  /// After factor(): solves for the columns of one.
  void invert() {
    for (int c = 0; c < parts_; ++c) {
      Part* const x = &inverse_[idx(c * parts_)];
      for (int i = c; i < parts_; ++i) x[i] = Part{};
      for (int k = 0; k < 3; ++k) x[c][idx(k)][k] = T(1);
      for (int j = c; j < parts_; ++j) {
        for (int i = j + 1; i < parts_; ++i) {
          for (int k = 0; k < 3; ++k) x[i][idx(k)] -= times(l(i, j), x[j][idx(k)]);
        }
      }
      for (int j = parts_; j-- > c;) {
        for (int k = 0; k < 3; ++k) {
          Column sum = times(pivot_[idx(j)], x[j][idx(k)]);
          for (int i = j + 1; i < parts_; ++i) {
            for (int r = 0; r < 3; ++r) sum[r] -= dot(l(i, j)[idx(r)], x[i][idx(k)]);
          }
          x[j][idx(k)] = sum;
        }
      }
    }
  }
  /// A block of the inverse on or below the diagonal, after invert().
  Mat6<T> inverse(int i, int j) const {
    Mat6<T> out;
    for (int c = 0; c < 6; ++c) {
      for (int r = 0; r < 6; ++r) {
        const int row = 2 * i + r / 3, column = 2 * j + c / 3;
        out(r, c) = row < column ? inverse_[idx(row * parts_ + column)][idx(r % 3)][c % 3]
                                 : inverse_[idx(column * parts_ + row)][idx(c % 3)][r % 3];
      }
    }
    return out;
  }

 private:
  /// Three numbers side by side, or as many packs.
  struct Packs {
    T row[3] = {T(0), T(0), T(0)};
    Packs() = default;
    Packs(const T& a, const T& b, const T& c) : row{a, b, c} {}
    T& operator[](int i) { return row[i]; }
    const T& operator[](int i) const { return row[i]; }
    friend Packs operator*(const Packs& a, const T& b) { return {a[0] * b, a[1] * b, a[2] * b}; }
    friend Packs operator+(const Packs& a, const Packs& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
    void operator-=(const Packs& b) {
      for (int i = 0; i < 3; ++i) row[i] -= b[i];
    }
  };
  /// As one vector of the processor.
  struct Numbers {
    typedef double Row __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double))));
    Row row{};
    Numbers() = default;
    Numbers(double a, double b, double c) : row{a, b, c, 0.0} {}
    explicit Numbers(const Row& r) : row(r) {}
    Numbers(const Numbers& other) : row(other.row) {}  // in one go
    Numbers& operator=(const Numbers& other) {
      row = other.row;
      return *this;
    }
    double& operator[](int i) { return reinterpret_cast<double*>(&row)[i]; }
    double operator[](int i) const { return row[i]; }
    friend Numbers operator*(const Numbers& a, double b) { return Numbers(a.row * b); }
    friend Numbers operator+(const Numbers& a, const Numbers& b) { return Numbers(a.row + b.row); }
    void operator-=(const Numbers& b) { row -= b.row; }
  };
  using Column = std::conditional_t<std::is_same_v<T, double>, Numbers, Packs>;
  using Part = std::array<Column, 3>;  // by columns

  template <class Vector>
  [[gnu::always_inline]] static Column times(const Part& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  template <class Vector>
  [[gnu::always_inline]] static T dot(const Column& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  /// By cofactors; reads the lower triangle alone.
  [[gnu::always_inline]] static void invert(const Part& a, Part& out) {
    const T xx = a[1][1] * a[2][2] - a[1][2] * a[1][2], yx = a[0][2] * a[1][2] - a[0][1] * a[2][2],
            zx = a[0][1] * a[1][2] - a[0][2] * a[1][1], yy = a[0][0] * a[2][2] - a[0][2] * a[0][2],
            zy = a[0][1] * a[0][2] - a[0][0] * a[1][2], zz = a[0][0] * a[1][1] - a[0][1] * a[0][1];
    const T over = T(1) / (a[0][0] * xx + a[0][1] * yx + a[0][2] * zx);
    out[0] = Column{xx, yx, zx} * over;
    out[1] = Column{yx, yy, zy} * over;
    out[2] = Column{zx, zy, zz} * over;
  }

  void factor_numbers();
  void factor_all() {
    for (int j = 0; j < parts_; ++j) {
      const Part& own = l(j, j);
      Part& pivot = pivot_[idx(j)];
      invert(own, pivot);
      for (int i = j + 1; i < parts_; ++i) {
        Part& row = l(i, j);
        const Column x = row[0], y = row[1], z = row[2];
        for (std::size_t c = 0; c < 3; ++c) row[c] = x * pivot[c][0] + y * pivot[c][1] + z * pivot[c][2];
        for (int k = j + 1; k <= i; ++k) {
          const Part& other = l(k, j);
          Part& to = l(i, k);
          for (int c = 0; c < 3; ++c) {
            to[idx(c)] -= x * other[0][c] + y * other[1][c] + z * other[2][c];
          }
        }
      }
    }
  }
  Part& l(int i, int j) { return l_[idx(j * parts_ + i)]; }
  const Part& l(int i, int j) const { return l_[idx(j * parts_ + i)]; }

  int count_, parts_;
  std::vector<Part> l_, pivot_, inverse_;  // of pivots their inverses
};

template <>
void SpdBlocks<double>::factor_numbers();

}  // namespace seacrane
