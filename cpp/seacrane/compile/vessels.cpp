#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "seacrane/compile/steps.hpp"
#include "seacrane/dynamics/inertia.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/math/dense.hpp"

namespace seacrane {
namespace {

/// Rigid and added masses of a group at the start are positive definite.
void check_mass(const HydroGroupDescription& d, const HydroGroup& group, const Model& model) {
  MatXd mass = MatXd::Zero(group.motions(), group.motions());
  std::vector<YawFrame<double>> frames(model.vessels.size(),
                                       YawFrame<double>(BodyKinematics<double>::ground()));
  for (std::size_t i = 0; i < group.vessels.size(); ++i) {
    const Vessel& vessel = model.vessels[idx(group.vessels[i])];
    const BodyDescription& start = model.description.bodies[idx(model.merge.carriers[idx(vessel.body)])];
    BodyKinematics<double> k = BodyKinematics<double>::ground();
    k.rotation = rotation_from_quaternion<double>(start.quaternion);
    frames[idx(group.vessels[i])] = YawFrame<double>(k);
    const auto at = static_cast<Eigen::Index>(6 * i);
    mass.block<6, 6>(at, at) = rigid_mass_matrix(model.bodies[idx(vessel.body)], k.rotation) +
                               frames[idx(group.vessels[i])].inertia(vessel.added_mass).matrix();
  }
  group.couple<double>(frames.data(),
                       [&](const HydroGroup::Pair& pair, const Mat6d& between, const Vec6d&, const Vec6d&) {
                         mass.block<6, 6>(6 * pair.first, 6 * pair.second) = between;
                         mass.block<6, 6>(6 * pair.second, 6 * pair.first) = between.transpose();
                       });
  const VecXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const MatXd scaled = scale.asDiagonal() * mass * scale.asDiagonal();
  const double least = Eigen::SelfAdjointEigenSolver<MatXd>(scaled).eigenvalues()[0];
  if (least > 0.0) return;
  throw SceneError("group '" + d.name + "': the masses of its vessels with the added masses between them " +
                   "are not positive definite: an eigenvalue is " + to_text(least) +
                   " of the diagonal; correct added_mass, its units, or the order of the vessels");
}

}  // namespace

Vessel vessel_at(const VesselDescription& d, const BodyDescription& start) {
  Vessel v;
  v.added_mass = d.added_mass;
  v.linear_damping = d.linear_damping;
  v.quadratic_damping = d.quadratic_damping;
  v.restoring = d.restoring.block<3, 3>(2, 2);
  v.mooring_stiffness = d.mooring_stiffness;
  v.mooring_damping = d.mooring_damping;
  try {
    if (const auto* functions = std::get_if<RetardationFunctions>(&d.memory)) {
      v.memory = Convolution(*functions);
    } else {
      v.memory = Memory(std::get<std::vector<StateSpaceBlock>>(d.memory));
    }
  } catch (const std::invalid_argument& error) {
    throw SceneError("vessel '" + d.name + "': " + error.what());
  }
  // At rest on the still water: a hull described above or below it starts there, and heaves.
  v.mean_position = {start.position.x(), start.position.y(), 0.0};
  v.mean_yaw = roll_pitch_yaw<double>(rotation_from_quaternion<double>(start.quaternion))[2];
  v.mean_axes = rotation_about_z<double>(std::cos(v.mean_yaw), std::sin(v.mean_yaw));
  if (d.kinematics == VesselKinematics::paper && std::fabs(v.mean_yaw) > 1e-9) {
    throw SceneError("vessel '" + d.name +
                     "': kinematics 'paper' act along the inertial axes, and it starts at a heading of " +
                     to_text(v.mean_yaw) + " rad; start it at 0, or use 'yaw_following'");
  }
  return v;
}

int vessel_of(const SceneDescription& scene, const std::string& name) {
  return static_cast<int>(std::ranges::find(scene.vessels, name, &VesselDescription::name) -
                          scene.vessels.begin());
}

void add_groups(Model& model) {
  for (const HydroGroupDescription& d : model.description.groups) {
    HydroGroup group;
    for (const std::string& name : d.vessels) group.vessels.push_back(vessel_of(model.description, name));
    const int count = static_cast<int>(group.vessels.size());
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < i && !d.added_mass.isZero(0.0); ++j) {
        const Mat6d block = d.added_mass.block<6, 6>(6 * i, 6 * j);
        group.pairs.push_back({i, j, block});
      }
    }
    try {
      group.memory = Memory(d.memory, 6 * count);
    } catch (const std::invalid_argument& error) {
      throw SceneError("group '" + d.name + "': " + error.what());
    }
    check_mass(d, group, model);
    model.groups.push_back(group);
  }
}

}  // namespace seacrane
