#include "given.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace given {
namespace {

std::string written(const py::handle& value) { return py::str(value).cast<std::string>(); }
std::string type_name(const py::handle& value) {
  return py::type::of(value).attr("__name__").cast<std::string>();
}

bool of_class(const py::handle& value, const char* module, const char* name) {
  return py::isinstance(value, py::module_::import(module).attr(name));
}

/// Refuses what Python itself could not turn into numbers; anything else that went wrong goes on.
void refuse_unless_other(const py::error_already_set& error, const std::string& what, const py::handle& value,
                         const char* fix) {
  for (PyObject* const known : {PyExc_TypeError, PyExc_ValueError, PyExc_OverflowError}) {
    if (error.matches(known)) throw Refused(what, "is " + shown(value) + "; " + fix);
  }
}

/// NumPy's masked values, below which anything may stand.
void require_unmasked(const std::string& what, const py::object& value) {
  if (!of_class(value, "numpy.ma", "MaskedArray")) return;
  const py::module_ numpy = py::module_::import("numpy");
  const py::object mask = numpy.attr("ma").attr("getmaskarray")(value);
  const auto count = mask.attr("sum")().cast<long>();
  if (count == 0) return;
  const py::object first = numpy.attr("argwhere")(mask).attr("tolist")()[py::int_(0)];
  throw Refused(what, "has " + std::to_string(count) + " masked values, the first at " + written(first) +
                          "; leave such samples out, or fill them by "
                          "seacrane.statistics.interpolated(time, values)");
}

bool holds_texts(const py::array& array) {
  for (const py::handle one : py::list(array.attr("ravel")())) {
    if (py::isinstance<py::str>(one) || py::isinstance<py::bytes>(one)) return true;
  }
  return false;
}

/// An array of one shape, of which -1 is any length; an empty list is no rows. `told`: how the error says it.
Array shaped(const std::string& what, const py::object& value, const std::vector<py::ssize_t>& shape,
             const std::string& told) {
  Array array = numbers_of(what, value);
  if (array.ndim() == 1 && array.size() == 0 && shape.front() < 0) {
    std::vector<py::ssize_t> none = shape;
    for (py::ssize_t& length : none) length = std::max<py::ssize_t>(length, 0);
    array = Array(none);
  }
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (std::size_t i = 0; fits && i < shape.size(); ++i) {
    fits = shape[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == shape[i];
  }
  if (fits) return array;
  throw Refused(what, "has shape " + written(array.attr("shape")) + "; give " + told);
}

double within(const std::string& what, const py::object& value, const std::string& unit, double least,
              const char* fix) {
  const double number = number_of(what, value);
  if (std::isfinite(number) && number >= least) return number;
  throw Refused(what, "is " + written(py::float_(number)) + (unit.empty() ? "" : " " + unit) +
                          "; give a finite " + fix);
}

}  // namespace

std::string shown(const py::handle& value) {
  return py::module_::import("seacrane.inputs.shown").attr("shown")(value).cast<std::string>();
}

std::string text_of(const std::string& what, const py::object& value, const std::string& usual) {
  const bool none = value.is_none() || (py::isinstance<py::str>(value) && py::len(value) == 0);
  const py::object text = none && !usual.empty() ? py::str(usual) : value;
  if (!py::isinstance<py::str>(text) || !text.attr("isprintable")().cast<bool>()) {
    throw Refused(what, "is " + shown(text) + "; give a name, a printable text");
  }
  return written(text);
}

std::string name_of(const std::string& kind, const py::object& value, const std::string& usual) {
  std::string name = text_of(kind + ": name", value, usual);
  if (name.empty()) throw Refused(kind + ": name", "is empty; give every element a name");
  return name;
}

std::vector<std::string> texts_of(const std::string& what, const py::object& value) {
  const auto refuse = [&] { throw Refused(what, "is " + shown(value) + "; give a list of texts"); };
  const bool single = py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value);
  if (single || py::hasattr(value, "keys") || !py::hasattr(value, "__iter__")) refuse();
  const py::list texts(value);
  for (const py::handle one : texts) {
    if (!py::isinstance<py::str>(one)) refuse();
  }
  std::vector<std::string> out;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    out.push_back(text_of(what + "[" + std::to_string(i) + "]", texts[i]));
  }
  return out;
}

bool flag_of(const std::string& what, const py::object& value) {
  if (PyBool_Check(value.ptr())) return value.is(py::bool_(true));
  if (of_class(value, "numpy", "bool_")) return PyObject_IsTrue(value.ptr()) == 1;
  throw Refused(what, "is " + shown(value) + "; give True or False");
}

double number_of(const std::string& what, const py::object& value) {
  if (PyFloat_CheckExact(value.ptr())) return PyFloat_AS_DOUBLE(value.ptr());
  if (py::hasattr(value, "ndim") && py::bool_(value.attr("ndim"))) {
    const std::string shape = written(py::getattr(value, "shape", py::str("")));
    throw Refused(what, "is a " + type_name(value) + " of shape " + shape +
                            "; give a number: one of its values, not a row");
  }
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  const py::error_already_set error;
  refuse_unless_other(error, what, value, "give a number");
  throw error;
}

Array numbers_of(const std::string& what, const py::object& value) {
  require_unmasked(what, value);
  try {
    const py::array array = py::module_::import("numpy").attr("asarray")(value);
    const char kind = array.dtype().kind();
    if (std::string("biufO").find(kind) == std::string::npos || (kind == 'O' && holds_texts(array))) {
      throw py::type_error();
    }
    return array.attr("astype")("float64", py::arg("copy") = false);
  } catch (const py::type_error&) {
    throw Refused(what, "is " + shown(value) + "; give numbers");
  } catch (const py::error_already_set& error) {
    refuse_unless_other(error, what, value, "give numbers");
    throw;
  }
}

std::vector<double> vector_of(const std::string& what, const py::object& value) {
  const Array array = shaped(what, value, {-1}, "one row of numbers");
  return {array.data(), array.data() + array.size()};
}

Array shaped_of(const std::string& what, const py::object& value, const std::vector<py::ssize_t>& shape) {
  return shaped(what, value, shape, written(py::tuple(py::cast(shape))));
}

Array rows_of(const std::string& what, const py::object& value, py::ssize_t width) {
  return shaped(what, value, {-1, width}, "(n, " + std::to_string(width) + ")");
}

Array matrix_of(const std::string& what, const py::object& value) {
  return shaped(what, value, {-1, -1}, "rows of numbers");
}

std::uintptr_t address_of(const std::string& what, const py::object& value) {
  if (PyLong_Check(value.ptr())) {
    const auto address = PyLong_AsUnsignedLongLong(value.ptr());
    if (PyErr_Occurred() == nullptr && address > 0) return address;
    PyErr_Clear();
  }
  throw Refused(what, "is " + py::repr(value).cast<std::string>() + "; give the address of a C function");
}

seacrane::Curve curve_of(const std::string& what, const py::object& value) {
  if (py::isinstance<seacrane::Curve>(value)) return value.cast<seacrane::Curve>();
  const double number = number_of(what, value);
  if (std::isfinite(number)) return seacrane::Curve::constant(number);
  throw Refused(what, "is " + written(py::float_(number)) + "; give a finite number or a curve");
}

}  // namespace given

void bind_given(py::module_& m) {
  const auto def = [&](const char* name, auto function, const char* text, auto... more) {
    m.def(name, function, py::arg("what"), py::arg("value"), more..., text);
  };
  const auto bounded = [&](const char* name, double least, const char* fix, const char* text) {
    def(
        name,
        [=](const std::string& what, const py::object& value, const std::string& unit) {
          return given::within(what, value, unit, least, fix);
        },
        text, py::arg("unit") = "");
  };
  const auto usual = py::arg("usual") = "";
  def("text_of", &given::text_of, "A printable text; None and the empty text stand for the usual one.",
      usual);
  m.def("name_of", &given::name_of, py::arg("kind"), py::arg("value"), usual,
        "A printable text that is not empty; None and the empty text stand for the usual one.");
  def("texts_of", &given::texts_of, "A list of printable texts.");
  def("flag_of", &given::flag_of, "A truth value, nothing that merely counts as one.");
  def("number_of", &given::number_of, "A float; not a text that reads like one, nor a row of one number.");
  const double infinite = -infinity, least = std::numeric_limits<double>::denorm_min();
  bounded("finite_of", infinite, "number",
          "A number that is neither infinite nor none; the unit is for the error.");
  bounded("positive_of", least, "number above zero", "A finite number above zero.");
  bounded("not_negative_of", 0.0, "number, zero or more", "A finite number of zero or more.");
  def("numbers_of", &given::numbers_of,
      "An array of floats of any shape; no texts that read like numbers, no dates.");
  def("vector_of", &given::vector_of, "A list of floats from a one-dimensional array_like.");
  def("shaped_of", &given::shaped_of, "An array of floats of one shape.", py::arg("shape"));
  def("rows_of", &given::rows_of, "Rows of so many numbers; an empty list is no rows.", py::arg("width"));
  def("matrix_of", &given::matrix_of, "Rows of numbers, of any length; an empty list is none.");
  def("require_unmasked", &given::require_unmasked,
      "Refuses NumPy's masked values, below which anything may stand.");
  def("curve_of", &given::curve_of, "A curve, or a number as a constant one.");
}
