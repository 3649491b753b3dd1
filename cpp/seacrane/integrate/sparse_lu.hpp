#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seacrane {

/// Square matrix by columns and its LU factors, which skip what is zero. Pivots are chosen for few new
/// entries and size [Markowitz; Duff, Erisman, Reid, Direct Methods for Sparse Matrices, ch. 7]: states of
/// the fluid's memory and positions couple to little, go first, and leave a small matrix of what does.
/// Allocates nothing after construction.
class SparseLu {
 public:
  explicit SparseLu(std::size_t size);

  double* column(std::size_t j) { return values_.data() + j * size_; }
  /// Replaces the matrix by its factors; false when it is singular.
  bool factor();
  /// Solves for the right side `b`, in place.
  void solve(double* b) const;

 private:
  /// The rows of a column, or the columns of a row, that are left and not zero: a bit each.
  struct Pattern {
    std::size_t words;
    std::vector<std::uint64_t> bits;
    std::vector<int> count;

    explicit Pattern(std::size_t size);
    std::uint64_t* of(std::size_t i) { return bits.data() + i * words; }
    void add(std::size_t i, std::size_t entry) { of(i)[entry / 64] |= std::uint64_t{1} << entry % 64; }
    void remove(std::size_t i, std::size_t entry) { of(i)[entry / 64] &= ~(std::uint64_t{1} << entry % 64); }
    bool has(std::size_t i, std::size_t entry) { return of(i)[entry / 64] >> entry % 64 & 1; }
    void merge(std::size_t i, const std::uint64_t* more);
    void recount(std::size_t i);
    /// Writes the entries of i.
    void list(std::size_t i, std::vector<std::size_t>& out);
  };
  struct Entry {
    std::size_t at;
    double value;
  };
  /// One step of the elimination; its entries lie between those of its neighbours, `upper` first.
  struct Pivot {
    std::size_t row, column;
    double inverse;
    std::size_t upper, lower, end;
  };

  void find_pattern();
  bool choose(Pivot& pivot);
  void eliminate(Pivot& pivot);

  std::size_t size_;
  std::vector<double> values_;
  Pattern rows_, columns_;
  std::vector<std::size_t> left_;  // columns that are still to be eliminated
  std::vector<std::size_t> below_, beside_;
  std::vector<Entry> entries_;
  std::vector<Pivot> pivots_;
  mutable std::vector<double> solution_;
};

}  // namespace seacrane
