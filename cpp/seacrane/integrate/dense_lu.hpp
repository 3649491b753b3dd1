#pragma once

#include <cstddef>
#include <vector>

#include "seacrane/integrate/sundials_compat.hpp"

namespace seacrane {

/// Square matrix by columns and its LU factors with partial pivoting, in place (SUNDIALS' routines, which
/// allocate nothing whatever the size).
class DenseLu {
 public:
  explicit DenseLu(std::size_t size);
  DenseLu(const DenseLu&) = delete;
  DenseLu& operator=(const DenseLu&) = delete;

  double* column(std::size_t j) { return columns_[j]; }
  /// Replaces the matrix by its factors; false when it is singular.
  bool factor();
  /// Solves for the right side `b`, in place.
  void solve(double* b) const;

 private:
  std::vector<double> values_;
  std::vector<double*> columns_;
  std::vector<sunindextype> pivots_;
};

}  // namespace seacrane
