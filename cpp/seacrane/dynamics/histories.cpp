#include "seacrane/dynamics/histories.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "seacrane/model/model.hpp"

namespace seacrane {

VesselHistories::VesselHistories(const Model& model) {
  for (std::size_t v = 0; v < model.vessels.size(); ++v) {
    const auto* tables = std::get_if<Convolution>(&model.vessels[v].memory);
    if (tables) histories_.push_back({v, idx(model.vessels[v].body), RunningConvolution(*tables)});
  }
}

const RunningConvolution* VesselHistories::of(int vessel) const {
  for (const History& h : histories_) {
    if (h.vessel == idx(vessel)) return &h.memory;
  }
  return nullptr;
}

std::vector<TwistHistory> VesselHistories::save() const {
  std::vector<TwistHistory> out;
  for (const History& h : histories_) out.push_back(h.memory.save());
  return out;
}

void VesselHistories::restore(double t, const std::vector<TwistHistory>& saved) {
  if (saved.size() != histories_.size()) {
    throw std::invalid_argument("state: has " + std::to_string(saved.size()) + " histories, the model has " +
                                std::to_string(histories_.size()) +
                                " vessels with a convolution; give a state of this scene");
  }
  for (std::size_t i = 0; i < saved.size(); ++i) histories_[i].memory.restore(t, saved[i]);
}

void VesselHistories::start(double t, const std::vector<YawFrame<double>>& frames,
                            const std::vector<Vec6d>& acceleration) {
  for (History& h : histories_) {
    const YawFrame<double>& frame = frames[h.vessel];
    h.memory.start(t, frame.twist, frame.twist_rate(acceleration[h.body]));
  }
}

double VesselHistories::next_sample() const {
  double next = std::numeric_limits<double>::infinity();
  for (const History& h : histories_) next = std::min(next, h.memory.next());
  return next;
}

void VesselHistories::sample(double t, const std::vector<YawFrame<double>>& frames) {
  for (History& h : histories_) {
    if (h.memory.next() <= t) h.memory.sample(frames[h.vessel].twist);
  }
}

}  // namespace seacrane
