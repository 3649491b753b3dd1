#pragma once

#include <vector>

#include "seacrane/dynamics/recursive/tree_kinematics.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// The loads along a coordinate that is one of a tree, the angle of a hinge, the way of a slide or the stroke
/// of a strut: torques on its speeds instead of wrenches on two bodies. Reads the loads of the model.
class TreeActuators {
 public:
  TreeActuators(const Model& model, const BodyTree& tree);

  /// The loads of the model that are left to the bodies.
  const CompiledLoads& others() const { return others_; }

  struct Along {
    const LoadList* list;
    std::size_t at;
    int q, u;
    int strut;    // -1: the coordinate is that of the joint itself
    double sign;  // of the load's coordinate over the tree's
  };
  const std::vector<Along>& along() const { return along_; }

  /// Adds torques on the speeds, and their power, at the kinematics' last place(). The force of load k of
  /// along(), at the value and the rate of its coordinate, is force_of(k, input, value, rate).
  template <class T, class Force>
  void apply(const LoadInput<T>& in, const TreeKinematics<T>& tree, const T* q, const T* u, T* torque,
             LoadSum<T>& sum, Force&& force_of) const {
    for (std::size_t k = 0; k < along_.size(); ++k) {
      const Along& a = along_[k];
      const T slope = a.strut < 0 ? T(a.sign) : T(a.sign) * tree.stroke(a.strut).slope;
      const T value = T(a.sign) * (a.strut < 0 ? q[a.q] : tree.stroke(a.strut).value);
      const T rate = slope * u[a.u];
      const T force = force_of(k, in, value, rate);
      torque[a.u] += slope * force;
      sum.add_power(force * rate);
    }
  }

 private:
  CompiledLoads others_;
  std::vector<Along> along_;
};

}  // namespace seacrane
