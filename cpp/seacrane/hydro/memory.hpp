#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// One state-space model of the fluid memory, eqs (29)-(30): x' = A x + B u, mu = C x + D u, where u
/// holds the motions `inputs` (0 surge ... 5 yaw, of a group six for each vessel in turn) and mu adds to the
/// loads `outputs`.
struct StateSpaceBlock {
  std::vector<int> inputs, outputs;
  MatXd a, b, c, d;
  VecXd state_scale;  // typical magnitude of each state, for tolerances
};

/// All memory blocks of a vessel or a group, flattened for the loop.
class Memory {
 public:
  Memory() = default;
  explicit Memory(const std::vector<StateSpaceBlock>& blocks, int motions = 6);

  int states() const { return states_; }

  /// Rates of the states under the motions u; adds to the loads mu.
  template <class T>
  void evaluate(const T* u, const T* x, T* x_rate, T* mu) const {
    const double* m = coefficients_.data();
    const int* column = columns_.data();
    const Alone* alone = alone_.data();
    const double* of_alone = alone_coefficients_.data();
    for (const Run& run : runs_) {
      if (run.alone) {
        with_count(run.states, [&]<int n>() {
          for (const Alone* const end = alone + run.blocks; alone != end; ++alone) {
            evaluate_alone<n>(u[alone->input], of_alone, x, x_rate, mu[alone->output]);
            of_alone += stride(n) * (n + 1);
            x += n;
            x_rate += n;
          }
        });
        continue;
      }
      in_tiles(run.states, [&]<int rows>(int first) {
        const auto sum = next_rows<rows, T>(m, column, u, x);
        std::copy_n(sum.data(), rows, x_rate + first);
      });
      in_tiles(run.outputs, [&]<int rows>(int first) {
        const auto sum = next_rows<rows, T>(m, column, u, x);
        const int* const output = outputs_.data() + run.first_output + first;
        for (int i = 0; i < rows; ++i) mu[output[i]] += sum[idx(i)];
      });
      x += run.states;
      x_rate += run.states;
    }
  }

 private:
  /// Blocks of one motion to one load that follow one another and have as many states; or one other block.
  struct Run {
    bool alone;
    int states, blocks;
    int outputs, first_output;  // of another block, in outputs_
  };
  struct Alone {
    int input, output;
  };

  static constexpr int tile = 6;  // rows summed side by side, at most
  /// Calls f.template operator()<count>() for up to `tile`.
  template <class F>
  static void with_count(int count, F&& f) {
    switch (count) {
      case 0:
        return f.template operator()<0>();
      case 1:
        return f.template operator()<1>();
      case 2:
        return f.template operator()<2>();
      case 3:
        return f.template operator()<3>();
      case 4:
        return f.template operator()<4>();
      case 5:
        return f.template operator()<5>();
      default:
        return f.template operator()<tile>();
    }
  }
  /// Calls f.template operator()<count>(first) for rows in tiles.
  template <class F>
  static void in_tiles(int rows, F&& f) {
    int first = 0;
    for (; rows - first > tile; first += tile) f.template operator()<tile>(first);
    with_count(rows - first, [&]<int count>() {
      if constexpr (count > 0) f.template operator()<count>(first);
    });
  }
  /// Of the rows of (A B; C D) for n states: an even number, so that two lie in one register.
  static constexpr int stride(int n) { return (n + 2) / 2 * 2; }
  static constexpr std::size_t kAlignment =
      std::min<std::size_t>(2 * sizeof(double), __STDCPP_DEFAULT_NEW_ALIGNMENT__);
  /// One motion to one load, of so few states that all is laid out at compile time: most blocks.
  template <int n, class T>
  [[gnu::always_inline]] static void evaluate_alone(const T& motion, const double* coefficients, const T* x,
                                                    T* x_rate, T& mu) {
    const double* const m = std::assume_aligned<kAlignment>(coefficients);
    const auto factor = [&](int j) -> const T& { return j < n ? x[j] : motion; };
    T sum[n + 1];
    for (int i = 0; i <= n; ++i) sum[i] = T(0);
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) sum[i] += factor(j) * T(m[j * stride(n) + i]);
    }
    for (int i = 0; i < n; ++i) x_rate[i] = sum[i];
    mu += sum[n];
  }

  void put_alone(const StateSpaceBlock& s, int states);
  void put_in_tiles(const MatXd& left, const MatXd& right, const std::vector<int>& inputs);

  /// The next rows of a block times (x, u), without columns of zeros; moves on to what comes after them.
  template <int rows, class T>
  std::array<T, idx(rows)> next_rows(const double*& m, const int*& column, const T* u, const T* x) const {
    return [&]<std::size_t... i>(std::index_sequence<i...>) {
      std::array<T, idx(rows)> sum = {(static_cast<void>(i), T(0))...};
      for (const T* const of : {x, u}) {
        for (const int* const end = column + *column + 1; ++column != end; m += rows) {
          ((sum[i] += of[*column] * T(m[i])), ...);
        }
      }
      return sum;
    }
    (std::make_index_sequence<static_cast<std::size_t>(rows)>{});
  }

  std::vector<Run> runs_;
  std::vector<Alone> alone_;
  std::vector<double> alone_coefficients_;  // (A B; C D) per block, by columns
  std::vector<int> outputs_;
  std::vector<double> coefficients_;  // (A B), then (C D) per other block, in tiles of rows, by columns
  std::vector<int> columns_;  // per tile those of x that are not zero, and of u, each after their number
  int states_ = 0;
};

}  // namespace seacrane
