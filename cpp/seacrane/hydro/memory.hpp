#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// One state-space model of the fluid memory, eqs (29)-(30): x' = A x + B u, mu = C x + D u, where u
/// holds the motions `inputs` (0 surge ... 5 yaw) of the twist and mu adds to the loads `outputs`.
struct StateSpaceBlock {
  std::vector<int> inputs, outputs;
  MatXd a, b, c, d;
  VecXd state_scale;  // typical magnitude of each state, for tolerances
};

/// All memory blocks of a vessel, flattened for the loop.
class Memory {
 public:
  Memory() = default;
  explicit Memory(const std::vector<StateSpaceBlock>& blocks);

  int states() const { return states_; }

  template <class T>
  void evaluate(const Vec6<T>& u, const T* x, T* x_rate, Vec6<T>& mu) const {
    const double* m = coefficients_.data();
    for (const Block& block : blocks_) {
      const int rows = block.states + block.outputs;
      for (int first = 0; first < rows; first += tile) {
        switch (height(rows - first)) {
          case 2:
            m = add_tile<2, T>(block, m, first, u, x, x_rate, mu);
            break;
          case 4:
            m = add_tile<4, T>(block, m, first, u, x, x_rate, mu);
            break;
          default:
            m = add_tile<tile, T>(block, m, first, u, x, x_rate, mu);
        }
      }
      x += block.states;
      x_rate += block.states;
    }
  }

 private:
  static constexpr int tile = 6;  // rows summed side by side, at most
  /// Of the tile that takes the next of so many rows: pairs of them.
  static constexpr int height(int rows) { return rows > 4 ? tile : (rows > 2 ? 4 : 2); }
  struct Block {
    int states, inputs, outputs;
    int input[6], output[6];
  };

  /// Rows `first` ... of a block; returns the coefficients of the tile after it.
  template <int rows, class T>
  static const double* add_tile(const Block& block, const double* m, int first, const Vec6<T>& u, const T* x,
                                T* x_rate, Vec6<T>& mu) {
    using Column = Eigen::Matrix<T, rows, 1>;
    Column sum = Column::Zero();
    for (int j = 0; j < block.states; ++j, m += rows) sum += x[j] * view<rows>(m).template cast<T>();
    for (int j = 0; j < block.inputs; ++j, m += rows) {
      sum += u[block.input[j]] * view<rows>(m).template cast<T>();
    }
    const int here = std::min(rows, block.states + block.outputs - first),
              to_states = std::clamp(block.states - first, 0, here);
    for (int i = 0; i < to_states; ++i) x_rate[first + i] = sum[i];
    for (int i = to_states; i < here; ++i) mu[block.output[first + i - block.states]] += sum[i];
    return m;
  }

  std::vector<Block> blocks_;
  std::vector<double> coefficients_;  // (A B; C D) per block, in tiles of rows, by columns, padded with zeros
  int states_ = 0;
};

}  // namespace seacrane
