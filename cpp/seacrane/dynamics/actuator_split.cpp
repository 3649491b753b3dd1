#include "seacrane/dynamics/actuator_split.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {

std::string missing_fast_part(const Model& model) {
  if (model.paper_kinematics) return "kinematics \"paper\" is not split";
  const auto& actuators = model.actuators();
  const bool any =
      std::ranges::any_of(actuators, [](const Actuator& a) { return a.stiffness > 0.0 || a.damping > 0.0; });
  return any ? "" : "this scene has no actuator with stiffness or damping";
}

std::string RedundantSystem::missing_fast_part() const { return seacrane::missing_fast_part(*model_); }

void RedundantSystem::split(double t, const double* /*y*/) {
  const auto& actuators = model_->actuators();
  const auto bodies = idx(model_->body_count());
  if (split_.empty()) {
    split_.resize(actuators.size());
    for (auto& part : split_) part.response.assign(bodies + 1, Vec6d::Zero());
    split_load_.resize(bodies + 1);
    split_right_.assign(lambda_.size(), 0.0);
    split_multipliers_.resize(lambda_.size());
  }
  for (std::size_t k = 0; k < actuators.size(); ++k) {
    const ActuatorForce now(actuators[k], load_input(t));
    split_[k].force = now.force;
    for (auto& load : split_load_) load.setZero();
    now.add_unit(actuators[k], split_load_.data());
    solve(split_load_, split_right_, split_[k].response, split_multipliers_);
  }
}

void RedundantSystem::fast_derivative(double t, const double* y, double* ydot) {
  const Model& m = *model_;
  read_state(t, y);
  write_pose_rates(y, ydot);
  std::fill_n(ydot + m.layout.velocity, m.layout.size - m.layout.velocity, 0.0);
  for (std::size_t k = 0; k < split_.size(); ++k) {
    const ActuatorForce now(m.actuators()[k], load_input(t));
    const double change = now.force - split_[k].force;
    for (int b = 0; b < m.body_count(); ++b) {
      view<6>(ydot + m.layout.twist(b)) += change * split_[k].response[idx(b)];
    }
    ydot[m.layout.work] += now.power;
    ydot[m.layout.work + 1] += std::abs(now.power);
  }
}

}  // namespace seacrane
