#include <algorithm>

#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

bool has_waves(const Model& m) { return !m.wave_loads.empty(); }

bool has_drift(const Model& m) {
  return std::any_of(m.wave_loads.begin(), m.wave_loads.end(),
                     [](const WaveLoad& wave) { return wave.sources.has_drift(); });
}

const WaveComponents& sea_of(const WaveLoadDescription& load) {
  if (load.positioned) return load.positioned->waves();
  return load.exact ? load.exact->waves() : load.table->exact()->waves();
}

/// Calls `function(load, vessel)` for the waves on each loaded vessel.
template <class Function>
void for_each_wave_load(const Output& o, Function&& function) {
  const auto& loads = o.system.model().wave_loads;
  for (std::size_t i = 0; i < loads.size(); ++i) function(o.terms.waves(i), idx(loads[i].vessel));
}

/// The elevation at a vessel; where the waves do not load it, at its place of rest.
void write_wave_elevation(const Output& o, double* out) {
  const Model& m = o.system.model();
  if (m.wave_loads.size() < m.vessels.size()) {
    const WaveComponents& sea = sea_of(m.wave_loads.front().sources);
    for (std::size_t v = 0; v < m.vessels.size(); ++v) {
      const Vec3d& rest = m.vessels[v].mean_position;
      out[v] = sea.elevation(o.time, rest.x(), rest.y());
    }
  }
  for_each_wave_load(o,
                     [&](const WaveForces& waves, std::size_t vessel) { out[vessel] = waves.elevation(); });
}

void write_wave_force(const Output& o, double* out) {
  for_each_wave_load(
      o, [&](const WaveForces& waves, std::size_t vessel) { view<6>(out + 6 * vessel) = waves.force(); });
}

void write_drift_force(const Output& o, double* out) {
  for_each_wave_load(
      o, [&](const WaveForces& waves, std::size_t vessel) { view<6>(out + 6 * vessel) = waves.drift(); });
}

bool has_sea(const Model& m) { return m.sea != nullptr; }

/// What the water does at every named point; in air the elevation alone.
void write_point_wave(const Output& o, double* out) {
  for (const Attachment& at : o.system.model().points) {
    const BodyKinematics<double>& k = o.terms.bodies()[idx(at.body)];
    const Vec3d place = k.position + k.rotation * at.point;
    const SeaField* field = o.terms.sea().field();
    const LocalFlow<double> flow = field ? field->at<double>(o.time, place) : LocalFlow<double>();
    const double wet = place.z() <= flow.elevation ? 1.0 : 0.0;
    out[0] = flow.elevation;
    view<3>(out + 1) = wet * flow.velocity;
    view<3>(out + 4) = wet * flow.acceleration;
    out[7] = wet * flow.pressure;
    out += 8;
  }
}

constexpr const char* kWrench = "N (surge, sway, heave), N m (roll, pitch, yaw)";

}  // namespace

std::vector<Channel> sea_channels() {
  return {
      {.name = "wave_elevation",
       .axes = {&axes::vessel},
       .unit = "m",
       .text = "undisturbed wave elevation where wave loads take their phase",
       .needs = {.loads = true},
       .offered = has_waves,
       .write = write_wave_elevation},
      {.name = "wave_force",
       .axes = {&axes::vessel, &axes::motion},
       .unit = kWrench,
       .text = "wave load on the vessel at its reference point",
       .needs = {.loads = true},
       .offered = has_waves,
       .write = write_wave_force},
      {.name = "drift_force",
       .axes = {&axes::vessel, &axes::motion},
       .unit = kWrench,
       .text = "slow drift load on the vessel at its reference point",
       .needs = {.loads = true},
       .offered = has_drift,
       .write = write_drift_force},
      {.name = "point_wave",
       .axes = {&axes::point, &axes::water},
       .unit = "m (elevation), m/s, m/s2, m2/s2 (dynamic pressure over density)",
       .text = "undisturbed sea at the named point, the current included; in air the elevation alone",
       .by_default = false,
       .offered = has_sea,
       .write = write_point_wave},
  };
}

}  // namespace seacrane
