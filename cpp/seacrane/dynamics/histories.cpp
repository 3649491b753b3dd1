#include <algorithm>
#include <stdexcept>
#include <string>

#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {

std::vector<TwistHistory> RedundantSystem::histories() const {
  std::vector<TwistHistory> out;
  for (const auto& [vessel, memory] : convolutions_) out.push_back(memory.save());
  return out;
}

void RedundantSystem::start_histories(double t, const double* y, const std::vector<TwistHistory>& histories) {
  if (convolutions_.empty() && histories.empty()) return;
  if (histories.empty()) {
    // The load of the memory is zero here, whatever the start does.
    std::vector<double> rate(size());
    derivative(t, y, rate.data());
    for (auto& [v, memory] : convolutions_) {
      const YawFrame<double>& frame = frames_[v];
      memory.start(t, frame.twist, frame.twist_rate(acceleration_[idx(model_->vessels[v].body)]));
    }
    return;
  }
  if (histories.size() != convolutions_.size()) {
    throw std::invalid_argument("state: has " + std::to_string(histories.size()) +
                                " histories, the model has " + std::to_string(convolutions_.size()) +
                                " vessels with a convolution; give a state of this scene");
  }
  for (std::size_t i = 0; i < histories.size(); ++i) convolutions_[i].second.restore(t, histories[i]);
}

double RedundantSystem::next_sample() const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& [vessel, memory] : convolutions_) next = std::min(next, memory.next());
  return next;
}

void RedundantSystem::sample(double t, const double* y) {
  read_state(t, y);
  for (auto& [v, memory] : convolutions_) {
    if (memory.next() <= t) memory.sample(frames_[v].twist);
  }
}

void RedundantSystem::take_histories(const RedundantSystem& other) {
  for (std::size_t i = 0; i < convolutions_.size(); ++i) {
    convolutions_[i].second = other.convolutions_[i].second;
  }
}

}  // namespace seacrane
