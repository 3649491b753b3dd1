#include "seacrane/integrate/dense_lu.hpp"

#include <sundials/sundials_dense.h>

namespace seacrane {

DenseLu::DenseLu(std::size_t size) : values_(size * size), columns_(size), pivots_(size) {
  for (std::size_t j = 0; j < size; ++j) columns_[j] = values_.data() + j * size;
}

bool DenseLu::factor() {
  const auto n = static_cast<sunindextype>(columns_.size());
  return SUNDlsMat_denseGETRF(columns_.data(), n, n, pivots_.data()) == 0;
}

void DenseLu::solve(double* b) const {
  // The routine takes pointers to what it does not change.
  SUNDlsMat_denseGETRS(const_cast<double**>(columns_.data()), static_cast<sunindextype>(columns_.size()),
                       const_cast<sunindextype*>(pivots_.data()), b);
}

}  // namespace seacrane
