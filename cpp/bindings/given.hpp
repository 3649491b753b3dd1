#pragma once

#include <string>
#include <vector>

#include "bindings.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/math/curve.hpp"

/// Values from outside turned into what the core takes, or refused: the same checks for the core's own
/// classes and for the Python module. `what` names a value, such as "line 'hoist': points[1]".
namespace given {

/// Becomes SceneError.of(value, text) of seacrane.errors.
struct Refused : seacrane::SceneError {
  std::string value, text;
  Refused(std::string of, std::string why)
      : SceneError(of + " " + why), value(std::move(of)), text(std::move(why)) {}
};

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// As Python writes it, cut after 60 characters.
std::string shown(const py::handle& value);
std::string text_of(const std::string& what, const py::object& value, const std::string& usual = "");
std::string name_of(const std::string& kind, const py::object& value, const std::string& usual = "");
std::vector<std::string> texts_of(const std::string& what, const py::object& value);
bool flag_of(const std::string& what, const py::object& value);
double number_of(const std::string& what, const py::object& value);
Array numbers_of(const std::string& what, const py::object& value);
std::vector<double> vector_of(const std::string& what, const py::object& value);
Array shaped_of(const std::string& what, const py::object& value, const std::vector<py::ssize_t>& shape);
Array rows_of(const std::string& what, const py::object& value, py::ssize_t width);
Array matrix_of(const std::string& what, const py::object& value);
std::uintptr_t address_of(const std::string& what, const py::object& value);
seacrane::Curve curve_of(const std::string& what, const py::object& value);

}  // namespace given
