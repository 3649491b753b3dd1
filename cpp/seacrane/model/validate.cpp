#include "seacrane/model/validate.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "seacrane/dynamics/joints/registry.hpp"

namespace seacrane {

std::string to_text(double value) {
  std::ostringstream out;
  out.precision(6);
  out << value;
  return out.str();
}

namespace {

constexpr double kFarthest = 1e7;  // m

/// Checks of one named element; every failure reads "<kind> '<name>': <what>".
class Check {
 public:
  Check(std::string kind, const std::string& name) : prefix_(std::move(kind) + " '" + name + "': ") {
    if (name.empty()) fail("the name is empty; give every element a name");
  }

  [[noreturn]] void fail(const std::string& what) const { throw SceneError(prefix_ + what); }

  void finite(const char* what, double v) const {
    if (!std::isfinite(v)) fail(std::string(what) + " is " + to_text(v) + "; give a finite number");
  }
  template <class Derived>
  void finite(const char* what, const Eigen::MatrixBase<Derived>& m) const {
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      for (Eigen::Index j = 0; j < m.cols(); ++j) {
        if (!std::isfinite(m(i, j))) {
          fail(std::string(what) + " holds " + to_text(m(i, j)) + " at (" + std::to_string(i) + ", " +
               std::to_string(j) + "); give finite numbers");
        }
      }
    }
  }
  /// The flat frame and its resolution in double precision both end long before this.
  void near(const char* what, const Vec3d& point) const {
    finite(what, point);
    if (!(point.cwiseAbs().maxCoeff() <= kFarthest)) {
      fail(std::string(what) + " holds " + to_text(point.cwiseAbs().maxCoeff()) +
           " m; give metres, at most " + to_text(kFarthest));
    }
  }
  void not_negative(const char* what, double v) const {
    finite(what, v);
    if (v < 0.0) fail(std::string(what) + " is " + to_text(v) + "; it must not be negative");
  }
  void body(const std::set<std::string>& bodies, const std::string& name, bool ground_allowed) const {
    if (ground_allowed && name == kGround) return;
    if (bodies.count(name) == 0) fail("there is no body '" + name + "'; add it first");
  }
  void positive_definite(const char* what, const MatXd& m, bool semi) const {
    finite(what, m);
    const double size = m.cwiseAbs().maxCoeff();
    if ((m - m.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size) {
      fail(std::string(what) + " is not symmetric; give a symmetric matrix");
    }
    const double smallest = Eigen::SelfAdjointEigenSolver<MatXd>(m).eigenvalues()[0];
    if (semi ? smallest < -1e-9 * size : !(smallest > 0.0)) {
      fail(std::string(what) + " is not positive " + (semi ? "semi-" : "") +
           "definite: its smallest eigenvalue is " + to_text(smallest));
    }
  }

 private:
  std::string prefix_;
};

void check_body(const BodyDescription& b) {
  const Check c("body", b.name);
  if (b.name == kGround) c.fail("'ground' is the inertial frame; choose another name");
  c.finite("mass", b.mass);
  if (!(b.mass > 0.0)) c.fail("mass is " + to_text(b.mass) + " kg; it must be positive");
  c.positive_definite("inertia", b.inertia, false);
  const Vec3d moments = Eigen::SelfAdjointEigenSolver<Mat3d>(b.inertia).eigenvalues();
  if (moments[2] > (moments[0] + moments[1]) * (1.0 + 1e-6)) {
    c.fail("inertia has principal moments " + to_text(moments[0]) + ", " + to_text(moments[1]) + ", " +
           to_text(moments[2]) +
           " kg m2, the largest above the sum of the others: no mass distribution has that");
  }
  if (!std::isfinite(1.0 / b.mass) || !std::isfinite(1.0 / moments[0]) ||
      !std::isfinite(b.mass * kFarthest * kFarthest)) {
    c.fail("mass " + to_text(b.mass) + " kg or smallest principal moment " + to_text(moments[0]) +
           " kg m2 is beyond what numbers resolve; correct its units");
  }
  c.near("center_of_mass", b.center_of_mass);
  c.near("position", b.position);
  c.finite("quaternion", b.quaternion);
  if (std::abs(b.quaternion.norm() - 1.0) > 1e-6) {
    c.fail("quaternion has length " + to_text(b.quaternion.norm()) + "; normalise it");
  }
  c.finite("velocity", b.velocity);
  c.finite("angular_velocity", b.angular_velocity);
}

bool known_kind(const std::string& kind, std::string& all) {
  bool known = false;
  for_each_joint_type([&]<class Type>(std::size_t) {
    known = known || kind == Type::kind;
    all += std::string(all.empty() ? "" : " ") + Type::kind;
  });
  return known;
}

void check_frame(const Check& c, const char* what, const Frame& f) {
  c.near(what, f.point);
  c.finite(what, f.axes);
  if ((f.axes.transpose() * f.axes - Mat3d::Identity()).norm() > 1e-6 || f.axes.determinant() < 0.0) {
    c.fail(std::string(what) + ": axes are not a right-handed orthonormal set");
  }
}

void check_joint(const JointDescription& j, const std::set<std::string>& bodies) {
  const Check c("joint", j.name);
  std::string all;
  if (!known_kind(j.kind, all)) c.fail("kind '" + j.kind + "' is unknown; the kinds are: " + all);
  c.body(bodies, j.first, true);
  c.body(bodies, j.second, true);
  if (j.first == j.second) c.fail("joins '" + j.first + "' to itself; name two different bodies");
  check_frame(c, "first_frame", j.first_frame);
  check_frame(c, "second_frame", j.second_frame);
  c.finite("length", j.length);
  if (j.kind == Distance::kind && !(j.length > 0.0)) {
    c.fail("length is " + to_text(j.length) + " m; a distance joint needs a positive length");
  }
}

void check_coordinate(const Check& c, const CoordinateDescription& d,
                      const std::map<std::string, std::string>& joints) {
  static const std::map<std::string, std::set<std::string>> offered = {
      {"revolute", {"angle"}},
      {"prismatic", {"displacement"}},
      {"cylindrical", {"angle", "displacement"}},
      {"free", {"x", "y", "z", "roll", "pitch", "yaw"}}};
  const auto joint = joints.find(d.joint);
  if (joint == joints.end()) c.fail("there is no joint '" + d.joint + "'; add it first");
  const auto kind = offered.find(joint->second);
  if (kind == offered.end()) {
    c.fail("joint '" + d.joint + "' is " + joint->second + " and offers no coordinate");
  }
  if (kind->second.count(d.coordinate) == 0) {
    std::string all;
    for (const auto& name : kind->second) all += " " + name;
    c.fail("joint '" + d.joint + "' has no coordinate '" + d.coordinate + "'; it offers:" + all);
  }
}

void check_spring(const SpringDescription& s, const std::set<std::string>& bodies) {
  const Check c("spring", s.name);
  c.body(bodies, s.first, true);
  c.body(bodies, s.second, true);
  if (s.first == s.second) c.fail("joins '" + s.first + "' to itself; name two different bodies");
  c.near("first_point", s.first_point);
  c.near("second_point", s.second_point);
  c.not_negative("stiffness", s.stiffness);
  c.not_negative("damping", s.damping);
  c.not_negative("natural_length", s.natural_length);
  if (s.lengths.size() != s.forces.size() || s.lengths.size() == 1) {
    c.fail("the table has " + std::to_string(s.lengths.size()) + " lengths and " +
           std::to_string(s.forces.size()) + " forces; give at least two of each");
  }
  for (std::size_t i = 0; i < s.lengths.size(); ++i) {
    c.finite("lengths", s.lengths[i]);
    c.finite("forces", s.forces[i]);
    if (i > 0 && !(s.lengths[i] > s.lengths[i - 1])) c.fail("lengths must increase");
  }
}

void check_force_table(const ForceTableDescription& f, const std::set<std::string>& bodies) {
  const Check c("force table", f.name);
  c.body(bodies, f.body, false);
  c.near("point", f.point);
  if (f.times.empty() || f.times.size() != f.wrenches.size()) {
    c.fail("has " + std::to_string(f.times.size()) + " times and " + std::to_string(f.wrenches.size()) +
           " wrenches; give as many of both");
  }
  for (std::size_t i = 0; i < f.times.size(); ++i) {
    c.finite("times", f.times[i]);
    c.finite("wrenches", f.wrenches[i]);
    if (i > 0 && !(f.times[i] > f.times[i - 1])) c.fail("times must increase");
  }
}

void check_vessel(const VesselDescription& v, const std::set<std::string>& bodies) {
  const Check c("vessel", v.name);
  c.body(bodies, v.body, false);
  c.positive_definite("added_mass", v.added_mass, true);
  c.finite("linear_damping", v.linear_damping);
  for (int i = 0; i < 6; ++i) c.not_negative("quadratic_damping", v.quadratic_damping[i]);
  c.finite("restoring", v.restoring);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const bool allowed = i >= 2 && i <= 4 && j >= 2 && j <= 4;
      if (!allowed && v.restoring(i, j) != 0.0) {
        c.fail("restoring(" + std::to_string(i) + ", " + std::to_string(j) + ") is " +
               to_text(v.restoring(i, j)) + "; only heave, roll and pitch restore, use mooring for the rest");
      }
    }
  }
  if ((v.restoring - v.restoring.transpose()).cwiseAbs().maxCoeff() >
      1e-6 * v.restoring.cwiseAbs().maxCoeff()) {
    c.fail("restoring is not symmetric; a conservative restoring load has a symmetric matrix");
  }
  for (int i = 0; i < 3; ++i) {
    c.not_negative("mooring_stiffness", v.mooring_stiffness[i]);
    c.not_negative("mooring_damping", v.mooring_damping[i]);
  }
}

void unique_names(const std::string& kind, const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const auto& name : names) {
    if (!seen.insert(name).second) {
      throw SceneError(kind + " '" + name + "': the name is used twice; names of a kind must differ");
    }
  }
}

template <class Elements>
void unique_names(const std::string& kind, const Elements& elements) {
  std::vector<std::string> names;
  for (const auto& e : elements) names.push_back(e.name);
  unique_names(kind, names);
}

void check_drives(const SceneDescription& scene, const std::map<std::string, std::string>& joints) {
  std::map<std::string, std::string> driven;
  for (const auto& d : scene.drivers) {
    const Check c("driver", d.name);
    check_coordinate(c, d.coordinate, joints);
    const auto [other, fresh] = driven.insert({d.coordinate.joint + "." + d.coordinate.coordinate, d.name});
    if (!fresh) {
      c.fail("prescribes " + other->first + ", which driver '" + other->second + "' prescribes already");
    }
  }
  for (const auto& a : scene.actuators) {
    const Check c("actuator", a.name);
    check_coordinate(c, a.coordinate, joints);
    c.not_negative("stiffness", a.stiffness);
    c.not_negative("damping", a.damping);
  }
  for (const auto& d : scene.coordinates) check_coordinate(Check("recorded coordinate", d.joint), d, joints);
}

void check_loads(const SceneDescription& scene, const std::set<std::string>& bodies) {
  std::set<std::string> actuators;
  for (const auto& a : scene.actuators) actuators.insert(a.name);
  for (const auto& f : scene.point_forces) {
    const Check c("point force", f.name);
    if (actuators.count(f.name)) {
      c.fail("an actuator has this name too, and both would take the input '" + f.name +
             ".force'; rename one");
    }
    c.body(bodies, f.body, false);
    c.near("point", f.point);
    c.finite("force", f.force);
  }
  for (const auto& s : scene.springs) check_spring(s, bodies);
  for (const auto& f : scene.force_tables) check_force_table(f, bodies);
  for (const auto& f : scene.function_forces) {
    const Check c("function force", f.name);
    c.body(bodies, f.body, false);
    if (f.function == nullptr) c.fail("the function's address is 0; pass a C function pointer");
  }
  std::set<std::string> floating;
  for (const auto& v : scene.vessels) {
    check_vessel(v, bodies);
    if (!floating.insert(v.body).second)
      Check("vessel", v.name).fail("body '" + v.body + "' is a vessel already");
    if (v.kinematics != scene.vessels.front().kinematics) {
      Check("vessel", v.name).fail("kinematics differ from those of '" + scene.vessels.front().name + "'");
    }
  }
  for (const auto& w : scene.wave_loads) {
    const Check c("wave load", w.name);
    if (floating.count(w.body) == 0) c.fail("body '" + w.body + "' is not a vessel; add its hydrodynamics");
    if (!w.exact && !w.table) c.fail("has no wave components");
  }
}

}  // namespace

void validate(const SceneDescription& scene) {
  const Check c("scene", scene.name);
  c.finite("gravity", scene.gravity);
  c.not_negative("baumgarte", scene.baumgarte);
  if (!(scene.length_scale > 0.0) || !std::isfinite(scene.length_scale)) {
    c.fail("length_scale is " + to_text(scene.length_scale) + " m; make it positive and finite");
  }
  if (scene.bodies.empty()) c.fail("has no bodies; add at least one");
  unique_names("body", scene.bodies);
  unique_names("joint", scene.joints);
  unique_names("driver", scene.drivers);
  unique_names("actuator", scene.actuators);
  unique_names("point force", scene.point_forces);
  unique_names("spring", scene.springs);
  unique_names("force table", scene.force_tables);
  unique_names("function force", scene.function_forces);
  unique_names("vessel", scene.vessels);
  unique_names("wave load", scene.wave_loads);
  std::set<std::string> bodies;
  for (const auto& b : scene.bodies) {
    check_body(b);
    bodies.insert(b.name);
  }
  std::map<std::string, std::string> joints;
  for (const auto& j : scene.joints) {
    check_joint(j, bodies);
    joints[j.name] = j.kind;
  }
  check_drives(scene, joints);
  check_loads(scene, bodies);
}

}  // namespace seacrane
