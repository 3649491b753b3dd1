#pragma once

#include <set>
#include <string>
#include <vector>

#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {

/// One recorded quantity: its name, its shape per instant and its place in a row.
struct Channel {
  std::string name;
  std::vector<std::size_t> shape;
  std::size_t offset = 0, size = 1;
};

/// Names of all channels a model offers, the default ones first.
std::vector<std::string> channel_names(const Model& model, bool defaults_only);

/// Rows of the channels asked for, at the times asked for; memory is taken at construction.
class Recording {
 public:
  Recording(const Model& model, const std::set<std::string>& names, std::size_t capacity);

  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t width() const { return width_; }
  std::size_t count() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }
  const std::vector<double>& rows() const { return rows_; }

  /// Appends the row of (t, y), for which system.derivative() was the last call. `energy_balance` is the
  /// change of mechanical energy minus the work done since the start.
  void append(double t, const double* y, RedundantSystem& system, const ConstraintResidual& after,
              double before, double energy_balance);

 private:
  double* slot(const char* name);
  void write_bodies(RedundantSystem& system);
  void write_quaternions(const RedundantSystem& system);
  void write_vessel(const RedundantSystem& system);
  void write_joint_coordinates(double t, const RedundantSystem& system);
  void write_reactions(const RedundantSystem& system);

  const Model* model_;
  std::vector<Channel> channels_;
  std::size_t width_ = 0;
  std::vector<double> times_, rows_, row_;
  std::vector<Vec4d> last_quaternion_;
};

}  // namespace seacrane
