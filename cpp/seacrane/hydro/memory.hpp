#pragma once

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
    for (const Block& block : blocks_) {
      const double* m = coefficients_.data() + block.coefficients;
      for (int i = 0; i < block.states; ++i) {
        T sum = T(0);
        for (int j = 0; j < block.states; ++j) sum += *m++ * x[j];
        for (int j = 0; j < block.inputs; ++j) sum += *m++ * u[block.input[j]];
        x_rate[i] = sum;
      }
      for (int i = 0; i < block.outputs; ++i) {
        T sum = T(0);
        for (int j = 0; j < block.states; ++j) sum += *m++ * x[j];
        for (int j = 0; j < block.inputs; ++j) sum += *m++ * u[block.input[j]];
        mu[block.output[i]] += sum;
      }
      x += block.states;
      x_rate += block.states;
    }
  }

 private:
  struct Block {
    int states, inputs, outputs;
    int input[6], output[6];
    std::size_t coefficients;  // rows (A | B), then rows (C | D)
  };
  std::vector<Block> blocks_;
  std::vector<double> coefficients_;
  int states_ = 0;
};

}  // namespace seacrane
