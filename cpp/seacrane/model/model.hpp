#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/load_kind.hpp"
#include "seacrane/hydro/hydro_group.hpp"
#include "seacrane/model/block_schur.hpp"
#include "seacrane/model/description.hpp"
#include "seacrane/model/limit.hpp"
#include "seacrane/model/merge.hpp"
#include "seacrane/sea/flow_stencil.hpp"
#include "seacrane/sea/near_sea.hpp"

namespace seacrane {

/// Weight of one body at its centre of mass; z is up.
struct Gravity {
  int body = 0;
  double weight = 0.0;   // N
  Vec3d center_of_mass;  // from the state point, body axes

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    apply(in, T(weight), out);
  }
  /// With another weight in its place, such as one for each lane.
  template <class T>
  void apply(const LoadInput<T>& in, const T& of, LoadSum<T>& out) const {
    const Vec3<T> force(T(0), T(0), -of);
    if (center_of_mass.isZero(0.0)) {
      out.wrench[body].force += force;
      return;
    }
    const Vec3<T> lever = in.bodies[body].rotation * center_of_mass.cast<T>();
    out.wrench[body].add(force, lever);
  }

  double potential(const LoadInput<double>& in) const {
    const auto& k = in.bodies[body];
    return weight * (k.position + k.rotation * center_of_mass).z();
  }
};

/// A time at which one curve of one element is not smooth, and what that is worth. Entry p: jump of a
/// derivative of the velocities' rates, of order p - 1, over the scale of the state where it is largest,
/// 1/s^p; entry 0: of the velocities themselves.
struct Kink {
  double time = 0.0;
  /// Time over which its neighbours in the same curve are apart, s, halved; infinity for the first and last.
  double span = 0.0;
  std::array<double, 4> jump{};
  /// What jumps beyond the mean of the neighbours: little where samples of something smooth stand close.
  std::array<double, 4> alone{};

  /// Whether a step of length h over it may err by more than a tolerance (over the scales): by more than
  /// jump h^p / p!. Of kinks closer than h, a step sees the curve that they follow: then h counts for what is
  /// not their neighbours', and for all of the jump a quarter of their span, which is what is left of them as
  /// a ripple. Where a stop costs `lost` steps, kinks closer than these are left to the step control but for
  /// jumps of velocity or acceleration.
  bool matters(double h, double tolerance, double lost) const;
};

/// How a line lets what hangs on it bounce: the slowest mode in which it is stretched about as much as in
/// any, at the start, of the bodies as they are joined, of all lines as if taut, and of what else holds them
/// along one direction.
struct LineBounce {
  std::string line;
  double mass = 0.0;   // kg, that has the mode's frequency on this line alone; on n falls a mass over n^2
  double omega = 0.0;  // rad/s
  double ratio = 0.0;  // of critical damping, that all lines give the mode
};

struct Actuator;

/// Inertia of a compiled body about its state point: the centre of mass, or, with hydrodynamics, the
/// vessel's reference point, where the 6 x 6 added mass lives.
struct BodyModel {
  std::string name;
  double mass = 0.0;
  Mat3d inertia;  // about the centre of mass, body axes
  Mat3d inverse_inertia;
  Mat3d shape, inverse_shape;  // the inertia by which geometry is judged
  Vec3d center_of_mass;        // from the state point, body axes
  Vec3d state_point;           // from the body origin, body axes
  int vessel = -1;             // index of the vessel element on this body
  bool full = false;           // its mass is a full 6 x 6: a vessel's, or one to which loads add
};

struct ElementModel {
  std::string name, kind;
  int rows = 0, first = 0, second = 0;  // first, second: body indices, ground = body count
  int row = 0;                          // of its multipliers
  bool driver = false, slides = false;
  bool unique_reaction = true;
  Vec3d first_point, second_point;  // from the state points, body axes
};

/// A zero-order-held input of a load.
struct InputModel {
  std::string name;
  int slot = 0, count = 1;  // the first of its slots
};

struct WaveLoad {
  int body = 0;
  int vessel = -1;
  WaveLoadDescription sources;
};

/// Where things stand in the state vector.
struct StateLayout {
  int bodies = 0;
  int pose_size = 7;                                            // 3 + quaternion, or 3 + XYZ Euler angles
  int velocity = 0, memory = 0, loads = 0, work = 0, size = 0;  // loads: their states, behind the memory

  int pose(int body) const { return pose_size * body; }
  int twist(int body) const { return velocity + 6 * body; }
};

/// What compiling found out about the start.
struct AssemblyReport {
  double largest_translation = 0.0, largest_rotation = 0.0;  // of any body, m and rad
  std::string most_moved;
  std::vector<std::pair<std::string, double>> open;  // elements that were, as described, by m or rad
  double residual_before = 0.0, residual_after = 0.0, rate_residual_after = 0.0;
  double velocity_change = 0.0;
  int iterations = 0;
  int rank = 0;
  double condition = 0.0;              // largest S_ii / d_i
  std::vector<std::string> redundant;  // elements whose reactions are not unique
};

/// Immutable: topology, parameters, curves. One Model serves many threads; every run has its own State
/// and workspace.
struct Model {
  SceneDescription description;
  std::vector<BodyModel> bodies;
  std::vector<std::vector<JointData>> joints;  // by joint type, evaluated with one dispatch for each
  std::vector<DriverData> drivers;
  std::vector<ElementModel> elements;  // joints in the order described, then drivers
  BlockSchur schur;
  std::vector<Gravity> gravity;
  CompiledLoads loads;
  std::vector<Vessel> vessels;
  std::vector<HydroGroup> groups;
  std::vector<WaveLoad> wave_loads;
  std::shared_ptr<const SeaField> sea;  // null: still water
  std::vector<FlowStencil> stencils;    // at which loads look at it
  std::shared_ptr<const NearSea> near;  // the sea as short loads see it; null: as all do
  std::vector<CoordinateData> coordinates;
  std::vector<Attachment> points;
  std::vector<InputModel> inputs;      // in the order of their slots
  std::vector<LoadState> load_states;  // in their order in the state
  int slot_count = 0;
  int inertial_tensions = 0;  // places of them
  StateLayout layout;
  double translation_scale = 0.0, rotation_scale = 0.0;  // typical magnitudes, m and rad, rates alike
  std::vector<double> scale;  // typical magnitude per state component; infinity: not in the error norm
  std::vector<Kink> kinks;    // by time
  std::vector<double> initial_state;
  std::vector<LineBounce> line_bounces;
  AssemblyReport assembly;
  bool redundant = false;      // rank of D below its rows
  std::vector<char> left_out;  // of many rows, those that the others hold at assembled poses; empty: none
  bool paper_kinematics = false;
  MergePlan merge;
  std::vector<RigidLink> locked_loops;  // between described bodies, whatever limits hold
  std::shared_ptr<const Model> merged;  // what runs step, with bodies that move as one merged; null: this
  bool merges = true;                   // whether bodies are merged at all
  std::vector<Limit> limits;
  ClosedSet closed = 0;  // limits whose rows this model holds

  /// The group of a vessel; null: it has none.
  const HydroGroup* group_of(int vessel) const {
    for (const HydroGroup& group : groups) {
      if (group.place_of(vessel) >= 0) return &group;
    }
    return nullptr;
  }
  const Model& stepped() const { return merged ? *merged : *this; }
  int body_count() const { return static_cast<int>(bodies.size()); }
  int rows() const { return schur.rows(); }
  const std::vector<Actuator>& actuators() const;
};

}  // namespace seacrane
