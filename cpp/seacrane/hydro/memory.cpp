#include "seacrane/hydro/memory.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "seacrane/math/clones.hpp"

namespace seacrane {
namespace {

void check(const StateSpaceBlock& s, std::size_t index, int motions) {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("memory block " + std::to_string(index) + ": " + what);
  };
  const auto n = s.a.rows(), ni = static_cast<Eigen::Index>(s.inputs.size()),
             no = static_cast<Eigen::Index>(s.outputs.size());
  if (ni < 1 || ni > motions || no < 1 || no > motions) {
    fail("needs 1 to " + std::to_string(motions) + " inputs and outputs");
  }
  const auto within = [&](const char* what, const std::vector<int>& of) {
    for (int i : of) {
      if (i >= 0 && i < motions) continue;
      fail(what + std::to_string(i) + " is not a motion 0.." + std::to_string(motions - 1));
    }
  };
  within("input ", s.inputs);
  within("output ", s.outputs);
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

Memory::Memory(const std::vector<StateSpaceBlock>& blocks, int motions) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const StateSpaceBlock& s = blocks[k];
    check(s, k, motions);
    const int states = static_cast<int>(s.a.rows()), outputs = static_cast<int>(s.outputs.size());
    states_ += states;
    if (s.inputs.size() == 1 && outputs == 1 && states <= most_alone) {
      put_alone(s, states);
      continue;
    }
    runs_.push_back({false, states, 1, outputs, static_cast<int>(outputs_.size())});
    outputs_.insert(outputs_.end(), s.outputs.begin(), s.outputs.end());
    put_in_tiles(s.a, s.b, s.inputs);
    put_in_tiles(s.c, s.d, s.inputs);
  }
}

void Memory::put_alone(const StateSpaceBlock& s, int states) {
  if (runs_.empty() || !runs_.back().alone || runs_.back().states != states) {
    runs_.push_back({true, states, 0, 0, 0});
  }
  ++runs_.back().blocks;
  alone_.push_back({s.inputs.front(), s.outputs.front()});
  MatXd all = MatXd::Zero(stride(states), states + 1);
  all.topRows(states + 1) << s.a, s.b, s.c, s.d;
  alone_coefficients_.insert(alone_coefficients_.end(), all.data(), all.data() + all.size());
}

/// The matrix (left, right), whose right columns belong to `inputs`.
void Memory::put_in_tiles(const MatXd& left, const MatXd& right, const std::vector<int>& inputs) {
  for (Eigen::Index first = 0; first < left.rows(); first += tile) {
    const Eigen::Index rows = std::min<Eigen::Index>(tile, left.rows() - first);
    for (const MatXd* part : {&left, &right}) {
      const std::size_t count = columns_.size();
      columns_.push_back(0);
      for (Eigen::Index j = 0; j < part->cols(); ++j) {
        Eigen::Vector<double, tile> column = Eigen::Vector<double, tile>::Zero();
        column.head(rows) = part->col(j).segment(first, rows);
        if (column.isZero(0.0)) continue;
        ++columns_[count];
        columns_.push_back(part == &left ? static_cast<int>(j) : inputs[static_cast<std::size_t>(j)]);
        coefficients_.insert(coefficients_.end(), column.data(), column.data() + tile);
      }
    }
  }
}

SEACRANE_CLONES("avx2")
void Memory::evaluate_numbers(const double* u, const double* x, double* x_rate, double* mu) const {
  evaluate_all(u, x, x_rate, mu);
}

}  // namespace seacrane
