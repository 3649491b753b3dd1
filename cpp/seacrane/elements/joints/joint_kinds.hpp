#pragma once

#include <string>
#include <vector>

#include "seacrane/elements/joint.hpp"
#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/math/dual.hpp"

namespace seacrane {

/// What a joint type says of itself, for those who treat all of them alike.
struct JointKind {
  struct Parameter {
    const char *name, *unit, *text;
    Role role;
    Bound bound;
    bool required;
    double usual;  // where it is not required
  };

  std::string name;
  std::size_t index = 0;  // in JointTypes
  int rows = 0;
  std::string coordinates, usual;
  bool slides = false, own_axis = false, own_point = false, branch = false;
  bool parallel_axes = false, aligned_axes = false;
  std::vector<Parameter> parameters;
  JointDescription (*example)(Random&) = nullptr;
  /// The rows of all joints of the type; `blocks` by element.
  void (*evaluate)(const std::vector<JointData>& joints, const BodyKinematics<double>* bodies,
                   RowBlock<double>* blocks) = nullptr;
  /// Those of one, with slopes.
  void (*evaluate_slopes)(const JointData& joint, const BodyKinematics<Dual<12>>* bodies,
                          RowBlock<Dual<12>>& block) = nullptr;

  /// Its parameters in order, missing ones at their default, without a check.
  ParameterValues values(const JointDescription& joint) const;
};

/// The list of all joint types, in the order of their registration.
const std::vector<JointKind>& joint_kinds();
/// Null for an unknown one.
const JointKind* find_joint_kind(const std::string& name);

}  // namespace seacrane
