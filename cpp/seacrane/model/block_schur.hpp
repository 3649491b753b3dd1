#pragma once

#include <vector>

#include "seacrane/elements/joint_rows.hpp"

namespace seacrane {

/// One constraint element (joint or driver) as a node of the joint graph.
struct GraphNode {
  int rows = 0;
  int first = -1, second = -1;  // bodies; `ground` has no inertia and makes no fill
};

/// Two bodies between which the mass matrix has a block.
struct CoupledBodies {
  int first, second;
};

/// Block-sparse L d L^T factorisation of S = D M^-1 D^T along the joint graph: bodies are eliminated
/// first, then the joints in minimum-degree order. The pattern is fixed; numbers live in a workspace.
class BlockSchur {
 public:
  BlockSchur() = default;
  BlockSchur(const std::vector<GraphNode>& nodes, int body_count,
             const std::vector<CoupledBodies>& coupled = {});

  int rows() const { return rows_; }
  /// First row of an element in the order of elimination, in which multipliers are stored.
  int row(int element) const { return row_of_[static_cast<std::size_t>(element)]; }
  std::size_t value_count() const { return value_count_; }

  /// A side of an element whose body is coupled to another, where D M^-1 is not zero.
  struct Crossing {
    int side, body, other;
  };
  const std::vector<Crossing>& crossings() const { return crossings_; }

  /// Sums S from D of each element and D M^-1 of each side [2 element + side], then of each crossing.
  void assemble(const RowBlock<double>* blocks, const Mat6d* over_mass, double* values) const;
  /// Where the block of a row's element and a column's begins among the values, and the way from one column
  /// to the next; of two that couple, the row's eliminated no earlier.
  struct Place {
    std::size_t first = 0;
    int height = 0;
  };
  Place place(int row_element, int column_element) const;
  /// Keeps the diagonal of S, as factor() needs it.
  void keep_diagonal(double* values) const;
  /// In place; returns the largest S_ii / d_i (1 for orthogonal constraints), infinity when a pivot
  /// is not positive. The ratio is invariant to the scaling of rows and estimates the lost digits.
  double factor(double* values) const;
  /// The same without the rows left out: what is solved with them is zero there.
  double factor(double* values, const std::vector<char>& left_out) const;
  /// The same, and chooses: a row is left out where `scale`_i / d_i, what it has over what the rows before it
  /// leave of it, is above `most`.
  double choose(double* values, const double* scale, double most, std::vector<char>& left_out) const;
  /// S_ii, of values that are assembled.
  const double* diagonal(const double* values) const { return values + value_count_ - rows_; }
  /// The combination of a row left out and those kept before it that S takes to zero, from the factors.
  void null_vector(double* values, int row, double* x) const;
  /// x := S^-1 x.
  void solve(const double* values, double* x) const;

 private:
  struct Panel {
    int width = 0, height = 0, first_row = 0;
    std::size_t values = 0;  // column-major height x width
    std::size_t below = 0;   // global rows of the part below the diagonal block
    std::size_t scatter = 0;
  };
  struct Term {
    int row_side, column_side;  // index into sides; of the column, behind them into crossings
    int row_count, column_count;
    int height;
    std::size_t target;
  };

  std::vector<std::vector<int>> order(const std::vector<GraphNode>& nodes,
                                      const std::vector<std::vector<int>>& adjacency);
  void lay_out(const std::vector<GraphNode>& nodes, std::vector<std::vector<int>> below);
  void collect_terms(const std::vector<GraphNode>& nodes, int body_count,
                     const std::vector<CoupledBodies>& coupled);
  template <class Keep>
  double factor_panels(double* values, const double* scale, Keep&& keep) const;
  std::size_t entry(int row, int column) const;
  void eliminate(const double* p, const Panel& panel, double* x) const;
  void substitute_back(const double* p, const Panel& panel, double* x) const;

  int rows_ = 0;
  std::size_t value_count_ = 0;
  std::vector<int> row_of_, panel_of_element_, panel_of_row_;
  std::vector<Panel> panels_;
  std::vector<int> below_;
  std::vector<std::size_t> scatter_;
  std::vector<Crossing> crossings_;
  std::vector<Term> terms_;
};

}  // namespace seacrane
