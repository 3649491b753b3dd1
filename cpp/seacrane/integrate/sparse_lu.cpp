#include "seacrane/integrate/sparse_lu.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace seacrane {
namespace {

/// A pivot is at least this share of the largest entry of its column.
constexpr double least_pivot = 0.5;

}  // namespace

SparseLu::Pattern::Pattern(std::size_t size) : words((size + 63) / 64), bits(size * words), count(size) {}

void SparseLu::Pattern::merge(std::size_t i, const std::uint64_t* more) {
  std::uint64_t* const own = of(i);
  for (std::size_t w = 0; w < words; ++w) own[w] |= more[w];
}

void SparseLu::Pattern::recount(std::size_t i) {
  count[i] = 0;
  for (std::size_t w = 0; w < words; ++w) count[i] += std::popcount(of(i)[w]);
}

void SparseLu::Pattern::list(std::size_t i, std::vector<std::size_t>& out) {
  out.clear();
  for (std::size_t w = 0; w < words; ++w) {
    for (std::uint64_t word = of(i)[w]; word != 0; word &= word - 1) {
      out.push_back(64 * w + static_cast<std::size_t>(std::countr_zero(word)));
    }
  }
}

SparseLu::SparseLu(std::size_t size)
    : size_(size), values_(size * size), rows_(size), columns_(size), pivots_(size), solution_(size) {
  for (auto* list : {&left_, &below_, &beside_}) list->reserve(size);
  entries_.reserve(size * size);
}

bool SparseLu::factor() {
  find_pattern();
  entries_.clear();
  return std::ranges::all_of(pivots_, [this](Pivot& pivot) {
    if (!choose(pivot)) return false;
    eliminate(pivot);
    return true;
  });
}

void SparseLu::find_pattern() {
  for (auto* pattern : {&rows_, &columns_}) std::ranges::fill(pattern->bits, 0);
  left_.clear();
  for (std::size_t j = 0; j < size_; ++j) {
    left_.push_back(j);
    const double* const values = column(j);
    for (std::size_t i = 0; i < size_; ++i) {
      if (values[i] == 0.0) continue;
      rows_.add(i, j);
      columns_.add(j, i);
    }
  }
  for (std::size_t i = 0; i < size_; ++i) {
    rows_.recount(i);
    columns_.recount(i);
  }
}

/// The column that would fill the fewest entries with a pivot on the diagonal, or where there is none with a
/// row as short as itself; of those that are large enough the one whose row has the
/// fewest.
bool SparseLu::choose(Pivot& pivot) {
  std::size_t next = 0;
  long least = std::numeric_limits<long>::max();
  for (std::size_t k = 0; k < left_.size() && least > 0; ++k) {
    const std::size_t j = left_[k];
    const int own = columns_.count[j], row = columns_.has(j, j) ? rows_.count[j] : own;
    const long fill = long{own - 1} * (row - 1);
    if (fill >= least) continue;
    least = fill;
    next = k;
  }
  pivot.column = left_[next];
  left_[next] = left_.back();
  left_.pop_back();
  columns_.list(pivot.column, below_);
  const double* const values = column(pivot.column);
  double largest = 0.0;
  for (const std::size_t i : below_) largest = std::max(largest, std::abs(values[i]));
  if (!(largest > 0.0)) return false;
  int fewest = static_cast<int>(size_) + 1;
  for (const std::size_t i : below_) {
    if (rows_.count[i] >= fewest || std::abs(values[i]) < least_pivot * largest) continue;
    fewest = rows_.count[i];
    pivot.row = i;
  }
  pivot.inverse = 1.0 / values[pivot.row];
  return true;
}

void SparseLu::eliminate(Pivot& pivot) {
  std::erase(below_, pivot.row);
  rows_.remove(pivot.row, pivot.column);
  columns_.remove(pivot.column, pivot.row);
  rows_.list(pivot.row, beside_);
  pivot.upper = entries_.size();
  for (const std::size_t j : beside_) entries_.push_back({j, column(j)[pivot.row]});
  pivot.lower = entries_.size();
  const double* const values = column(pivot.column);
  for (const std::size_t i : below_) entries_.push_back({i, values[i] * pivot.inverse});
  pivot.end = entries_.size();
  for (std::size_t u = pivot.upper; u < pivot.lower; ++u) {
    double* const to = column(entries_[u].at);
    for (std::size_t l = pivot.lower; l < pivot.end; ++l)
      to[entries_[l].at] -= entries_[l].value * entries_[u].value;
  }
  for (const std::size_t i : below_) {
    rows_.merge(i, rows_.of(pivot.row));
    rows_.remove(i, pivot.column);
    rows_.recount(i);
  }
  for (const std::size_t j : beside_) {
    columns_.merge(j, columns_.of(pivot.column));
    columns_.remove(j, pivot.row);
    columns_.recount(j);
  }
}

void SparseLu::solve(double* b) const {
  for (const Pivot& pivot : pivots_) {
    const double known = b[pivot.row];
    for (std::size_t l = pivot.lower; l < pivot.end; ++l) b[entries_[l].at] -= entries_[l].value * known;
  }
  for (auto pivot = pivots_.rbegin(); pivot != pivots_.rend(); ++pivot) {
    double sum = b[pivot->row];
    for (std::size_t u = pivot->upper; u < pivot->lower; ++u) {
      sum -= entries_[u].value * solution_[entries_[u].at];
    }
    solution_[pivot->column] = sum * pivot->inverse;
  }
  std::ranges::copy(solution_, b);
}

}  // namespace seacrane
