#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "seacrane/elements/body.hpp"
#include "seacrane/elements/driver.hpp"
#include "seacrane/elements/joint.hpp"
#include "seacrane/elements/limit.hpp"
#include "seacrane/elements/loads/load_kind.hpp"
#include "seacrane/elements/point.hpp"
#include "seacrane/hydro/convolution.hpp"
#include "seacrane/hydro/memory.hpp"
#include "seacrane/math/types.hpp"
#include "seacrane/sea/wave_load.hpp"

/// What the user writes, one value type per kind of element. Names refer to other elements; "ground"
/// is the inertial frame. Scenes are checked as a whole before they are compiled.
namespace seacrane {

class SeaField;

/// A joint coordinate to record.
struct RecordedCoordinate : CoordinateDescription {
  std::string name = "";  // empty: that of the joint
};

enum class VesselKinematics { yaw_following, paper };

/// Linear hydrodynamics of a vessel about its body origin (the reference point), see docs/algorithms.md.
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
  bool floats = true;  // `restoring` carries the body's weight; else it weighs as any other

  static constexpr const char* type = "VesselHydrodynamics";
  static constexpr const char* text =
      "Linear hydrodynamics of a body about its origin (the reference point).";
  static constexpr auto fields() {
    using D = VesselDescription;
    return std::tuple(
        on_body("body", &D::body), optional("added_mass", &D::added_mass, "kg, kg m, kg m2", ""),
        optional("linear_damping", &D::linear_damping, "N s/m, N s, N m s", ""),
        optional("quadratic_damping", &D::quadratic_damping, "N s2/m2, N m s2", "").not_negative(),
        optional("restoring", &D::restoring, "N/m, N, N m", "of heave, roll and pitch alone"),
        optional("mooring_stiffness", &D::mooring_stiffness, "N/m, N m/rad", "of surge, sway, yaw")
            .not_negative(),
        optional("mooring_damping", &D::mooring_damping, "N s/m, N m s/rad", "of surge, sway, yaw")
            .not_negative(),
        optional("memory", &D::memory, "", "blocks of states, or retardation functions"),
        optional("kinematics", &D::kinematics, "", "yaw_following, or paper: eqs (17)-(31)"),
        optional("floats", &D::floats, "", "whether `restoring` holds weight and buoyancy; else it weighs"));
  }
};

/// Vessels that load each other through the water, over six motions of each in turn, each in its own yaw
/// frame: what adds to the hydrodynamics that each has by itself.
struct HydroGroupDescription {
  std::string name;
  std::vector<std::string> vessels;
  MatXd added_mass = MatXd();  // (6n, 6n), zero of each with itself; empty: none
  std::vector<StateSpaceBlock> memory;

  static constexpr const char* type = "GroupHydrodynamics";
  static constexpr const char* text =
      "Vessels that load each other through the water, over six motions of each in turn.";
  static constexpr auto fields() {
    using D = HydroGroupDescription;
    return std::tuple(required("vessels", &D::vessels, "",
                               "two or more, whose own memory is empty where the group has one"),
                      optional("added_mass", &D::added_mass, "kg, kg m, kg m2",
                               "(6n, 6n) between vessels, zero of each with itself; empty: none"),
                      optional("memory", &D::memory, "", "blocks of states over all motions"));
  }
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
  std::vector<HydroGroupDescription> groups;
  std::vector<WaveLoadDescription> wave_loads;
  std::shared_ptr<const SeaField> sea;  // null: still water
  std::vector<RecordedCoordinate> coordinates;
  std::vector<PointDescription> points;
  std::vector<LimitDescription> limits;
};

/// A vessel with the paper's kinematics, whose mass is not symmetric; null: none has them.
inline const VesselDescription* paper_vessel(const SceneDescription& scene) {
  const auto found =
      std::ranges::find(scene.vessels, VesselKinematics::paper, &VesselDescription::kinematics);
  return found == scene.vessels.end() ? nullptr : &*found;
}

}  // namespace seacrane
