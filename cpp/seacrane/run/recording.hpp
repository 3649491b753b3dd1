#pragma once

#include <set>
#include <string>
#include <vector>

#include "seacrane/run/channels/registry.hpp"

namespace seacrane {

/// A channel with its shape at an output and its place in a row.
struct RecordedChannel {
  const Channel* channel = nullptr;
  std::vector<std::size_t> shape;
  std::size_t offset = 0, size = 1;
};

/// Rows of the channels asked for, one for each output; memory is taken at construction.
class Recording {
 public:
  Recording(const Model& model, const std::set<std::string>& names, std::size_t capacity);

  const std::vector<RecordedChannel>& channels() const { return channels_; }
  std::size_t width() const { return row_.size(); }
  std::size_t count() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }
  const std::vector<double>& rows() const { return rows_; }
  /// What any of the channels needs.
  const Needs& needs() const { return needs_; }

  void append(const Output& output);
  /// Drops the first `count` rows.
  void drop(std::size_t count);

  /// A channel at the last output; empty where it is not recorded or there has been none.
  std::vector<double> last(const std::string& channel) const;
  /// Takes the values of a channel for those of the last output, as `last` gave them.
  void set_last(const std::string& channel, const std::vector<double>& values);

 private:
  const RecordedChannel* find(const std::string& channel) const;

  std::vector<RecordedChannel> channels_;
  Needs needs_;
  std::vector<double> times_, rows_, row_;
  bool has_last_ = false;  // row_ holds an output
};

}  // namespace seacrane
