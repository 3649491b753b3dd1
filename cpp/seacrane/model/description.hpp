#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "seacrane/dynamics/loads/registry.hpp"
#include "seacrane/hydro/convolution.hpp"
#include "seacrane/hydro/memory.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/types.hpp"
#include "seacrane/model/limit.hpp"
#include "seacrane/sea/wave_load.hpp"

/// What the user writes, one value type per kind of element. Names refer to other elements; "ground"
/// is the inertial frame. Every description is checked by its own validate().
namespace seacrane {

struct BodyDescription {
  std::string name;
  double mass = 0.0;
  Mat3d inertia = Mat3d::Zero();           // about the centre of mass, body axes
  Vec3d center_of_mass = Vec3d::Zero();    // from the body origin, body axes
  Vec3d position = Vec3d::Zero();          // of the body origin, inertial frame
  Vec4d quaternion = {1, 0, 0, 0};         // body to inertial
  Vec3d velocity = Vec3d::Zero();          // of the body origin, inertial frame
  Vec3d angular_velocity = Vec3d::Zero();  // inertial frame
  bool gravity = true;
};

/// A joint frame on a body: a point and axes in body coordinates; the joint axis is z.
struct Frame {
  Vec3d point = Vec3d::Zero();
  Mat3d axes = Mat3d::Identity();
};

struct JointDescription {
  std::string name, kind, first, second;
  Frame first_frame, second_frame;
  double length = 0.0;  // of a distance joint
  bool open = false;    // holds nothing now: a limit that is not reached, see limit.hpp
};

struct DriverDescription {
  std::string name;
  CoordinateDescription coordinate;
  Curve curve;
};

enum class VesselKinematics { yaw_following, paper };

/// Linear hydrodynamics of a vessel about its body origin (the reference point), see DESIGN "Vessel".
struct VesselDescription {
  std::string name, body;
  Mat6d added_mass = Mat6d::Zero();
  Mat6d linear_damping = Mat6d::Zero();
  Vec6d quadratic_damping = Vec6d::Zero();
  Mat6d restoring = Mat6d::Zero();          // heave, roll, pitch block only
  Vec3d mooring_stiffness = Vec3d::Zero();  // surge, sway (N/m), yaw (N m/rad), about the start
  Vec3d mooring_damping = Vec3d::Zero();
  std::variant<std::vector<StateSpaceBlock>, RetardationFunctions> memory;
  VesselKinematics kinematics = VesselKinematics::yaw_following;
};

/// Loads at the mean position as exact sums, or from tables of them where set; or at the actual position,
/// which replaces all others.
struct WaveLoadDescription {
  std::string name, body;
  std::shared_ptr<const ExactWaveLoad> exact;
  std::shared_ptr<const WaveTable> table;
  std::shared_ptr<const DriftLoad> drift;
  std::shared_ptr<const DriftTable> drift_table;
  std::shared_ptr<const PositionedWaveLoad> positioned;

  bool has_drift() const { return positioned ? positioned->has_drift() : drift || drift_table; }
};

enum class Orientation { quaternion, euler_xyz };

struct SceneDescription {
  std::string name = "scene";
  double gravity = 9.80665;
  Orientation orientation = Orientation::quaternion;
  double baumgarte = 0.0;     // 1/s, critically damped; 0: none
  double length_scale = 1.0;  // m: scales absolute tolerances
  std::vector<BodyDescription> bodies;
  std::vector<JointDescription> joints;
  std::vector<DriverDescription> drivers;
  LoadDescriptions loads;
  std::vector<VesselDescription> vessels;
  std::vector<WaveLoadDescription> wave_loads;
  std::vector<CoordinateDescription> coordinates;  // joint coordinates to record
  std::vector<LimitDescription> limits;

  /// Descriptions of one kind of load, such as loads_of<PointForce>().
  template <class Load>
  std::vector<typename Load::Description>& loads_of() {
    return std::get<std::vector<typename Load::Description>>(loads);
  }
};

}  // namespace seacrane
