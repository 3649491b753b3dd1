#pragma once

#include <vector>

#include "seacrane/elements/joint_rows.hpp"

namespace seacrane {

struct Model;

/// Whether a row that others hold at assembled poses stands open by more than those can be off.
bool stands_open(const RowBlock<double>& block, int row);
/// Whether it does not hold under accelerations of its bodies.
bool is_missed(const RowBlock<double>& block, int row, const Vec6d& first, const Vec6d& second);

/// Rows of a model that the others hold at assembled poses, and that are left out as long as they do.
class LeftOutRows {
 public:
  explicit LeftOutRows(const Model& model);

  bool any() const { return !rows_.empty(); }
  int count() const { return static_cast<int>(rows_.size()); }
  bool stand_open(const RowBlock<double>* blocks) const;
  /// Under accelerations of all bodies, ground last.
  bool are_missed(const RowBlock<double>* blocks, const Vec6d* acceleration) const;

 private:
  struct Row {
    std::size_t element = 0, first = 0, second = 0;
    int row = 0;  // of the element
  };
  std::vector<Row> rows_;
};

}  // namespace seacrane
