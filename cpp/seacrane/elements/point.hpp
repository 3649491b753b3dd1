#pragma once

#include <string>

#include "seacrane/elements/field.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

/// A point of a body, recorded by its name.
struct PointDescription {
  std::string name, body;
  Vec3d point = Vec3d::Zero();

  static constexpr const char* type = "Point";
  static constexpr const char* text = "A point of a body, whose motion is recorded.";
  static constexpr auto fields() {
    using D = PointDescription;
    return std::tuple(on_body("body", &D::body),
                      optional("point", &D::point, "m", "coordinates of the body"));
  }
};

}  // namespace seacrane
