#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

void write_vessel_motion(const Output& o, double* out) {
  for (const Vessel& vessel : o.system.model().vessels) {
    const BodyKinematics<double>& k = o.terms.bodies()[idx(vessel.body)];
    view<3>(out) = vessel.displacement(k);
    view<3>(out + 3) = vessel.angles_from_mean(YawFrame<double>(k));
    out += 6;
  }
}

}  // namespace

std::vector<Channel> vessel_channels() {
  return {
      {.name = "vessel_motion",
       .axes = {&axes::vessel, &axes::motion},
       .unit = "m (surge, sway, heave), rad (roll, pitch, yaw)",
       .text = "vessel's reference point from rest, and yaw-pitch-roll angles",
       .peaks = Peaks::of_states,
       .write = write_vessel_motion},
  };
}

}  // namespace seacrane
