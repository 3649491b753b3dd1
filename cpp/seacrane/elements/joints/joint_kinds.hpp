#pragma once

#include <string>
#include <vector>

#include "seacrane/elements/joint.hpp"

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
  std::vector<Parameter> parameters;
  JointDescription (*example)(Random&) = nullptr;

  /// Its parameters in order, missing ones at their default, without a check.
  ParameterValues values(const JointDescription& joint) const;
};

/// The list of all joint types, in the order of their registration.
const std::vector<JointKind>& joint_kinds();
/// Null for an unknown one.
const JointKind* find_joint_kind(const std::string& name);

}  // namespace seacrane
