#include "seacrane/dynamics/recursive/sparse_loops.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace seacrane {

int SparseLoops::trees_of(const Model& model, const BodyTree& tree) {
  const std::vector<int> root = roots_of(tree, model.body_count());
  std::set<int> found;
  for (const int e : tree.loops) {
    found.insert({root[idx(model.elements[idx(e)].first)], root[idx(model.elements[idx(e)].second)]});
  }
  found.erase(-1);
  return static_cast<int>(found.size());
}

SparseLoops::SparseLoops(const BodyTree& tree, int bodies, const std::vector<LoopRow>& rows,
                         const std::vector<char>& kept)
    : rows_(rows), speeds_(idx(tree.speeds)) {
  add_nodes(kept);
  const std::vector<int> root = roots_of(tree, bodies);
  std::map<int, std::vector<std::size_t>> clusters;
  for (std::size_t i = 0; i < tree.clusters.size(); ++i) {
    clusters[root[idx(tree.clusters[i].body)]].push_back(i);
  }
  std::vector<GraphNode> graph;
  for (Node& node : nodes_) {
    node.tree[0] = root[idx(node.first)];
    node.tree[1] = root[idx(node.second)];
    for (const int t : std::set<int>{node.tree[0], node.tree[1]}) {
      if (t >= 0) node.clusters.insert(node.clusters.end(), clusters[t].begin(), clusters[t].end());
    }
    std::ranges::sort(node.clusters);
    graph.push_back({static_cast<int>(node.rows.size()), node.tree[0], node.tree[1]});
  }
  schur_ = BlockSchur(graph, static_cast<int>(clusters.size()));
  find_neighbours();
  values_.assign(schur_.value_count(), 0.0);
  right_.assign(idx(schur_.rows()), 0.0);
}

/// One for each element, with its rows that are kept.
void SparseLoops::add_nodes(const std::vector<char>& kept) {
  std::map<int, std::size_t> node_of;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const LoopRow& row = rows_[i];
    const auto [at, added] = node_of.try_emplace(row.element, nodes_.size());
    if (added) nodes_.push_back({.element = row.element, .first = row.first, .second = row.second});
    (kept[i] ? nodes_[at->second].rows : left_out_).push_back(static_cast<int>(i));
  }
}

/// Of each node those behind it in the elimination that share a tree with it, itself among them.
void SparseLoops::find_neighbours() {
  std::map<int, std::set<int>> on;  // nodes by tree
  for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) {
    if (nodes_[idx(n)].rows.empty()) continue;
    for (const int t : nodes_[idx(n)].tree) on[t].insert(n);
  }
  on.erase(-1);
  for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) {
    Node& node = nodes_[idx(n)];
    if (node.rows.empty()) continue;
    const auto shares = [&](int t) { return t >= 0 && (t == node.tree[0] || t == node.tree[1]); };
    std::set<int> near;
    for (const int t : node.tree) {
      if (t >= 0) near.insert(on[t].begin(), on[t].end());
    }
    for (const int other : near) {
      if (schur_.row(other) < schur_.row(n)) continue;
      const auto& trees = nodes_[idx(other)].tree;
      node.below.push_back({other, shares(trees[0]), shares(trees[1]), schur_.place(other, n)});
    }
  }
}

/// The trees' accelerations under a force along one row.
void SparseLoops::respond(const Node& column, int row, const RowBlock<double>* blocks,
                          ArticulatedTree<double>& tree) {
  const RowBlock<double>& block = blocks[column.element];
  const Vec6d first = block.d[0].row(row).transpose(), second = block.d[1].row(row).transpose();
  tree.rest(column.clusters);
  tree.push(column.first, Wrench<double>(first));
  tree.push(column.second, Wrench<double>(second));
  tree.respond(column.clusters, speeds_.data());
}

double SparseLoops::factor(const RowBlock<double>* blocks, ArticulatedTree<double>& tree, double* diagonal) {
  gather(blocks, tree, diagonal);
  schur_.keep_diagonal(values_.data());
  return schur_.factor(values_.data());
}

std::vector<char> SparseLoops::choose(const RowBlock<double>* blocks, ArticulatedTree<double>& tree,
                                      const std::vector<double>& loose, double most) {
  std::vector<double> diagonal(rows_.size());
  gather(blocks, tree, diagonal.data());
  for (std::size_t n = 0; n < nodes_.size(); ++n) copy(n, loose.data(), right_.data());
  std::vector<char> left_out, kept(rows_.size());
  schur_.choose(values_.data(), right_.data(), most, left_out);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const int at = schur_.row(static_cast<int>(n));
    const std::vector<int>& rows = nodes_[n].rows;
    for (std::size_t r = 0; r < rows.size(); ++r) kept[idx(rows[r])] = left_out[idx(at) + r] ? 0 : 1;
  }
  return kept;
}

/// Values of a node's rows, in the order of elimination.
void SparseLoops::copy(std::size_t node, const double* of_rows, double* out) const {
  const std::vector<int>& rows = nodes_[node].rows;
  out += schur_.row(static_cast<int>(node));
  for (std::size_t r = 0; r < rows.size(); ++r) out[r] = of_rows[rows[r]];
}

void SparseLoops::gather(const RowBlock<double>* blocks, ArticulatedTree<double>& tree, double* diagonal) {
  std::ranges::fill(values_, 0.0);
  for (const Node& column : nodes_) {
    for (std::size_t c = 0; c < column.rows.size(); ++c) {
      respond(column, rows_[idx(column.rows[c])].row, blocks, tree);
      for (const Neighbour& near : column.below) {
        const Node& node = nodes_[idx(near.node)];
        const RowBlock<double>& block = blocks[node.element];
        double* const target = values_.data() + near.place.first + c * idx(near.place.height);
        for (std::size_t r = 0; r < node.rows.size(); ++r) {
          const int row = rows_[idx(node.rows[r])].row;
          double sum = 0.0;
          if (near.first) sum += block.d[0].row(row).dot(tree.acceleration(node.first).vector());
          if (near.second) sum += block.d[1].row(row).dot(tree.acceleration(node.second).vector());
          target[r] = sum;
          if (&node == &column && r == c) diagonal[column.rows[c]] = sum;
        }
      }
    }
  }
}

void SparseLoops::solve(const VecXd& right, VecXd& multipliers) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) copy(n, right.data(), right_.data());
  schur_.solve(values_.data(), right_.data());
  multipliers.setZero();
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const int at = schur_.row(static_cast<int>(n));
    const std::vector<int>& rows = nodes_[n].rows;
    for (std::size_t r = 0; r < rows.size(); ++r) multipliers[rows[r]] = right_[idx(at) + r];
  }
}

}  // namespace seacrane
