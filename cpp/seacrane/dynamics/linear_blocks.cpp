#include "seacrane/dynamics/jacobian.hpp"
#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {
namespace {

/// End of the diagonal block of `a` that starts at `first`.
int end_of_block(const MatXd& a, int first) {
  int end = first + 1;
  for (int i = first; i < end; ++i) {
    for (int j = static_cast<int>(a.rows()) - 1; j >= end; --j) {
      if (a(i, j) != 0.0 || a(j, i) != 0.0) end = j + 1;
    }
  }
  return end;
}

}  // namespace

std::vector<LinearBlock> RedundantSystem::linear_blocks() const {
  std::vector<LinearBlock> out;
  const std::vector<MemoryMatrices> memory = memory_matrices(*model_);
  for (std::size_t v = 0; v < memory.size(); ++v) {
    const MatXd& a = memory[v].a;
    for (int first = 0; first < a.rows();) {
      const int end = end_of_block(a, first);
      LinearBlock block{idx(model_->vessels[v].memory_offset + first), idx(end - first), {}};
      for (int i = first; i < end; ++i) {
        for (int j = first; j < end; ++j) block.a.push_back(a(i, j));
      }
      out.push_back(std::move(block));
      first = end;
    }
  }
  return out;
}

}  // namespace seacrane
