#pragma once

#include <algorithm>
#include <cmath>

#include "seacrane/elements/driver.hpp"
#include "seacrane/elements/joints/registry.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// Residual, m or rad, below which projection leaves positions as they are: 1e-13, but less where bodies turn
/// fast. What is left open lets speeds jump, by so many rad/s times as much, when it is closed one day; the
/// history of a multistep method does not survive jumps beyond its tolerance.
inline double position_tolerance(const BodyKinematics<double>* bodies, int count) {
  constexpr double usual = 1e-13, slow = 10.0;  // rad/s
  double squared = slow * slow;
  for (int b = 0; b < count; ++b) squared = std::max(squared, bodies[b].angular_velocity.squaredNorm());
  return usual * (slow * slow / squared);
}

/// Evaluates the rows of every joint and driver, each kind with its like; `blocks` by element.
inline void evaluate_constraints(const Model& model, double t, double curve_limit,
                                 const BodyKinematics<double>* bodies, RowBlock<double>* blocks) {
  for_each_joint_type([&]<class Type>(std::size_t kind) {
    for (const JointData& joint : model.joints[kind]) {
      RowBlock<double>& out = blocks[joint.element];
      Type::template evaluate<double>(JointGeometry<double>(joint, bodies[joint.first], bodies[joint.second]),
                                      joint, out);
    }
  });
  for (const DriverData& driver : model.drivers) {
    const JointData& joint = driver.coordinate.joint;
    evaluate_driver<double>(driver, driver.curve.at(t, curve_limit), bodies[joint.first],
                            bodies[joint.second], blocks[driver.element]);
  }
}

}  // namespace seacrane
