#include "seacrane/dynamics/dependence.hpp"

#include <algorithm>

#include "seacrane/model/model.hpp"

namespace seacrane {

int redundant_rows(const Model& model, int known, int left_out) {
  if (model.assembly.rank > 0) return model.rows() - model.assembly.rank;
  return known < 0 ? left_out : std::min(known, left_out);
}

}  // namespace seacrane
