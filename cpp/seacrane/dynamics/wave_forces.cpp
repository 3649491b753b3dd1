#include "seacrane/dynamics/wave_forces.hpp"

namespace seacrane {

WaveForces::WaveForces(const WaveLoadDescription& sources) : sources_(&sources) {
  if (sources.table) block_ = std::make_shared<WaveTableBlock>(sources.table->make_block());
  if (sources.drift_table) {
    drift_block_ = std::make_shared<DriftTableBlock>(sources.drift_table->make_block());
  }
}

void WaveForces::share_knots(const WaveForces& other) {
  if (sources_->table == other.sources_->table) block_ = other.block_;
  if (sources_->drift_table == other.sources_->drift_table) drift_block_ = other.drift_block_;
}

void WaveForces::evaluate(double t, const Vec3d& pose) {
  const WaveLoadDescription& s = *sources_;
  if (s.positioned) {
    PositionedLoad load;
    s.positioned->evaluate(t, pose[0], pose[1], pose[2], load);
    force_ = view<6>(load.force);
    drift_ = view<6>(load.drift);
    elevation_ = load.elevation;
    return;
  }
  double load[wave_channels];
  if (s.table) {
    s.table->evaluate(t, *block_, load);
  } else {
    s.exact->evaluate(t, load);
  }
  force_ = view<6>(load);
  elevation_ = load[6];
  if (s.drift_table) {
    s.drift_table->evaluate(t, *drift_block_, drift_.data());
  } else if (s.drift) {
    s.drift->evaluate(t, drift_.data());
  }
}

}  // namespace seacrane
