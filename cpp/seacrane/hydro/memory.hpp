#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
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
    for (const Block& block : blocks_) {
      if (block.alone && block.states <= tile) {
        in_tiles(block.states, [&]<int n>(int /*first*/) { evaluate_alone<n>(block, m, u, x, x_rate, mu); });
        x += block.states;
        x_rate += block.states;
        continue;
      }
      in_tiles(block.states, [&]<int rows>(int first) {
        const auto sum = next_rows<rows, T>(m, column, u, x);
        std::copy_n(sum.data(), rows, x_rate + first);
      });
      in_tiles(block.outputs, [&]<int rows>(int first) {
        const auto sum = next_rows<rows, T>(m, column, u, x);
        const int* const output = motions_.data() + block.first_output + first;
        for (int i = 0; i < rows; ++i) mu[output[i]] += sum[idx(i)];
      });
      x += block.states;
      x_rate += block.states;
    }
  }

 private:
  struct Block {
    int states, inputs, outputs;
    int first_input, first_output;  // in motions_
    bool alone;                     // one input, one output
  };

  static constexpr int tile = 6;  // rows summed side by side, at most
  /// Calls f.template operator()<count>(first) for rows in tiles.
  template <class F>
  static void in_tiles(int rows, F&& f) {
    int first = 0;
    for (; rows - first > tile; first += tile) f.template operator()<tile>(first);
    switch (rows - first) {
      case 0:
        return;
      case 1:
        return f.template operator()<1>(first);
      case 2:
        return f.template operator()<2>(first);
      case 3:
        return f.template operator()<3>(first);
      case 4:
        return f.template operator()<4>(first);
      case 5:
        return f.template operator()<5>(first);
      default:
        return f.template operator()<tile>(first);
    }
  }
  /// One motion to one load, of so few states that all is laid out at compile time: most blocks.
  template <int n, class T>
  void evaluate_alone(const Block& block, const double*& m, const T* u, const T* x, T* x_rate, T* mu) const {
    const T motion = u[motions_[idx(block.first_input)]];
    T load(0);
    T rate[n];
    for (int i = 0; i < n; ++i) rate[i] = T(0);
    for (int j = 0; j < n; ++j, m += n) {
      for (int i = 0; i < n; ++i) rate[i] += x[j] * T(m[i]);
    }
    for (int i = 0; i < n; ++i) rate[i] += motion * T(m[i]);
    m += n;
    for (int j = 0; j < n; ++j) load += x[j] * T(m[j]);
    load += motion * T(m[n]);
    m += n + 1;
    for (int i = 0; i < n; ++i) x_rate[i] = rate[i];
    mu[motions_[idx(block.first_output)]] += load;
  }

  void put_alone(const StateSpaceBlock& s);
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

  std::vector<Block> blocks_;
  std::vector<int> motions_;          // inputs, then outputs per block
  std::vector<double> coefficients_;  // (A B), then (C D) per block, in tiles of rows, by columns
  std::vector<int> columns_;  // per tile those of x that are not zero, and of u, each after their number
  int states_ = 0;
};

}  // namespace seacrane
