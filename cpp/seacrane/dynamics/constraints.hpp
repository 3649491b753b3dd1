#pragma once

#include "seacrane/model/model.hpp"

namespace seacrane {

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
