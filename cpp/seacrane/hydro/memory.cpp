#include "seacrane/hydro/memory.hpp"

#include <stdexcept>
#include <string>

namespace seacrane {
namespace {

void check(const StateSpaceBlock& s, std::size_t index) {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("memory block " + std::to_string(index) + ": " + what);
  };
  const auto n = s.a.rows(), ni = static_cast<Eigen::Index>(s.inputs.size()),
             no = static_cast<Eigen::Index>(s.outputs.size());
  if (ni < 1 || ni > 6 || no < 1 || no > 6) fail("needs 1 to 6 inputs and outputs");
  for (int i : s.inputs)
    if (i < 0 || i > 5) fail("input " + std::to_string(i) + " is not a motion 0..5");
  for (int i : s.outputs)
    if (i < 0 || i > 5) fail("output " + std::to_string(i) + " is not a motion 0..5");
  if (s.a.cols() != n || s.b.rows() != n || s.b.cols() != ni || s.c.rows() != no || s.c.cols() != n ||
      s.d.rows() != no || s.d.cols() != ni) {
    fail("shapes of A, B, C, D do not fit " + std::to_string(n) + " states, " + std::to_string(ni) +
         " inputs, " + std::to_string(no) + " outputs");
  }
  if (!s.a.allFinite() || !s.b.allFinite() || !s.c.allFinite() || !s.d.allFinite()) {
    fail("holds a value that is not finite");
  }
  if (s.state_scale.size() != 0 && (s.state_scale.size() != n || !(s.state_scale.array() > 0.0).all())) {
    fail("state_scale needs one positive value per state");
  }
}

}  // namespace

Memory::Memory(const std::vector<StateSpaceBlock>& blocks) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const StateSpaceBlock& s = blocks[k];
    check(s, k);
    Block block{};
    block.states = static_cast<int>(s.a.rows());
    block.inputs = static_cast<int>(s.inputs.size());
    block.outputs = static_cast<int>(s.outputs.size());
    for (std::size_t i = 0; i < s.inputs.size(); ++i) block.input[i] = s.inputs[i];
    for (std::size_t i = 0; i < s.outputs.size(); ++i) block.output[i] = s.outputs[i];
    put_in_tiles(s.a, s.b);
    put_in_tiles(s.c, s.d);
    blocks_.push_back(block);
    states_ += block.states;
  }
}

/// The matrix (left, right).
void Memory::put_in_tiles(const MatXd& left, const MatXd& right) {
  MatXd all(left.rows(), left.cols() + right.cols());
  all << left, right;
  in_tiles(static_cast<int>(all.rows()), [&]<int rows>(int first) {
    for (Eigen::Index j = 0; j < all.cols(); ++j) {
      for (int i = 0; i < rows; ++i) coefficients_.push_back(all(first + i, j));
    }
  });
}

}  // namespace seacrane
