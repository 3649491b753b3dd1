#pragma once

#include <string>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// What tells two compiled scenes apart beside their seas, such as "body 'load' (mass)"; empty where they are
/// stepped alike but for the values of their waves. What is only recorded does not count.
std::string difference(const Model& one, const Model& other);

}  // namespace seacrane
