#pragma once

#include <vector>

#include "seacrane/dynamics/recursive/tree_kinematics.hpp"
#include "seacrane/elements/loads/registry.hpp"

namespace seacrane {

/// The actuators whose coordinate is one of a tree, the angle of a hinge, the way of a slide or the stroke of
/// a strut: torques on its speeds instead of wrenches on two bodies.
class TreeActuators {
 public:
  TreeActuators(const Model& model, const BodyTree& tree);

  /// The loads of the model that are left to the bodies.
  const CompiledLoads& others() const { return others_; }

  /// Adds torques on the speeds, and the actuators' power, at the kinematics' last place().
  template <class T>
  void apply(const LoadInput<T>& in, const TreeKinematics<T>& tree, const T* q, const T* u, T* torque,
             LoadSum<T>& sum) const {
    for (const Actuated& a : actuated_) {
      const T slope = a.strut < 0 ? T(a.sign) : T(a.sign) * tree.stroke(a.strut).slope;
      const T value = T(a.sign) * (a.strut < 0 ? q[a.q] : tree.stroke(a.strut).value);
      const T rate = slope * u[a.u];
      const T force = a.actuator.force(in, value, rate);
      torque[a.u] += slope * force;
      sum.add_power(force * rate);
    }
  }

 private:
  struct Actuated {
    Actuator actuator;
    int q, u;
    int strut;    // -1: the coordinate is that of the joint itself
    double sign;  // of the actuator's coordinate over the tree's
  };

  CompiledLoads others_;
  std::vector<Actuated> actuated_;
};

}  // namespace seacrane
