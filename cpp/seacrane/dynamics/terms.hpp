#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "seacrane/dynamics/inertia.hpp"
#include "seacrane/hydro/convolution.hpp"
#include "seacrane/hydro/vessel.hpp"
#include "seacrane/math/spd_blocks.hpp"
#include "seacrane/math/types.hpp"
#include "seacrane/model/description.hpp"
#include "seacrane/model/model.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

struct Model;

/// Past motions of the vessels whose fluid memory is a convolution, in their order. They change between steps
/// only.
class VesselHistories {
 public:
  struct History {
    std::size_t vessel, body;
    RunningConvolution memory;
  };

  explicit VesselHistories(const Model& model);

  bool empty() const { return histories_.empty(); }
  auto begin() { return histories_.begin(); }
  auto end() { return histories_.end(); }
  auto begin() const { return histories_.begin(); }
  auto end() const { return histories_.end(); }
  /// The convolution of a vessel; null where its memory has states, or where it has none.
  const RunningConvolution* of(int vessel) const;

  std::vector<TwistHistory> save() const;
  /// Goes on from what was saved. Throws std::invalid_argument for histories of another scene.
  void restore(double t, const std::vector<TwistHistory>& saved);
  /// At rest before t; yaw frames of the vessels and accelerations of the bodies at t.
  void start(double t, const std::vector<YawFrame<double>>& frames, const std::vector<Vec6d>& acceleration);
  /// When the next sample is due: no evaluation may go beyond. Infinity where there are no histories.
  double next_sample() const;
  /// Takes the samples due at t.
  void sample(double t, const std::vector<YawFrame<double>>& frames);

 private:
  std::vector<History> histories_;
};

/// Wave loads on one vessel during one run: the loads last evaluated, in axes that follow its yaw about its
/// reference point, and the scratch of their tables.
class WaveForces {
 public:
  explicit WaveForces(const WaveLoadDescription& sources);

  /// Makes the knots of their tables once for both, where these are the same.
  void share_knots(const WaveForces& other);

  /// `pose`: x, y (m) and yaw (rad) of the vessel.
  void evaluate(double t, const Vec3d& pose);

  /// First order; slow drift; N and N m.
  const Vec6d& force() const { return force_; }
  const Vec6d& drift() const { return drift_; }
  Vec6d sum() const { return force_ + drift_; }
  double elevation() const { return elevation_; }  // m

 private:
  const WaveLoadDescription* sources_;  // of the model, which outlives every run
  std::shared_ptr<WaveTableBlock> block_;
  std::shared_ptr<DriftTableBlock> drift_block_;
  Vec6d force_ = Vec6d::Zero(), drift_ = Vec6d::Zero();
  double elevation_ = 0.0;
};

/// The power of loads: the sum, and the sum of the magnitudes.
struct Power {
  double sum = 0.0, absolute = 0.0;

  void add(double part) {
    sum += part;
    absolute += std::abs(part);
  }
};

/// The terms of the equations of motion of all bodies at one state,
///
///   M vdot = load + D^T lambda,   D vdot = gamma,
///
/// kinematics, inertia, constraint rows and loads: what both formulations, the recorder and the search for
/// events share. Solves nothing. Holds the scratch of one run; the Model stays untouched.
class Terms {
 public:
  explicit Terms(std::shared_ptr<const Model> model);

  const Model& model() const { return *model_; }
  /// Zero-order-held inputs of the loads.
  void set_inputs(const std::vector<double>& slots) { slots_ = slots; }
  /// End of the present smooth stretch of the reference curves, see Curve::at.
  void set_curve_limit(double time) { curve_limit_ = time; }
  double curve_limit() const { return curve_limit_; }
  VesselHistories& histories() { return histories_; }
  const VesselHistories& histories() const { return histories_; }

  /// Poses and twists of a state of the bodies (StateLayout), and the yaw frames of the vessels.
  void read(double t, const double* y);
  /// The kinematics of all bodies (ground last) for a formulation that sets them itself; follow_yaw() then
  /// renews the yaw frames.
  BodyKinematics<double>* kinematics() { return bodies_.data(); }
  void follow_yaw();
  /// `memory`: the memory part of a state, with the states of loads.
  void evaluate_inertia(double t, const double* memory);
  /// What loads add to the masses of bodies, about their state points, inertial axes; empty: nothing ever.
  const std::vector<Mat6d>& evaluate_added_inertia(double t, const double* memory);
  /// The masses that couple bodies, one for each pair; adds their velocity terms to `bias`, by body. The
  /// inverse comes with evaluate_inertia().
  const std::vector<MassCoupling>& evaluate_couplings(Vec6d* bias);
  void evaluate_rows(double t);
  /// Wrenches on the bodies, without velocity terms, and their power; `memory` and its rates: the memory part
  /// of a state, from the fluid's states to those of loads.
  void evaluate_wrenches(double t, const double* memory, double* memory_rate);
  /// Evaluates these loads in place of all that the model has.
  void evaluate_wrenches(double t, const double* memory, double* memory_rate, const CompiledLoads& loads);
  /// All of it at (t, y); of ydot the memory part.
  void evaluate(double t, const double* y, double* ydot);

  // What was evaluated last.
  const std::vector<BodyKinematics<double>>& bodies() const { return bodies_; }
  const std::vector<YawFrame<double>>& frames() const { return frames_; }  // by vessel
  const BodyInertia& inertia(int body) const { return inertia_[idx(body)]; }
  const std::vector<MassCoupling>& couplings() const { return couplings_; }
  /// Of a body with itself.
  Mat6d mass_matrix(int body) const;
  /// The mass matrix without the unsymmetric part of the paper's vessel.
  Mat6d symmetric_mass(int body) const;
  const std::vector<RowBlock<double>>& blocks() const { return blocks_; }
  /// Wrenches less velocity terms.
  const std::vector<Vec6d>& loads() const { return load_; }
  Vec6d wrench(int body) const {
    return (Vec6d() << wrench_[idx(body)].force, wrench_[idx(body)].moment).finished();
  }
  const BodyLoad<double>& applied(int body) const { return wrench_[idx(body)]; }
  const WaveForces& waves(std::size_t load) const { return waves_[load]; }
  const SeaView& sea() const { return sea_; }
  /// For two that evaluate the same wave loads in one run, at about the same times.
  void share_wave_knots(const Terms& other);
  /// x, y and yaw of the vessel where its wave loads are taken; `memory`: the memory part of a state.
  Vec3d wave_pose(const WaveLoad& wave, const double* memory) const;
  /// What loads look at; `memory`: the memory part of a state.
  LoadInput<double> load_input(double t, const double* memory) const {
    return {t,    curve_limit_, bodies_.data(), slots_.data(), memory + first_load_state_, inertial_.data(),
            &sea_};
  }
  /// The power of the loads without potential, drivers included.
  const Power& power() const { return power_; }
  void add_driver_power(double power) { power_.add(power); }
  void add_power(const Power& power) {
    power_.sum += power.sum;
    power_.absolute += power.absolute;
  }
  /// What lines told of theirs as wrenches were evaluated, by place.
  const std::vector<InertialTension>& told() const { return told_; }
  /// Tensions that have been solved for with the accelerations.
  void add_inertial(const VecXd& tension);
  const VecXd& inertial() const { return inertial_; }
  /// Those of the same lines, solved for elsewhere: what loads tell of themselves, and nothing else.
  void set_inertial(const VecXd& tension) { inertial_ = tension; }

 private:
  /// The first load that is not finite at (t, y), by name and value; empty: all are. Evaluates them one by
  /// one, for reports.
  friend std::string non_finite_load(Terms& terms, double t, const double* y);

  void evaluate_loads(double t, const double* y, double* ydot);
  void invert_coupled_masses();
  void apply_hydrodynamics(const LoadInput<double>& input, const double* memory, double* memory_rate,
                           LoadSum<double>& sum);
  void apply_waves(double t, const double* memory, LoadSum<double>& sum);

  std::shared_ptr<const Model> model_;
  int first_load_state_;  // in the memory part of a state
  std::vector<double> slots_;
  VecXd inertial_;  // tensions; zero until they are solved for
  std::vector<InertialTension> told_;
  double curve_limit_ = std::numeric_limits<double>::infinity();
  VesselHistories histories_;
  std::vector<BodyKinematics<double>> bodies_;
  std::vector<YawFrame<double>> frames_;
  std::vector<BodyInertia> inertia_;
  std::vector<MassCoupling> couplings_;        // of all groups in turn, as their pairs
  std::vector<SpdBlocks<double>> group_mass_;  // by group
  std::vector<const LoadList*> adding_inertia_;
  std::vector<Mat6d> added_inertia_;
  std::vector<Mat6d> paper_mass_;  // of the paper's vessels
  std::vector<BodyLoad<double>> wrench_;
  std::vector<Vec6d> bias_, load_;
  std::vector<RowBlock<double>> blocks_;
  std::vector<WaveForces> waves_;
  SeaView sea_;
  Power power_;
};

}  // namespace seacrane
