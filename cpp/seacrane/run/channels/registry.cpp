#include "seacrane/run/channels/registry.hpp"

#include <algorithm>
#include <utility>

namespace seacrane {

// One for each file of this folder: their channels, in the order in which results hold them.
std::vector<Channel> body_channels();
std::vector<Channel> vessel_channels();
std::vector<Channel> joint_channels();
std::vector<Channel> load_channels();
std::vector<Channel> heave_channels();
std::vector<Channel> hydraulic_channels();
std::vector<Channel> sheave_channels();
std::vector<Channel> sea_channels();
std::vector<Channel> water_channels();
std::vector<Channel> contact_channels();
std::vector<Channel> limit_channels();
std::vector<Channel> point_channels();
std::vector<Channel> load_force_channels();
std::vector<Channel> accuracy_channels();

const std::vector<Channel>& all_channels() {
  static const std::vector<Channel> all = [] {
    std::vector<Channel> out;
    for (const auto& channels :
         {body_channels, vessel_channels, joint_channels, load_channels, heave_channels, hydraulic_channels,
          sheave_channels, sea_channels, water_channels, contact_channels, limit_channels, point_channels,
          load_force_channels, accuracy_channels}) {
      for (Channel& channel : channels()) out.push_back(std::move(channel));
    }
    return out;
  }();
  return all;
}

Needs needs_of(const Channel& channel, const Model& model) {
  Needs out = channel.needs;
  out.accelerations |= out.tensions && model.inertial_tensions > 0;
  return out;
}

std::vector<std::size_t> shape_of(const Channel& channel, const Model& model) {
  std::vector<std::size_t> shape;
  for (const Axis* axis : channel.axes) {
    const std::size_t count = labels_of(*axis, model).size();
    if (count != 1 || !axis->only_if_several) shape.push_back(count);
  }
  return shape;
}

std::vector<const Channel*> channels_of(const Model& model) {
  std::vector<const Channel*> out;
  for (const Channel& channel : all_channels()) {
    const bool empty = std::any_of(channel.axes.begin(), channel.axes.end(),
                                   [&](const Axis* axis) { return labels_of(*axis, model).empty(); });
    if (!empty && (channel.offered == nullptr || channel.offered(model))) out.push_back(&channel);
  }
  return out;
}

std::vector<std::string> channel_names(const Model& model, bool defaults_only) {
  std::vector<std::string> names;
  for (const Channel* channel : channels_of(model)) {
    if (channel->by_default || !defaults_only) names.push_back(channel->name);
  }
  return names;
}

}  // namespace seacrane
