#pragma once

#include <string>
#include <vector>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// What recording keeps from output to output.
struct RecordHistory {
  double start_energy = 0.0, start_work = 0.0;  // J, where energy_balance is counted from
  double open = 0.0;                // m or rad, largest residual before projection since the last output
  double impact_loss = 0.0;         // J, of limits since the start
  std::vector<double> quaternions;  // of the last output; none: not recorded
};

/// What the values and inputs of a state belong to, one text each: tells the state of another scene.
std::vector<std::string> state_parts(const Model& model);

/// Throws std::invalid_argument that names the first difference.
void check_state_parts(const Model& model, const std::vector<std::string>& given);

}  // namespace seacrane
