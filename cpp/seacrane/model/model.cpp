#include "seacrane/model/model.hpp"

#include <algorithm>

#include "seacrane/elements/loads/actuator.hpp"

namespace seacrane {

const std::vector<Actuator>& Model::actuators() const { return loads.of<Actuator>(); }

bool Kink::matters(double h, double tolerance, double lost) const {
  const double near = std::min(h, 0.25 * span);
  double power = 1.0, power_near = 1.0;  // h^p / p!
  for (std::size_t p = 0; p < jump.size(); ++p) {
    if (p > 0) {
      power *= h / static_cast<double>(p);
      power_near *= near / static_cast<double>(p);
    }
    if (jump[p] == 0.0 || (p > 1 && lost * h > span)) continue;
    const double worth = h > span ? std::max(jump[p] * power_near, alone[p] * power) : jump[p] * power;
    if (!(worth <= tolerance)) return true;
  }
  return false;
}

}  // namespace seacrane
