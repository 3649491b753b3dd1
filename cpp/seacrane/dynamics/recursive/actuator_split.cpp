#include "seacrane/dynamics/actuator_split.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/dynamics/recursive/recursive.hpp"

namespace seacrane {

std::string RecursiveSystem::missing_fast_part() const { return seacrane::missing_fast_part(model_); }

void RecursiveSystem::split(double t, const double* /*y*/) {
  const auto& actuators = model_.actuators();
  if (split_.empty()) {
    split_.resize(actuators.size());
    for (auto& part : split_) part.response.resize(idx(tree_.speeds));
  }
  for (std::size_t k = 0; k < actuators.size(); ++k) {
    const ActuatorForce now(actuators[k], terms_.load_input(t));
    split_[k].force = now.force;
    for (auto& load : load_) load.setZero();
    now.add_unit(actuators[k], load_.data());
    double* const response = split_[k].response.data();
    articulated_.solve(load_.data(), false, acceleration_.data(), response);
    if (loops_.rows() == 0) continue;
    // Zero velocities: D a = 0, so gamma is taken off gamma - D a again.
    loops_.acceleration_residual(blocks_.data(), acceleration_.data(), residual_);
    for (auto& a : acceleration_) a.setZero();
    loops_.acceleration_residual(blocks_.data(), acceleration_.data(), loop_bias_);
    residual_ -= loop_bias_;
    loops_.add_load(blocks_.data(), loops_.solve(residual_), load_.data());
    articulated_.solve(load_.data(), false, acceleration_.data(), response);
  }
}

void RecursiveSystem::fast_derivative(double t, const double* y, double* ydot) {
  place(y);
  articulated_.position_rates(y, y + layout_.speeds, terms_.bodies().data(), ydot);
  std::fill_n(ydot + layout_.speeds, layout_.size - layout_.speeds, 0.0);
  for (std::size_t k = 0; k < split_.size(); ++k) {
    const ActuatorForce now(model_.actuators()[k], terms_.load_input(t));
    const double change = now.force - split_[k].force;
    for (int i = 0; i < tree_.speeds; ++i) ydot[layout_.speeds + i] += change * split_[k].response[idx(i)];
    ydot[layout_.work] += now.power;
    ydot[layout_.work + 1] += std::abs(now.power);
  }
}

}  // namespace seacrane
