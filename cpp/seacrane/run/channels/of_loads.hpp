#pragma once

#include <algorithm>
#include <functional>
#include <ranges>
#include <string>
#include <vector>

#include "seacrane/dynamics/terms.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {

template <class Elements>
std::vector<std::string> names_of_all(const Elements& elements) {
  std::vector<std::string> names;
  for (const auto& one : elements) names.push_back(one.name);
  return names;
}
/// Names of the described loads of a kind.
template <class Load>
std::vector<std::string> names_of(const Model& m) {
  return names_of_all(m.description.loads.of<Load>());
}

inline LoadInput<double> input_of(const Output& o) {
  return o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
}

/// Writes a number, or each of several, and returns where the next are written.
inline double* put(double value, double* out) {
  *out = value;
  return out + 1;
}
template <std::ranges::range Values>
double* put(const Values& values, double* out) {
  return std::ranges::copy(values, out).out;
}

/// Writes what `read`, a member or a function, has of the motion of each load of a kind.
template <class Load, auto read>
void write_motions(const Output& o, double* out) {
  const LoadInput<double> in = input_of(o);
  for (const Load& one : o.terms.model().loads.of<Load>()) out = put(std::invoke(read, one.motion(in)), out);
}

}  // namespace seacrane
