#include "seacrane/run/stepped_bodies.hpp"

#include <stdexcept>
#include <utility>

#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/elements/check.hpp"

namespace seacrane {
namespace {

constexpr double kMisplaced = 1e-6;  // m: what is left of projection is below it

}  // namespace

SteppedBodies::SteppedBodies(const std::string& formulation, std::shared_ptr<const Model> model)
    : terms_(std::make_shared<Terms>(std::move(model))),
      described_(terms_),
      stepped_(&described_),
      maximal_(&described_) {
  const Model& full = described_.model();
  if (formulation != "recursive" && formulation != "redundant") {
    throw std::invalid_argument("unknown formulation \"" + formulation + "\"; choose redundant or recursive");
  }
  if (full.merged) {
    terms_ = std::make_shared<Terms>(full.merged);
    terms_->share_wave_knots(described_.terms());
    map_.emplace(full, *full.merged);
    merged_.assign(idx(full.merged->layout.size), 0.0);
    acceleration_.assign(idx(full.body_count()) + 1, Vec6d::Zero());
  }
  if (formulation == "recursive") {
    auto own = std::make_unique<RecursiveSystem>(terms_);
    recursive_ = own.get();
    own_ = std::move(own);
    maximal_ = nullptr;
  } else if (full.merged) {
    auto own = std::make_unique<MaximalSystem>(terms_);
    maximal_ = own.get();
    own_ = std::move(own);
  }
  if (own_) stepped_ = own_.get();
}

long SteppedBodies::dense_solves() const {
  const bool two = maximal_ && maximal_ != &described_;
  return described_.dense_solves() + (two ? maximal_->dense_solves() : 0);
}

const double* SteppedBodies::merged(const double* bodies) {
  if (!map_) return bodies;
  map_->merge(bodies, merged_.data());
  return merged_.data();
}

void SteppedBodies::check_merged(const double* bodies) {
  if (!map_) return;
  const Model& full = described_.model();
  std::vector<double> carried(idx(full.layout.size));
  map_->spread(merged(bodies), carried.data());
  for (int b = 0; b < full.body_count(); ++b) {
    const int at = full.layout.pose(b);
    const double apart = (view<3>(&carried[idx(at)]) - view<3>(bodies + at)).norm();
    if (apart <= kMisplaced) continue;
    throw std::invalid_argument("state: body '" + full.bodies[idx(b)].name + "' is " + to_text(apart) +
                                " m from where it is held: its joints close in another way than when the "
                                "scene was compiled; describe the scene in that pose, or compile it with "
                                "merge=False");
  }
}

void SteppedBodies::read(double t, const double* bodies, double* y) {
  stepped_->read_bodies(t, merged(bodies), y);
}

void SteppedBodies::write(double t, const double* y, double* bodies) {
  if (!map_) return stepped_->write_bodies(t, y, bodies);
  stepped_->write_bodies(t, y, merged_.data());
  map_->spread(merged_.data(), bodies);
}

void SteppedBodies::place(double t, const double* y) {
  stepped_->place_bodies(t, y);
  spread();
}

void SteppedBodies::spread() {
  if (map_) map_->spread_kinematics(terms_->bodies().data(), described_.terms().kinematics());
  described_.terms().follow_yaw();
}

const std::vector<Vec6d>& SteppedBodies::accelerations() {
  if (!map_) return stepped_->accelerations();
  map_->spread_accelerations(*terms_, stepped_->accelerations(), acceleration_);
  return acceleration_;
}

void SteppedBodies::start_histories(double t, const double* bodies, const std::vector<TwistHistory>& saved) {
  if (terms_->histories().empty() && saved.empty()) return;
  MaximalSystem* const maximal = map_ ? maximal_ : &described_;
  if (maximal) {
    seacrane::start_histories(*maximal, t, merged(bodies), saved);
  } else {
    MaximalSystem start(terms_);
    seacrane::start_histories(start, t, merged(bodies), saved);
  }
  share_histories();
}

void SteppedBodies::sample_histories(double t, const double* bodies) {
  seacrane::sample_histories(*terms_, t, merged(bodies));
  share_histories();
}

void SteppedBodies::share_histories() {
  if (map_) described_.terms().histories() = terms_->histories();
}

}  // namespace seacrane
