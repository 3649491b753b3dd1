#include <algorithm>
#include <variant>

#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {
namespace {

/// A of x' = A x + B u, one column per state: the rates under a unit state at rest.
MatXd dynamics(const Memory& memory) {
  const Vec6d rest = Vec6d::Zero();
  Vec6d load = Vec6d::Zero();
  MatXd a(memory.states(), memory.states());
  VecXd x = VecXd::Zero(memory.states());
  for (int j = 0; j < memory.states(); ++j) {
    x[j] = 1.0;
    memory.evaluate<double>(rest, x.data(), a.col(j).data(), load);
    x[j] = 0.0;
  }
  return a;
}

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
  for (const Vessel& vessel : model_->vessels) {
    const auto* memory = std::get_if<Memory>(&vessel.memory);
    if (!memory) continue;
    const MatXd a = dynamics(*memory);
    for (int first = 0; first < memory->states();) {
      const int end = end_of_block(a, first);
      LinearBlock block{idx(vessel.memory_offset + first), idx(end - first), {}};
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
