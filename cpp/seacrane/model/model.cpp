#include "seacrane/model/model.hpp"

#include "seacrane/elements/loads/actuator.hpp"

namespace seacrane {

const std::vector<Actuator>& Model::actuators() const { return loads.of<Actuator>(); }

}  // namespace seacrane
