#include "seacrane/run/recording.hpp"

#include <algorithm>
#include <limits>

#include "seacrane/elements/joints/distance.hpp"
#include "seacrane/elements/loads/actuator.hpp"

namespace seacrane {

namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

void widen(double value, double& least, double& largest) {
  if (value < least) least = value;
  if (value > largest) largest = value;
}

}  // namespace

Recording::Recording(const Model& model, const std::set<std::string>& names, std::size_t capacity,
                     const std::set<std::string>& extremes) {
  std::size_t width = 0;
  for (const Channel* channel : channels_of(model)) {
    if (names.count(channel->name) == 0) continue;
    RecordedChannel recorded{channel, shape_of(*channel, model), width};
    for (const std::size_t n : recorded.shape) recorded.size *= n;
    width += recorded.size;
    channels_.push_back(recorded);
    needs_ |= needs_of(*channel, model);
  }
  row_.assign(width, 0.0);
  for (RecordedChannel& c : channels_) {
    if (extremes.count(c.channel->name) == 0 || !has_extremes(*c.channel)) continue;
    c.least = row_.size();
    row_.resize(row_.size() + c.size, kNothing);
    row_.resize(row_.size() + c.size, -kNothing);
  }
  rows_.reserve(row_.size() * capacity);
  times_.reserve(capacity);
}

void Recording::append(const Output& output) {
  for (const RecordedChannel& c : channels_) {
    c.channel->write(output, row_.data() + c.offset);
    for (std::size_t i = 0; c.least && i < c.size; ++i) {
      const double value = row_[c.offset + i];
      widen(value, row_[*c.least + i], row_[c.largest() + i]);
      if (!(row_[*c.least + i] <= row_[c.largest() + i])) row_[*c.least + i] = row_[c.largest() + i] = value;
    }
  }
  has_last_ = true;
  times_.push_back(output.time);
  rows_.insert(rows_.end(), row_.begin(), row_.end());
  for (const RecordedChannel& c : channels_) {
    for (std::size_t i = 0; c.least && i < c.size; ++i) {
      row_[*c.least + i] = kNothing;
      row_[c.largest() + i] = -kNothing;
    }
  }
}

void Recording::see(const RecordedChannel& channel, std::size_t at, double time, double value) {
  double* row = row_.data();
  if (!times_.empty() && time <= times_.back()) {  // a peak is known later than it was
    const auto found = std::ranges::lower_bound(times_, time);
    row = rows_.data() + width() * static_cast<std::size_t>(found - times_.begin());
  }
  widen(value, row[*channel.least + at], row[channel.largest() + at]);
}

void Recording::save_pending(std::vector<double>& out) const {
  for (const RecordedChannel& c : channels_) {
    if (!c.least) continue;
    const auto first = row_.begin() + static_cast<std::ptrdiff_t>(*c.least);
    out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>(2 * c.size));
  }
}

const double* Recording::load_pending(const double* saved) {
  for (const RecordedChannel& c : channels_) {
    if (!c.least) continue;
    std::copy_n(saved, 2 * c.size, row_.data() + *c.least);
    saved += 2 * c.size;
  }
  return saved;
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
