#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "seacrane/sea/exact_wave_load.hpp"
#include "seacrane/sea/stretching.hpp"
#include "without_gil.hpp"

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// f(t, seven channels) at every time; the first `width` channels from `first` on are kept. The result has
/// the shape of `times`, followed by `width` unless it is one.
template <class Function>
py::array_t<double> at_times(const Doubles& times, std::size_t first, std::size_t width, const Function& f) {
  std::vector<py::ssize_t> shape(times.shape(), times.shape() + times.ndim());
  if (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
  py::array_t<double> out(shape);
  const double* t = times.data();
  double* target = out.mutable_data();
  const py::ssize_t count = times.size();
  const WithoutGil released;
  for (py::ssize_t i = 0; i < count; ++i) {
    if (!std::isfinite(t[i])) throw std::invalid_argument("wave load: a time is not finite; give times in s");
    double channels[seacrane::wave_channels];
    f(t[i], channels);
    target = std::copy_n(channels + first, width, target);
  }
  return out;
}

/// Arrays broadcast against each other as NumPy does, each contiguous.
inline std::vector<Doubles> broadcast(const py::object& a, const py::object& b, const py::object& c,
                                      const py::object& d) {
  std::vector<Doubles> out;
  for (const py::handle one : py::module_::import("numpy").attr("broadcast_arrays")(a, b, c, d)) {
    out.push_back(py::cast<Doubles>(one));
  }
  return out;
}

inline std::vector<double> to_vector(const Doubles& a, const std::string& object, const std::string& name) {
  if (a.ndim() != 1) {
    throw py::value_error(object + ": " + name + " has " + std::to_string(a.ndim()) +
                          " dimensions; give a one-dimensional array");
  }
  return {a.data(), a.data() + a.size()};
}

inline seacrane::Stretching stretching_of(const std::string& name) {
  if (name == "wheeler") return seacrane::Stretching::wheeler;
  if (name == "none") return seacrane::Stretching::none;
  throw py::value_error("wave kinematics: stretching is '" + name + "'; give 'wheeler' or 'none'");
}

void bind_current(py::module_& m);
void bind_sea_field(py::module_& m);
void bind_spectrum(py::module_& m);
void bind_wave_components(py::module_& m);
void bind_wave_load(py::module_& m);
