#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "seacrane/run/channels/registry.hpp"

namespace seacrane {

/// A channel with its shape at an output and its place in a row; `least`: that of the least values since the
/// output before, which the largest follow, where they are kept.
struct RecordedChannel {
  const Channel* channel = nullptr;
  std::vector<std::size_t> shape;
  std::size_t offset = 0, size = 1;
  std::optional<std::size_t> least = std::nullopt;

  std::size_t largest() const { return *least + size; }
};

/// Rows of the channels asked for, one for each output; memory is taken at construction.
class Recording {
 public:
  /// `extremes`: those of the channels of which least and largest values between outputs are kept.
  Recording(const Model& model, const std::set<std::string>& names, std::size_t capacity,
            const std::set<std::string>& extremes = {});

  const std::vector<RecordedChannel>& channels() const { return channels_; }
  std::size_t width() const { return row_.size(); }
  std::size_t count() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }
  const std::vector<double>& rows() const { return rows_; }
  /// What any of the channels needs.
  const Needs& needs() const { return needs_; }

  void append(const Output& output);
  /// A value of the run, of the `at`th of a channel, at a time: it counts for the output at that time or
  /// after it.
  void see(const RecordedChannel& channel, std::size_t at, double time, double value);
  /// Appends the least and largest values since the last output, and takes them back; returns what follows.
  void save_pending(std::vector<double>& out) const;
  const double* load_pending(const double* saved);
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
  std::vector<double> times_, rows_;
  std::vector<double> row_;  // the last output, with least and largest values since
  bool has_last_ = false;    // row_ holds an output
};

}  // namespace seacrane
