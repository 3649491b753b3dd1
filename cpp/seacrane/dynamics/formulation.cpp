#include "seacrane/dynamics/formulation.hpp"

#include <stdexcept>

#include "seacrane/dynamics/merged.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"

namespace seacrane {

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
