#pragma once

#include "seacrane/run/channels/channel.hpp"

namespace seacrane::axes {

extern const Axis xyz, wxyz, motion, water;
extern const Axis body, vessel, joint, joint_coordinate, actuator, driver, link, limit, point, load;

}  // namespace seacrane::axes
