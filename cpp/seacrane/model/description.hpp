#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "seacrane/elements/driver.hpp"
#include "seacrane/elements/field.hpp"
#include "seacrane/elements/joint.hpp"
#include "seacrane/elements/loads/load_kind.hpp"
#include "seacrane/hydro/convolution.hpp"
#include "seacrane/hydro/memory.hpp"
#include "seacrane/math/types.hpp"
#include "seacrane/sea/wave_load.hpp"

/// What the user writes, one value type per kind of element. Names refer to other elements; "ground"
/// is the inertial frame. Scenes are checked as a whole before they are compiled.

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
  Vec3d size = Vec3d::Zero();  // of the box that it is, about the centre of mass; zero: not told

  static constexpr const char* type = "Body";
  static constexpr const char* text =
      "A rigid body: inertia about the centre of mass in body axes, pose of the body origin in the inertial "
      "frame, quaternion (w, x, y, z) body to inertial.";
  static constexpr auto fields() {
    using D = BodyDescription;
    return std::tuple(
        required("mass", &D::mass, "kg", "").positive(),
        required("inertia", &D::inertia, "kg m2", "about the centre of mass, body axes"),
        optional("center_of_mass", &D::center_of_mass, "m", "body axes").usually(0.0, 500.0),
        optional("position", &D::position, "m", "of the body origin, inertial frame").usually(0.0, 2e4),
        optional("quaternion", &D::quaternion, "", "w, x, y, z: body to inertial"),
        optional("velocity", &D::velocity, "m/s", "of the body origin, inertial frame").usually(0.0, 100.0),
        optional("angular_velocity", &D::angular_velocity, "rad/s", "inertial frame").usually(0.0, 100.0),
        optional("gravity", &D::gravity, "", "whether weight acts on it"),
        optional("size", &D::size, "m", "edges of the box that it is, about its centre of mass, body axes")
            .usually(1e-3, 500.0));
  }
};

inline constexpr double kNoStop = kFarthest;  // m or rad: a bound here or beyond is none

/// Contact that only pushes, or a wire that only pulls:
///   wire   a distance joint that holds only while it is stretched
///   stop   bounds on a joint coordinate
///   seat   a weld that holds only while it is pressed along z of its first frame; let go, it stays open
struct LimitDescription {
  std::string name, kind;
  CoordinateDescription coordinate;              // of a stop; wires and seats name the joint alone
  double minimum = -kNoStop, maximum = kNoStop;  // of a stop
  double restitution = 0.0;
  double sticking_speed = 1e-3;  // m/s or rad/s: approaches below it don't rebound

  static constexpr const char* type = "Limit";
  static constexpr const char* text = "What a joint does one way only; see Scene.add_line and add_stop.";
  static constexpr auto fields() {
    using D = LimitDescription;
    return std::tuple_cat(
        std::tuple(required("kind", &D::kind, "", "wire, stop or seat")), on_coordinate<D>(false),
        std::tuple(
            optional("minimum", &D::minimum, "m or rad", "at -1e7 there is none").usually(0.0, 500.0),
            optional("maximum", &D::maximum, "m or rad", "at 1e7 there is none").usually(0.0, 500.0),
            optional("restitution", &D::restitution, "", "0 to 1").within(0.0, 1.0),
            optional("sticking_speed", &D::sticking_speed, "m/s or rad/s", "slower impacts do not rebound")
                .not_negative()
                .usually(1e-6, 0.5)));
  }
};

/// A point of a body, recorded by its name.
struct PointDescription {
  std::string name, body;
  Vec3d point = Vec3d::Zero();

  static constexpr const char* type = "Point";
  static constexpr const char* text = "A point of a body, whose motion is recorded.";
  static constexpr auto fields() {
    using D = PointDescription;
    return std::tuple(on_body("body", &D::body),
                      optional("point", &D::point, "m", "coordinates of the body"));
  }
};

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
