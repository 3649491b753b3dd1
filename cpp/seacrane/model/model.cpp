#include "seacrane/model/model.hpp"

#include "seacrane/elements/loads/registry.hpp"

namespace seacrane {

const std::vector<Actuator>& Model::actuators() const { return std::get<std::vector<Actuator>>(*loads); }

}  // namespace seacrane
