#include <doctest/doctest.h>

#include "seacrane/hydro/memory.hpp"
#include "seacrane/math/random.hpp"

namespace seacrane {

TEST_CASE("a fluid memory of blocks of any size is the sum of what each says, those without states too") {
  Random random(5);
  const auto matrix = [&](int rows, int cols) -> MatXd {
    return MatXd::NullaryExpr(rows, cols, [&] { return random.number(); });
  };
  const std::vector<std::vector<int>> motions = {{2}, {4}, {0, 3}, {5, 1, 2}};
  std::vector<StateSpaceBlock> blocks;
  for (const int n : {4, 4, 0, 7, 3, 13, 1, 6, 5, 2}) {
    for (const auto& inputs : motions) {
      for (const auto& outputs : motions) {
        const int in = static_cast<int>(inputs.size()), out = static_cast<int>(outputs.size());
        blocks.push_back({inputs, outputs, matrix(n, n), matrix(n, in), matrix(out, n), matrix(out, in), {}});
      }
    }
  }
  const Memory memory(blocks);
  const VecXd u = matrix(6, 1), x = matrix(memory.states(), 1);
  VecXd rate(memory.states()), load = VecXd::Zero(6), expected = load;
  memory.evaluate<double>(u.data(), x.data(), rate.data(), load.data());
  int first = 0;
  for (const StateSpaceBlock& block : blocks) {
    const VecXd own = x.segment(first, block.a.rows()), moved = u(block.inputs);
    CHECK((rate.segment(first, own.size()) - block.a * own - block.b * moved).norm() < 1e-14);
    expected(block.outputs) += block.c * own + block.d * moved;
    first += static_cast<int>(own.size());
  }
  CHECK(first == memory.states());
  CHECK((load - expected).norm() < 1e-13 * static_cast<double>(blocks.size()));
}

}  // namespace seacrane
