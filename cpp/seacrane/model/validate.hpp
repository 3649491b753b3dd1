#pragma once

#include <stdexcept>
#include <string>

#include "seacrane/model/description.hpp"

namespace seacrane {

/// A scene that contradicts itself or holds a value out of range; the message names object, value, fix.
class SceneError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Checks every description by itself and all names; throws SceneError.
void validate(const SceneDescription& scene);

std::string to_text(double value);

}  // namespace seacrane
