#include "seacrane/run/held_forces.hpp"

#include <limits>

#include "seacrane/elements/joints/distance.hpp"
#include "seacrane/run/stepper.hpp"

namespace seacrane {
namespace {

constexpr int kLoose = -1, kNotKnown = -2;

}  // namespace

void HeldForces::find(const Stepper& at) {
  if (found_in_ == &at) return;
  found_in_ = &at;
  described_.clear();
  const std::vector<ElementModel>& elements = at.model->elements;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (elements[e].kind == Distance::kind && !elements[e].driver) described_.push_back(static_cast<int>(e));
  }
  links_ = described_.size();
  // Stops that hold are drivers of the compiled model too: those described come first.
  const SceneDescription& scene = at.model->description;
  for (std::size_t d = 0; d < scene.drivers.size(); ++d) {
    described_.push_back(static_cast<int>(scene.joints.size() + d));
  }
  stepped_.clear();
  for (const int e : described_) stepped_.push_back(stepped_element(at, e));
  forces_.resize(described_.size());
}

int HeldForces::stepped_element(const Stepper& at, int described) const {
  const ElementModel& of = at.model->elements[idx(described)];
  const std::vector<ElementModel>& elements = at.stepped_model()->elements;
  const auto found = std::ranges::find_if(
      elements, [&](const ElementModel& e) { return e.name == of.name && e.driver == of.driver; });
  if (found == elements.end()) return kNotKnown;
  return found->rows == 0 ? kLoose : static_cast<int>(found - elements.begin());
}

void HeldForces::read_stepped(const Stepper& at) {
  find(at);
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const int e = stepped_[i];
    forces_[i] = e == kLoose      ? 0.0
                 : e == kNotKnown ? std::numeric_limits<double>::quiet_NaN()
                                  : at.stepped.tension(e);
  }
}

void HeldForces::read_described(const Stepper& at) {
  find(at);
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const ElementModel& e = at.model->elements[idx(described_[i])];
    const double sign = e.driver ? 1.0 : -1.0;
    forces_[i] = e.rows == 0 ? 0.0 : sign * at.system.multipliers()[idx(e.row)];
  }
}

}  // namespace seacrane
