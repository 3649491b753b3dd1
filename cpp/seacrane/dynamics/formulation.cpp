#include "seacrane/dynamics/formulation.hpp"

#include <stdexcept>

#include "seacrane/dynamics/recursive/recursive.hpp"

namespace seacrane {

std::unique_ptr<Formulation> make_formulation(const std::string& name, RedundantSystem& bodies) {
  if (name == "redundant") return nullptr;
  if (name == "recursive") return std::make_unique<RecursiveSystem>(bodies);
  throw std::invalid_argument("unknown formulation \"" + name + "\"; choose redundant or recursive");
}

}  // namespace seacrane
