#pragma once

#include <array>
#include <vector>

#include "seacrane/dynamics/recursive/articulated.hpp"
#include "seacrane/model/block_schur.hpp"

namespace seacrane {

/// One row of an element that closes a loop.
struct LoopRow {
  int element, row, first, second;  // first, second: bodies, ground = their count
  bool driver;
};

/// G = D M^-1 D^T of rows that close loops between several trees, each with a root of its own: rows that
/// share no tree do not couple, so each response is that of one or two trees, and G is sparse. Rows that the
/// others hold by geometry are left out. Nothing is allocated after construction. Scratch of one run.
class SparseLoops {
 public:
  /// `kept`: by row, whether it is enforced.
  SparseLoops(const BodyTree& tree, int bodies, const std::vector<LoopRow>& rows,
              const std::vector<char>& kept);

  /// How many trees loops couple: with one there is nothing to gain.
  static int trees_of(const Model& model, const BodyTree& tree);

  /// G at the tree's last factor(mass), factored. Returns the largest G_ii / d_i; `diagonal[i]` is G_ii of
  /// row i that is kept.
  double factor(const RowBlock<double>* blocks, ArticulatedTree<double>& tree, double* diagonal);
  /// Which rows are kept: those of which the rows before them, in the order of elimination, leave more than
  /// one part in `most` of what their bodies give along them without joints.
  std::vector<char> choose(const RowBlock<double>* blocks, ArticulatedTree<double>& tree,
                           const std::vector<double>& loose, double most);
  /// Multipliers of all rows for their right side; zero for those left out.
  void solve(const VecXd& right, VecXd& multipliers);
  const std::vector<int>& left_out() const { return left_out_; }

 private:
  struct Neighbour {
    int node = 0;
    bool first = false, second = false;  // sides on a tree of the column's
    BlockSchur::Place place;
  };
  struct Node {
    int element = 0, first = 0, second = 0;
    std::array<int, 2> tree{};            // of both bodies; -1: the ground's
    std::vector<int> rows{};              // that are kept, among all rows
    std::vector<std::size_t> clusters{};  // of its trees, parents before children
    std::vector<Neighbour> below{};
  };

  void add_nodes(const std::vector<char>& kept);
  void find_neighbours();
  void copy(std::size_t node, const double* of_rows, double* out) const;
  void gather(const RowBlock<double>* blocks, ArticulatedTree<double>& tree, double* diagonal);
  void respond(const Node& column, int row, const RowBlock<double>* blocks, ArticulatedTree<double>& tree);

  std::vector<LoopRow> rows_;
  std::vector<Node> nodes_;
  std::vector<int> left_out_;
  BlockSchur schur_;
  std::vector<double> values_, right_, speeds_;
};

}  // namespace seacrane
