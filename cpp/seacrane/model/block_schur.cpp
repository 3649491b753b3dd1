#include "seacrane/model/block_schur.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace seacrane {
namespace {

constexpr int kChunk = 64;  // rows updated at a time, on the stack

/// Elements without rows (a free joint) link nothing.
std::vector<std::vector<int>> joint_adjacency(const std::vector<GraphNode>& nodes, int body_count,
                                              const std::vector<CoupledBodies>& coupled) {
  std::vector<std::vector<int>> at_body(idx(body_count));
  for (std::size_t e = 0; e < nodes.size(); ++e) {
    if (nodes[e].rows == 0) continue;
    for (int body : {nodes[e].first, nodes[e].second}) {
      if (body >= 0 && body < body_count) at_body[idx(body)].push_back(static_cast<int>(e));
    }
  }
  std::vector<std::set<int>> sets(nodes.size());
  const auto link = [&](const std::vector<int>& some, const std::vector<int>& others) {
    for (int a : some) {
      for (int b : others) {
        if (a != b) sets[idx(a)].insert(b);
      }
    }
  };
  for (const auto& elements : at_body) link(elements, elements);
  for (const auto [first, second] : coupled) {
    link(at_body[idx(first)], at_body[idx(second)]);
    link(at_body[idx(second)], at_body[idx(first)]);
  }
  std::vector<std::vector<int>> out;
  for (const auto& s : sets) out.emplace_back(s.begin(), s.end());
  return out;
}

/// L D L^T of one panel, in place: columns keep u = L d, the diagonal 1 / d, and zeros where `keep` leaves a
/// row out for its S_ii / d_i. Returns the largest of those kept.
template <class Keep>
double factor_panel(double* p, int width, int height, const double* diagonal, Keep&& keep) {
  double worst = 1.0;
  for (int c = 0; c < width; ++c) {
    double* column = p + c * height;
    const double inverse = 1.0 / column[c];
    const double loss = column[c] > 0.0 ? diagonal[c] * inverse : std::numeric_limits<double>::infinity();
    if (!keep(c, loss)) {
      std::fill(column + c, column + height, 0.0);
      continue;
    }
    if (!std::isfinite(loss)) return loss;
    worst = std::max(worst, loss);
    column[c] = inverse;
    for (int c2 = c + 1; c2 < width; ++c2) {
      const double a = column[c2] * inverse;
      double* target = p + c2 * height;
      for (int r = c2; r < height; ++r) target[r] -= a * column[r];
    }
  }
  return worst;
}

/// What a factored panel subtracts from the panels of the rows below it.
template <int width>
void update_below(const double* p, int height, const std::size_t* scatter, double* values) {
  double sum[kChunk];
  for (int c = width; c < height; ++c) {
    double a[width];
    for (int k = 0; k < width; ++k) a[k] = p[k * height + c] * p[k * height + k];
    // Long panels are walked in chunks that fit the stack buffer.
    for (int start = c; start < height; start += kChunk) {
      const int count = std::min(kChunk, height - start);
      const double* row = p + start;
      for (int i = 0; i < count; ++i) {
        double s = 0.0;
        for (int k = 0; k < width; ++k) s += a[k] * row[k * height + i];
        sum[i] = s;
      }
      for (int i = 0; i < count; ++i) values[*scatter++] -= sum[i];
    }
  }
}

}  // namespace

BlockSchur::BlockSchur(const std::vector<GraphNode>& nodes, int body_count,
                       const std::vector<CoupledBodies>& coupled) {
  lay_out(nodes, order(nodes, joint_adjacency(nodes, body_count, coupled)));
  collect_terms(nodes, body_count, coupled);
  value_count_ += idx(rows_);  // room for the diagonal of S before factorisation
}

/// Panels in the order of elimination, by least degree; returns the elements below each.
std::vector<std::vector<int>> BlockSchur::order(const std::vector<GraphNode>& nodes,
                                                const std::vector<std::vector<int>>& adjacency) {
  const std::size_t n = nodes.size();
  std::vector<std::set<int>> graph(n);
  for (std::size_t e = 0; e < n; ++e) graph[e].insert(adjacency[e].begin(), adjacency[e].end());
  const auto degree = [&](int e) {
    int sum = 0;
    for (int other : graph[idx(e)]) sum += nodes[idx(other)].rows;
    return sum;
  };
  std::set<std::pair<int, int>> queue;  // (degree, element): ties break by index, so that the order is fixed
  std::vector<int> current(n);
  for (std::size_t e = 0; e < n; ++e) {
    current[e] = degree(static_cast<int>(e));
    queue.insert({current[e], static_cast<int>(e)});
  }
  row_of_.assign(n, 0);
  panel_of_element_.assign(n, 0);
  std::vector<std::vector<int>> below(n);
  while (!queue.empty()) {
    const int e = queue.begin()->second;
    queue.erase(queue.begin());
    std::vector<int>& neighbours = below[panels_.size()];
    neighbours.assign(graph[idx(e)].begin(), graph[idx(e)].end());
    row_of_[idx(e)] = rows_;
    panel_of_element_[idx(e)] = static_cast<int>(panels_.size());
    Panel panel;
    panel.width = nodes[idx(e)].rows;
    panel.first_row = rows_;
    rows_ += panel.width;
    panels_.push_back(panel);
    for (int a : neighbours) {
      graph[idx(a)].erase(e);
      for (int b : neighbours) {
        if (a != b) graph[idx(a)].insert(b);
      }
      queue.erase({current[idx(a)], a});
      current[idx(a)] = degree(a);
      queue.insert({current[idx(a)], a});
    }
  }
  return below;
}

/// The rows, values and updates of each panel.
void BlockSchur::lay_out(const std::vector<GraphNode>& nodes, std::vector<std::vector<int>> below) {
  panel_of_row_.assign(idx(rows_), 0);
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    Panel& panel = panels_[p];
    for (int r = 0; r < panel.width; ++r) panel_of_row_[idx(panel.first_row + r)] = static_cast<int>(p);
    std::sort(below[p].begin(), below[p].end(),
              [&](int a, int b) { return row_of_[idx(a)] < row_of_[idx(b)]; });
    panel.below = below_.size();
    panel.height = panel.width;
    for (int e : below[p]) {
      for (int r = 0; r < nodes[idx(e)].rows; ++r) below_.push_back(row_of_[idx(e)] + r);
      panel.height += nodes[idx(e)].rows;
    }
    panel.values = value_count_;
    value_count_ += idx(panel.height) * idx(panel.width);
  }
  for (Panel& panel : panels_) {
    panel.scatter = scatter_.size();
    const int r = panel.height - panel.width;
    for (int c = 0; c < r; ++c) {
      for (int i = c; i < r; ++i) {
        scatter_.push_back(entry(below_[panel.below + idx(i)], below_[panel.below + idx(c)]));
      }
    }
  }
}

std::size_t BlockSchur::entry(int row, int column) const {
  const Panel& panel = panels_[idx(panel_of_row_[idx(column)])];
  const int c = column - panel.first_row;
  int r = row - panel.first_row;
  if (r >= panel.width) {
    const auto begin = below_.begin() + static_cast<std::ptrdiff_t>(panel.below);
    const auto end = begin + (panel.height - panel.width);
    r = panel.width + static_cast<int>(std::lower_bound(begin, end, row) - begin);
  }
  return panel.values + idx(c) * idx(panel.height) + idx(r);
}

void BlockSchur::collect_terms(const std::vector<GraphNode>& nodes, int body_count,
                               const std::vector<CoupledBodies>& coupled) {
  const auto body = [&](int side) {
    const GraphNode& node = nodes[idx(side / 2)];
    return side % 2 == 0 ? node.first : node.second;
  };
  std::vector<std::vector<int>> at_body(idx(body_count));
  for (int side = 0; side < 2 * static_cast<int>(nodes.size()); ++side) {
    const int b = body(side);
    if (b >= 0 && b < body_count && nodes[idx(side / 2)].rows > 0) at_body[idx(b)].push_back(side);
  }
  const auto add = [&](int i, int j, int over_mass) {
    if (row_of_[idx(i / 2)] < row_of_[idx(j / 2)]) return;
    terms_.push_back({i, over_mass, nodes[idx(i / 2)].rows, nodes[idx(j / 2)].rows,
                      panels_[idx(panel_of_element_[idx(j / 2)])].height,
                      entry(row_of_[idx(i / 2)], row_of_[idx(j / 2)])});
  };
  for (const auto& sides : at_body) {
    for (int i : sides) {
      for (int j : sides) add(i, j, j);
    }
  }
  const auto cross = [&](int own, int other) {
    for (int j : at_body[idx(own)]) {
      const int place = static_cast<int>(2 * nodes.size() + crossings_.size());
      crossings_.push_back({j, own, other});
      for (int i : at_body[idx(other)]) add(i, j, place);
    }
  };
  for (const auto [first, second] : coupled) {
    cross(first, second);
    cross(second, first);
  }
  std::sort(terms_.begin(), terms_.end(), [](const Term& a, const Term& b) { return a.target < b.target; });
}

void BlockSchur::assemble(const RowBlock<double>* blocks, const Mat6d* over_mass, double* values) const {
  std::fill_n(values, value_count_, 0.0);
  for (const Term& term : terms_) {
    const Mat6d& d = blocks[term.row_side / 2].d[term.row_side % 2];
    const Mat6d& dw = over_mass[term.column_side];
    double* target = values + term.target;
    for (int c = 0; c < term.column_count; ++c, target += term.height) {
      Vec6d column = d.col(0) * dw(c, 0);
      for (int k = 1; k < 6; ++k) column += d.col(k) * dw(c, k);
      for (int r = 0; r < term.row_count; ++r) target[r] += column[r];
    }
  }
  keep_diagonal(values);
}

BlockSchur::Place BlockSchur::place(int row_element, int column_element) const {
  return {entry(row(row_element), row(column_element)),
          panels_[idx(panel_of_element_[idx(column_element)])].height};
}

void BlockSchur::keep_diagonal(double* values) const {
  double* diagonal = values + value_count_ - rows_;
  for (const Panel& panel : panels_) {
    for (int c = 0; c < panel.width; ++c) *diagonal++ = values[panel.values + idx(c * (panel.height + 1))];
  }
}

double BlockSchur::factor(double* values) const {
  return factor_panels(values, diagonal(values), [](int, double) { return true; });
}

double BlockSchur::factor(double* values, const std::vector<char>& left_out) const {
  return factor_panels(values, diagonal(values), [&](int row, double) { return left_out[idx(row)] == 0; });
}

double BlockSchur::choose(double* values, const double* scale, double most,
                          std::vector<char>& left_out) const {
  left_out.assign(idx(rows_), 0);
  return factor_panels(values, scale, [&](int row, double loss) {
    left_out[idx(row)] = loss <= most ? 0 : 1;
    return loss <= most;
  });
}

template <class Keep>
double BlockSchur::factor_panels(double* values, const double* scale, Keep&& keep) const {
  double worst = 1.0;
  for (const Panel& panel : panels_) {
    double* p = values + panel.values;
    const double loss = factor_panel(p, panel.width, panel.height, scale + panel.first_row,
                                     [&](int c, double own) { return keep(panel.first_row + c, own); });
    if (!std::isfinite(loss)) return loss;
    worst = std::max(worst, loss);
    const std::size_t* scatter = scatter_.data() + panel.scatter;
    switch (panel.width) {
      case 1:
        update_below<1>(p, panel.height, scatter, values);
        break;
      case 2:
        update_below<2>(p, panel.height, scatter, values);
        break;
      case 3:
        update_below<3>(p, panel.height, scatter, values);
        break;
      case 4:
        update_below<4>(p, panel.height, scatter, values);
        break;
      case 5:
        update_below<5>(p, panel.height, scatter, values);
        break;
      default:
        update_below<6>(p, panel.height, scatter, values);
    }
  }
  return worst;
}

void BlockSchur::solve(const double* values, double* x) const {
  for (const Panel& panel : panels_) eliminate(values + panel.values, panel, x);
  for (auto panel = panels_.rbegin(); panel != panels_.rend(); ++panel) {
    substitute_back(values + panel->values, *panel, x);
  }
}

void BlockSchur::null_vector(double* values, int row, double* x) const {
  const int last = panel_of_row_[idx(row)];
  const Panel& own = panels_[idx(last)];
  double& inverse = values[own.values + idx((row - own.first_row) * (own.height + 1))];
  std::fill_n(x, rows_, 0.0);
  x[row] = inverse = 1.0;
  for (int p = last; p >= 0; --p) substitute_back(values + panels_[idx(p)].values, panels_[idx(p)], x);
  inverse = 0.0;
}

void BlockSchur::eliminate(const double* p, const Panel& panel, double* x) const {
  const int h = panel.height, w = panel.width;
  double* own = x + panel.first_row;
  double v[kMaxRows];
  for (int c = 0; c < w; ++c) {
    const double* column = p + c * h;
    v[c] = own[c] * column[c];
    for (int r = c + 1; r < w; ++r) own[r] -= column[r] * v[c];
  }
  const int* below = below_.data() + panel.below;
  for (int r = w; r < h; ++r) {
    double sum = 0.0;
    for (int c = 0; c < w; ++c) sum += p[c * h + r] * v[c];
    x[*below++] -= sum;
  }
}

void BlockSchur::substitute_back(const double* p, const Panel& panel, double* x) const {
  const int h = panel.height, w = panel.width;
  double* own = x + panel.first_row;
  const int* below = below_.data() + panel.below;
  for (int r = w; r < h; ++r) {
    const double known = x[*below++];
    for (int c = 0; c < w; ++c) own[c] -= p[c * h + r] * known;
  }
  for (int c = w - 1; c >= 0; --c) {
    const double* column = p + c * h;
    for (int r = c + 1; r < w; ++r) own[c] -= column[r] * own[r];
    own[c] *= column[c];
  }
}

}  // namespace seacrane
