#pragma once

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>

namespace py = pybind11;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

void bind_channels(py::module_& m);
void bind_copies();
void bind_curve(py::module_& m);
void bind_elements(py::module_& m);
void bind_given(py::module_& m);
void bind_integrators(py::module_& m);
void bind_sea(py::module_& m);
void bind_lanes(py::module_& m);
void bind_model(py::module_& m);
void bind_simulation(py::module_& m);
void bind_strip(py::module_& m);
