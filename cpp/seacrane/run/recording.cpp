#include "seacrane/run/recording.hpp"

#include <algorithm>

#include "seacrane/dynamics/limit_force.hpp"
#include "seacrane/elements/joints/distance.hpp"
#include "seacrane/elements/loads/actuator.hpp"

namespace seacrane {

Recording::Recording(const Model& model, const std::set<std::string>& names, std::size_t capacity) {
  std::size_t width = 0;
  for (const Channel* channel : channels_of(model)) {
    if (names.count(channel->name) == 0) continue;
    RecordedChannel recorded{channel, shape_of(*channel, model), width};
    for (const std::size_t n : recorded.shape) recorded.size *= n;
    width += recorded.size;
    channels_.push_back(recorded);
    needs_.residual |= channel->needs.residual;
    needs_.loads |= channel->needs.loads;
    needs_.energy |= channel->needs.energy;
    needs_.solution |= channel->needs.solution;
    needs_.reactions |= channel->needs.reactions;
    needs_.coordinates |= channel->needs.coordinates;
  }
  row_.assign(width, 0.0);
  rows_.reserve(width * capacity);
  times_.reserve(capacity);
}

void Recording::append(const Output& output) {
  for (const RecordedChannel& c : channels_) c.channel->write(output, row_.data() + c.offset);
  has_last_ = true;
  times_.push_back(output.time);
  rows_.insert(rows_.end(), row_.begin(), row_.end());
}

void Recording::drop(std::size_t count) {
  count = std::min(count, times_.size());
  times_.erase(times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(count));
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(count * width()));
}

const RecordedChannel* Recording::find(const std::string& channel) const {
  for (const RecordedChannel& c : channels_) {
    if (c.channel->name == channel) return &c;
  }
  return nullptr;
}

std::vector<double> Recording::last(const std::string& channel) const {
  const RecordedChannel* const c = find(channel);
  if (c == nullptr || !has_last_) return {};
  const double* const values = row_.data() + c->offset;
  return {values, values + c->size};
}

void Recording::set_last(const std::string& channel, const std::vector<double>& values) {
  const RecordedChannel* const c = find(channel);
  if (c == nullptr || values.size() != c->size) return;
  std::copy(values.begin(), values.end(), row_.begin() + static_cast<std::ptrdiff_t>(c->offset));
  has_last_ = true;
}

}  // namespace seacrane
