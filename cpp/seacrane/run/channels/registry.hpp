#pragma once

#include <string>
#include <vector>

#include "seacrane/run/channels/channel.hpp"

namespace seacrane {

/// Every channel there is, in the order in which results hold them.
const std::vector<Channel>& all_channels();

/// The channels that a scene has.
std::vector<const Channel*> channels_of(const Model& model);

/// Names of those that a scene has.
std::vector<std::string> channel_names(const Model& model, bool defaults_only);

}  // namespace seacrane
