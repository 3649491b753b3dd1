#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <type_traits>
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
    if constexpr (std::is_same_v<T, double>) {
      evaluate_numbers(u, x, x_rate, mu);
    } else {
      evaluate_all(u, x, x_rate, mu);
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

  void evaluate_numbers(const double* u, const double* x, double* x_rate, double* mu) const;
  template <class T>
  void evaluate_all(const T* u, const T* x, T* x_rate, T* mu) const {
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
      for (int i = 0; i < run.states; i += tile) {
        next_tile<T>(m, column, u, x).write(std::min(tile, run.states - i), x_rate + i);
      }
      for (int i = 0; i < run.outputs; i += tile) {
        const Tile<T> sum = next_tile<T>(m, column, u, x);
        const int* const output = outputs_.data() + run.first_output + i;
        for (int n = 0; n < std::min(tile, run.outputs - i); ++n) mu[output[n]] += sum[n];
      }
      x += run.states;
      x_rate += run.states;
    }
  }

  static constexpr int tile = 4;  // rows summed side by side
  /// As many numbers, or packs.
  template <class T>
  struct Tile {
    T row[tile] = {T(0), T(0), T(0), T(0)};
    void add(const T& factor, const double* m) {
      for (int i = 0; i < tile; ++i) row[i] += factor * T(m[i]);
    }
    void add(const Tile& other) {
      for (int i = 0; i < tile; ++i) row[i] += other.row[i];
    }
    void write(int count, T* to) const { std::copy_n(row, count, to); }
    T operator[](int i) const { return row[i]; }
  };

  static constexpr int most_alone = 6;  // states of a block that is laid out at compile time
  /// Calls f.template operator()<count>() for up to as many.
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
        return f.template operator()<most_alone>();
    }
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

  /// The next rows of a block times (x, u), without columns of zeros, every other one in a sum of its own,
  /// which does not wait for the last; moves on to what comes after them.
  template <class T>
  static Tile<T> next_tile(const double*& m, const int*& column, const T* u, const T* x) {
    Tile<T> sum, other;
    const auto add = [&](const T* of) {
      const int* const end = column + *column + 1;
      for (++column; end - column > 1; column += 2, m += 2 * tile) {
        sum.add(of[column[0]], m);
        other.add(of[column[1]], m + tile);
      }
      if (column == end) return;
      sum.add(of[*column++], m);
      m += tile;
    };
    add(x);
    add(u);
    sum.add(other);
    return sum;
  }

  std::vector<Run> runs_;
  std::vector<Alone> alone_;
  std::vector<double> alone_coefficients_;  // (A B; C D) per block, by columns
  std::vector<int> outputs_;
  std::vector<double> coefficients_;  // (A B), then (C D) per other block, in tiles of rows, by columns
  std::vector<int> columns_;  // per tile those of x that are not zero, and of u, each after their number
  int states_ = 0;
};

/// As one vector of the processor.
template <>
struct Memory::Tile<double> {
  typedef double Row __attribute__((vector_size(sizeof(double) * tile)));
  Row row{};
  void add(double factor, const double* m) {
    Row next;
    std::memcpy(&next, m, sizeof next);
    row += factor * next;
  }
  void add(const Tile& other) { row += other.row; }
  void write(int count, double* to) const {
    if (count == tile) {
      std::memcpy(to, &row, sizeof row);
    } else {
      for (int i = 0; i < count; ++i) to[i] = row[i];
    }
  }
  double operator[](int i) const { return row[i]; }
};

}  // namespace seacrane
