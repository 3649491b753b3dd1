#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace seacrane::test {

/// A rooted tree: its number of nodes, its density gamma and the trees that hang on its root.
struct RootedTree {
  int order = 1;
  long double density = 1.0L;
  std::vector<std::size_t> branches;  // indices into the list that holds the tree, not increasing
};

/// All rooted trees with up to `order` nodes [Hairer, Norsett, Wanner, Solving Ordinary Differential
/// Equations I, II.2].
inline std::vector<RootedTree> rooted_trees(int order) {
  std::vector<RootedTree> trees = {RootedTree{}};
  const auto grow = [&](auto&& self, RootedTree tree, std::size_t largest, int nodes_left,
                        std::vector<RootedTree>& found) -> void {
    if (nodes_left == 0) {
      tree.density *= tree.order;
      found.push_back(tree);
      return;
    }
    for (std::size_t i = 0; i <= largest; ++i) {
      if (trees[i].order > nodes_left) break;
      RootedTree next = tree;
      next.order += trees[i].order;
      next.density *= trees[i].density;
      next.branches.push_back(i);
      self(self, next, i, nodes_left - trees[i].order, found);
    }
  };
  for (int nodes = 2; nodes <= order; ++nodes) {
    std::vector<RootedTree> found;
    grow(grow, RootedTree{}, trees.size() - 1, nodes - 1, found);
    trees.insert(trees.end(), found.begin(), found.end());
  }
  return trees;
}

using Matrix = std::vector<std::vector<long double>>;

/// Elementary weights of the stages of a Runge-Kutta matrix, and what rounding may change them by: one entry
/// per tree and stage.
struct StageWeights {
  StageWeights(const std::vector<RootedTree>& trees, const Matrix& a)
      : value(trees.size(), std::vector<long double>(a.size(), 1.0L)), size(value) {
    for (std::size_t t = 0; t < trees.size(); ++t) {
      for (std::size_t i = 0; i < a.size(); ++i) {
        for (const std::size_t branch : trees[t].branches) {
          long double sum = 0.0L, largest = 0.0L;
          for (std::size_t j = 0; j < a[i].size(); ++j) {
            sum += a[i][j] * value[branch][j];
            largest += std::abs(a[i][j]) * size[branch][j];
          }
          value[t][i] *= sum;
          size[t][i] *= largest;
        }
      }
    }
  }
  Matrix value, size;
};

/// Largest defect of sum_i b_i Phi_i(t) = expected(t), in units of its own rounding.
template <class Expected>
long double defect(const std::vector<RootedTree>& trees, const StageWeights& weights,
                   const std::vector<long double>& b, Expected&& expected) {
  long double worst = 0.0L;
  for (std::size_t t = 0; t < trees.size(); ++t) {
    long double sum = -expected(trees[t]), size = std::abs(sum);
    for (std::size_t i = 0; i < b.size(); ++i) {
      sum += b[i] * weights.value[t][i];
      size += std::abs(b[i]) * weights.size[t][i];
    }
    worst = std::max(worst, std::abs(sum) / (size * std::numeric_limits<long double>::epsilon()));
  }
  return worst;
}

}  // namespace seacrane::test
