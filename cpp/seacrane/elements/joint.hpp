#pragma once

#include <array>
#include <map>
#include <string>
#include <tuple>

#include "seacrane/elements/field.hpp"
#include "seacrane/math/random.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

/// A joint frame on a body: a point and axes in body coordinates; the joint axis is z.
struct Frame {
  Vec3d point = Vec3d::Zero();
  Mat3d axes = Mat3d::Identity();

  static constexpr const char* type = "Frame";
  static constexpr const char* text =
      "A joint frame: a point (m) and axes (3, 3, columns; z is the joint axis) in body coordinates.";
  static constexpr auto fields() {
    return std::tuple(
        optional("point", &Frame::point, "m", "body coordinates"),
        optional("axes", &Frame::axes, "", "columns x, y, z in body coordinates; z is the joint axis"));
  }
};

struct JointDescription {
  std::string name, kind, first, second;
  Frame first_frame, second_frame;
  std::map<std::string, double> parameters = {};  // the joint type's own, by name
  bool open = false;  // holds nothing now: a limit that is not reached, see model/limit.hpp

  static constexpr const char* type = "Joint";
  static constexpr const char* text =
      "A joint between two bodies ('ground' is the inertial frame); may close a loop. A kind's own "
      "parameters, "
      "such as the length of a distance joint, are arguments too; see joint_kinds().";
  static constexpr auto fields() {
    using D = JointDescription;
    return std::tuple(required("kind", &D::kind, "", "one of joint_kinds()"),
                      on_body("first", &D::first, "body or ground"),
                      on_body("second", &D::second, "body or ground"),
                      required("first_frame", &D::first_frame, "", "on the first body"),
                      required("second_frame", &D::second_frame, "", "on the second body"));
  }
};

/// Parameters of a joint type in the order of its fields, as compiled data carry them.
inline constexpr std::size_t kMostParameters = 4;
using ParameterValues = std::array<double, kMostParameters>;

/// A joint type's own parameters from compiled data: constants where it is used.
template <class Parameters>
constexpr Parameters parameters_of(const ParameterValues& values) {
  Parameters out;
  std::size_t i = 0;
  for_each_field<Parameters>([&](const auto& field) { field.of(out) = values[i++]; });
  return out;
}

struct NoParameters {
  static constexpr auto fields() { return std::tuple<>(); }
};

/// What a joint type has unless it says otherwise. It must have `kind`, `rows`, `evaluate` and `example`; a
/// struct `Branch` makes it a branch of the recursive tree (tree_joint.hpp).
struct JointDefaults {
  using Parameters = NoParameters;                // numbers of its own, with their fields
  static constexpr const char* coordinates = "";  // of joint_coordinate.hpp, separated by spaces
  static constexpr const char* usual = "";        // the coordinate meant where none is named
  static constexpr bool slides = false;           // its reaction is taken at the point on the first body
  static constexpr bool parallel_axes = false;    // closed, z axes point the same way
  static constexpr bool aligned_axes = false;     // x axes too
  static constexpr bool own_axis = false;         // the axis on the second body is another one
  static constexpr bool own_point = false;        // the point on the second body is another one
};

/// A closed joint of one type with random frames on two bodies at the same pose: its second frame stands at
/// `offset` in the first one. For checks that know no type by name.
template <class Type>
JointDescription example_joint(Random& random, const Frame& offset = {},
                               std::map<std::string, double> parameters = {}) {
  const Frame first{random.vector(), random.rotation()};
  const Frame second{first.point + first.axes * offset.point, first.axes * offset.axes};
  return {"joint", Type::kind, "first", "second", first, second, std::move(parameters)};
}

}  // namespace seacrane
