#include "seacrane/model/validate.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "seacrane/elements/joints/joint_kinds.hpp"
#include "seacrane/hydro/hydro_group.hpp"
#include "seacrane/model/limit.hpp"

namespace seacrane {

namespace {

void check_body(const BodyDescription& b) {
  const Check c("body", b.name);
  if (b.name == kGround) c.fail("'ground' is the inertial frame; choose another name");
  check_fields(b, c);
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
  if (std::abs(b.quaternion.norm() - 1.0) > 1e-6) {
    c.fail("quaternion has length " + to_text(b.quaternion.norm()) + "; normalise it");
  }
  if (!b.size.isZero(0.0) && !(b.size.minCoeff() > 0.0)) {
    c.fail("size is (" + to_text(b.size[0]) + ", " + to_text(b.size[1]) + ", " + to_text(b.size[2]) +
           ") m; give three edges above zero, or none");
  }
}

void check_frame(const Check& c, const char* what, const Frame& f) {
  c.near(what, f.point);
  c.finite(what, f.axes);
  if ((f.axes.transpose() * f.axes - Mat3d::Identity()).norm() > 1e-6 || f.axes.determinant() < 0.0) {
    c.fail(std::string(what) + ": axes are not a right-handed orthonormal set");
  }
}

void check_parameters(const Check& c, const JointDescription& j, const JointKind& kind) {
  const std::string needs = "; a " + kind.name + " joint needs ";
  for (const JointKind::Parameter& p : kind.parameters) {
    const std::string name = p.name;
    const auto given = j.parameters.find(name);
    if (given == j.parameters.end() && p.required) c.fail("has no " + name + needs + "one, in " + p.unit);
    c.number(name, given == j.parameters.end() ? p.usual : given->second, p.unit, p.bound);
  }
  for (const auto& [name, value] : j.parameters) {
    const bool known = std::any_of(kind.parameters.begin(), kind.parameters.end(),
                                   [&](const JointKind::Parameter& p) { return p.name == name; });
    if (!known) c.fail("a " + kind.name + " joint has no parameter '" + name + "'; leave it out");
  }
}

const JointKind& check_joint(const JointDescription& j, const SceneNames& names) {
  const Check c("joint", j.name);
  const JointKind* kind = find_joint_kind(j.kind);
  if (!kind) {
    std::string all;
    for (const JointKind& known : joint_kinds()) all += (all.empty() ? "" : " ") + known.name;
    c.fail("kind '" + j.kind + "' is unknown; the kinds are: " + all);
  }
  names.body(c, j.first, true);
  names.body(c, j.second, true);
  if (j.first == j.second) c.fail("joins '" + j.first + "' to itself; name two different bodies");
  check_frame(c, "first_frame", j.first_frame);
  check_frame(c, "second_frame", j.second_frame);
  check_parameters(c, j, *kind);
  return *kind;
}

void check_vessel(const VesselDescription& v, const SceneNames& names) {
  const Check c("vessel", v.name);
  names.body(c, v.body);
  check_fields(v, c);
  c.positive_definite("added_mass", v.added_mass, true);
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
  if (v.kinematics == VesselKinematics::paper && std::holds_alternative<RetardationFunctions>(v.memory)) {
    c.fail(
        "kinematics 'paper' takes state-space memory, as the paper does; leave the convolution to "
        "'yaw_following'");
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

void check_drives(const SceneDescription& scene, const SceneNames& names) {
  std::map<std::string, std::string> driven;
  for (const auto& d : scene.drivers) {
    const Check c("driver", d.name);
    check_fields(d, c);
    names.coordinate(c, d.coordinate);
    const auto [other, fresh] = driven.insert({d.coordinate.joint + "." + d.coordinate.coordinate, d.name});
    if (!fresh) {
      c.fail("prescribes " + other->first + ", which driver '" + other->second + "' prescribes already");
    }
  }
  for (const auto& d : scene.coordinates) names.coordinate(Check("recorded coordinate", d.joint), d);
}

/// What is led must be there, and can follow one only.
void check_followers(const SceneDescription& scene, const SceneNames& names) {
  std::map<std::string, std::string> led;
  for (const auto& list : scene.loads.lists) {
    for (const Lead& one : list->leads()) {
      const Check c(list->kind.name, one.by);
      const std::string what = one.as;
      const auto owner = names.input_owners.find(one.name);
      if (owner == names.input_owners.end() || find_load_kind(owner->second)->follows_as != what) {
        c.fail("there is no " + what + " '" + one.name + "'; add it first");
      }
      const auto [other, fresh] = led.insert({one.name, one.by});
      if (!fresh) c.fail(what + " '" + one.name + "' follows '" + other->second + "' already");
    }
  }
}

void check_points(const SceneDescription& scene, const SceneNames& names) {
  unique_names("point", scene.points);
  for (const auto& p : scene.points) {
    const Check c("point", p.name);
    names.body(c, p.body);
    check_fields(p, c);
  }
}

void check_vessels(const SceneDescription& scene, const SceneNames& names) {
  std::set<std::string> floating;
  for (const auto& v : scene.vessels) {
    check_vessel(v, names);
    if (!floating.insert(v.body).second)
      Check("vessel", v.name).fail("body '" + v.body + "' is a vessel already");
    if (v.kinematics != scene.vessels.front().kinematics) {
      Check("vessel", v.name).fail("kinematics differ from those of '" + scene.vessels.front().name + "'");
    }
  }
  std::set<std::string> slow;
  for (const auto& w : scene.wave_loads) {
    const Check c("wave load", w.name);
    if (w.positioned && w.positioned->cutoff() > 0.0 && !slow.insert(w.body).second) {
      c.fail("body '" + w.body + "' has a slow position already; one load has it");
    }
    if (floating.count(w.body) == 0) c.fail("body '" + w.body + "' is not a vessel; add its hydrodynamics");
    if (!w.exact && !w.table && !w.positioned) c.fail("has no wave components");
    if (w.positioned && scene.vessels.front().kinematics == VesselKinematics::paper) {
      c.fail("the paper's kinematics know loads at the mean position only; use 'yaw_following'");
    }
  }
}

/// Coupling masses: symmetric, and none of a vessel with itself.
void check_coupling(const Check& c, const HydroGroupDescription& g) {
  const auto n = static_cast<Eigen::Index>(6 * g.vessels.size());
  const MatXd& a = g.added_mass;
  if (a.size() == 0) return;
  if (a.rows() != n || a.cols() != n) {
    c.fail("added_mass has shape (" + std::to_string(a.rows()) + ", " + std::to_string(a.cols()) +
           "); give (6n, 6n) of " + std::to_string(g.vessels.size()) + " vessels");
  }
  if ((a - a.transpose()).cwiseAbs().maxCoeff() > 1e-6 * a.cwiseAbs().maxCoeff()) {
    c.fail("added_mass is not symmetric; give (A + A^T) / 2");
  }
  for (std::size_t i = 0; i < g.vessels.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    if (!a.block<6, 6>(at, at).isZero(0.0)) {
      c.fail("added_mass of vessel '" + g.vessels[i] +
             "' with itself is not zero; give it as that of the vessel");
    }
  }
}

void check_groups(const SceneDescription& scene) {
  std::map<std::string, std::string> taken;
  for (const HydroGroupDescription& g : scene.groups) {
    const Check c("group", g.name);
    check_fields(g, c);
    if (g.vessels.size() < 2 || g.vessels.size() > HydroGroup::most_vessels) {
      c.fail("has " + std::to_string(g.vessels.size()) + " vessels; name two to " +
             std::to_string(HydroGroup::most_vessels));
    }
    for (const std::string& name : g.vessels) {
      const auto vessel = std::ranges::find(scene.vessels, name, &VesselDescription::name);
      if (vessel == scene.vessels.end()) c.fail("there is no vessel '" + name + "'; add it first");
      const auto [other, fresh] = taken.insert({name, g.name});
      if (!fresh) c.fail("vessel '" + name + "' is in group '" + other->second + "' already");
      if (vessel->kinematics == VesselKinematics::paper) {
        c.fail("vessel '" + name +
               "' has kinematics 'paper', whose mass is not symmetric; choose 'yaw_following'");
      }
      const auto* blocks = std::get_if<std::vector<StateSpaceBlock>>(&vessel->memory);
      if (!g.memory.empty() && (!blocks || !blocks->empty())) {
        c.fail("vessel '" + name + "' has a memory of its own, and the group has one of all; leave one out");
      }
    }
    check_coupling(c, g);
  }
}

}  // namespace

void validate(const SceneDescription& scene) {
  const Check c("scene", scene.name);
  c.finite("gravity", scene.gravity);
  c.number("baumgarte", scene.baumgarte, "1/s", {.minimum = 0.0});
  c.number("length_scale", scene.length_scale, "m", {.minimum = 0.0, .above = true});
  if (scene.bodies.empty()) c.fail("has no bodies; add at least one");
  unique_names("body", scene.bodies);
  unique_names("joint", scene.joints);
  unique_names("driver", scene.drivers);
  unique_names("vessel", scene.vessels);
  unique_names("group", scene.groups);
  unique_names("wave load", scene.wave_loads);
  SceneNames names;
  for (const auto& b : scene.bodies) {
    check_body(b);
    names.bodies.insert(b.name);
  }
  for (const auto& j : scene.joints) names.joints[j.name] = {j.kind, check_joint(j, names).coordinates};
  check_drives(scene, names);
  for (const auto& list : scene.loads.lists) {
    unique_names(list->kind.name, list->names());
    list->check(names);
  }
  check_followers(scene, names);
  check_vessels(scene, names);
  check_groups(scene);
  check_points(scene, names);
  unique_names("limit", scene.limits);
  check_limits(scene, names);
}

}  // namespace seacrane
