#pragma once

#include <vector>

#include "seacrane/elements/kinematics.hpp"
#include "seacrane/math/dual.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

class Terms;

/// The residual of eq (9), element by element, with accelerations and multipliers held:
///
///   p = load + D^T lambda - M vdot,   s = gamma - D vdot,
///
/// and its slopes in the twelve directions of one body at a time (translation, rotation vector in inertial
/// axes, velocity, angular velocity), by automatic differentiation: loads, rows and vessel are the code of
/// the run with a Dual for a double. Only a load that says so, a C function, is differentiated by central
/// differences. Allocates nothing after construction.
class BodyResidual {
 public:
  static constexpr int kDirections = 12;
  using Scalar = LoadList::Slopes;
  using Slopes = Eigen::Matrix<double, 6, kDirections>;

  /// What does not change; by body, by row, by row, and the memory part of a state.
  struct Held {
    const Vec6d* acceleration;
    const double* multipliers;
    const double* second_multipliers;  // mu, whose D^T mu is wanted as well; may be null
    const double* memory;
  };

  /// Rows of the elements in `counted` only (all elements by default).
  explicit BodyResidual(const Model& model, const std::vector<int>* counted = nullptr);

  /// Goes on from the kinematics, waves and histories that `terms` last evaluated, at t.
  void start(const Terms& terms, double t, const Held& held);
  /// Slopes in the directions of a body, until the next call.
  void differentiate(int body);
  /// Slopes in up to twelve states of loads, from `first` on, in place of a body's directions.
  void differentiate_states(int first);

  /// Slopes of the load p on a body, and of D^T mu.
  Slopes load(int body) const { return slopes(wrench_[idx(body)]); }
  Slopes second_load(int body) const { return slopes(second_wrench_[idx(body)]); }
  /// Bodies on which p may have slopes.
  const std::vector<int>& touched() const { return touched_; }
  /// By row: s, the velocity residual D v - nu and the position residual.
  const std::vector<Scalar>& acceleration_rows() const { return right_; }
  const std::vector<Scalar>& velocity_rows() const { return rate_; }
  const std::vector<Scalar>& position_rows() const { return position_; }
  const LoadSum<Scalar>& sum() const { return sum_; }
  /// Rates of the memory states of the body's vessel.
  const std::vector<Scalar>& memory_rates() const { return memory_rate_; }
  /// Rates of the memory states of the vessel's group.
  const std::vector<Scalar>& group_rates() const { return group_rate_; }
  /// Tensions of quasi-static lines, with accelerations held.
  const std::vector<Scalar>& inertial_tensions() const { return inertial_; }
  /// Rates of the states of all loads.
  const std::vector<Scalar>& state_rates() const { return state_rate_; }

  /// Slopes of the wave load on a vessel, in its yaw frame, over the x, y and yaw where it is taken; and the
  /// sign of its power.
  struct WaveSlopes {
    double over_pose[6][3] = {};
    double direction = 1.0;
  };
  /// The slopes of a vessel whose body has been differentiated.
  const WaveSlopes& wave_slopes(std::size_t vessel) const { return wave_slopes_[vessel]; }

 private:
  static Slopes slopes(const BodyLoad<Scalar>& w);
  LoadInput<Scalar> clear();
  void seed(const BodyKinematics<double>& k, BodyKinematics<Scalar>& out) const;
  BodyLoad<Scalar>& wrench(int body);
  void add_inertia(int body);
  void add_loads(int body, const LoadInput<Scalar>& input);
  void add_load(const LoadList& list, std::size_t i, const LoadInput<Scalar>& input);
  void add_added_inertia(const LoadList& list, std::size_t i, const LoadInput<Scalar>& input);
  void add_differences(const LoadList& list, std::size_t i);
  void add_hydrodynamics(int body, const LoadInput<Scalar>& input);
  void add_coupled_inertia(int vessel);
  void add_group_memory(int vessel);
  void add_waves(int body);
  void add_rows(int body);
  void add_rows(const RowBlock<Scalar>& block, const ElementModel& element);

  const Model* model_;
  const Terms* terms_ = nullptr;
  double t_ = 0.0;
  Held held_{};
  std::vector<char> counted_;  // by element
  std::vector<BodyKinematics<Scalar>> bodies_;
  std::vector<BodyKinematics<double>> moved_;
  std::vector<BodyLoad<Scalar>> wrench_, second_wrench_;
  std::vector<BodyLoad<double>> moved_wrench_;
  std::vector<YawFrame<Scalar>> frames_;  // by vessel, where there are groups
  std::vector<Scalar> right_, rate_, position_, memory_state_, memory_rate_, state_, state_rate_, inertial_;
  std::vector<Scalar> group_rate_;
  std::vector<Mat6<Scalar>> added_;      // by body, inertia of one load
  std::vector<WaveSlopes> wave_slopes_;  // by vessel
  std::vector<int> touched_;
  LoadSum<Scalar> sum_{};
};

}  // namespace seacrane
