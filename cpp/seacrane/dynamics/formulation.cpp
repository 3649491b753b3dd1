#include "seacrane/dynamics/formulation.hpp"

#include <algorithm>
#include <stdexcept>

#include "seacrane/dynamics/merged.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"

namespace seacrane {

int redundant_rows(const Model& model, int known, int left_out) {
  if (model.assembly.rank > 0) return model.rows() - model.assembly.rank;
  return known < 0 ? left_out : std::min(known, left_out);
}

std::unique_ptr<Formulation> make_formulation(const std::string& name, RedundantSystem& bodies) {
  const bool recursive = name == "recursive";
  if (recursive || name == "redundant") {
    if (bodies.model().merged) return std::make_unique<MergedSystem>(name, bodies.model());
    if (recursive) return std::make_unique<RecursiveSystem>(bodies);
    return nullptr;
  }
  throw std::invalid_argument("unknown formulation \"" + name + "\"; choose redundant or recursive");
}

}  // namespace seacrane
