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

/// Invariants of one row: residuals after projection and the largest before it, the change of mechanical
/// energy minus the work since the start, and the energy lost in impacts until then (J).
struct Kept {
  ConstraintResidual after;
  double before = 0.0, energy_balance = 0.0, impact_loss = 0.0;
};

/// Names of all channels a model offers, the default ones first.
std::vector<std::string> channel_names(const Model& model, bool defaults_only);

/// Rows of the channels asked for, at the times asked for; memory is taken at construction.
class Recording {
 public:
  Recording(const Model& model, const std::set<std::string>& names, std::size_t capacity);
  Recording(Recording&&) = default;  // a copy would write into the row of the original

  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t width() const { return width_; }
  std::size_t count() const { return times_.size(); }
  const std::vector<double>& times() const { return times_; }
  const std::vector<double>& rows() const { return rows_; }

  /// Drops the first `count` rows.
  void drop(std::size_t count);
  /// Quaternions of the last row; none where they are not recorded.
  std::vector<double> last_quaternions() const;
  /// Recorded quaternions keep the sign that they had in such a row.
  void go_on_from(const std::vector<double>& quaternions);

  /// Whether a channel needs accelerations or multipliers, and with them the solution of a row's equations.
  bool wants_solution() const;
  /// Appends the row of (t, y), for which system.derivative() was the last call, or evaluate_terms() where no
  /// solution is wanted.
  void append(double t, const double* y, RedundantSystem& system, const Kept& kept);

 private:
  /// Where channels are in row_; null: not recorded.
  struct Places {
    double *position = nullptr, *velocity = nullptr, *angular_velocity = nullptr, *quaternion = nullptr,
           *euler_xyz = nullptr, *acceleration = nullptr, *angular_acceleration = nullptr,
           *vessel_motion = nullptr, *coordinate = nullptr, *coordinate_rate = nullptr,
           *actuator_force = nullptr, *driver_force = nullptr, *reaction_force = nullptr,
           *reaction_moment = nullptr, *tension = nullptr, *wave_elevation = nullptr, *wave_force = nullptr,
           *drift_force = nullptr, *limit_force = nullptr, *impact_loss = nullptr,
           *constraint_error = nullptr, *constraint_rate_error = nullptr,
           *constraint_error_before_projection = nullptr, *energy_balance = nullptr, *absolute_work = nullptr;
  };

  void write_bodies(RedundantSystem& system);
  void write_quaternions(const RedundantSystem& system);
  void write_vessels(double t, const RedundantSystem& system);
  void write_joint_coordinates(double t, const RedundantSystem& system);
  void write_reactions(const RedundantSystem& system);

  const Model* model_;
  std::vector<Channel> channels_;
  std::size_t width_ = 0;
  std::vector<double> times_, rows_, row_;
  Places at_;
  std::vector<Vec4d> last_quaternion_;
};

}  // namespace seacrane
