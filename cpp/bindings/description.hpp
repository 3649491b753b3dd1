#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "seacrane/elements/joint.hpp"
#include "seacrane/elements/loads/function_force.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/model/description.hpp"

/// A description's Python class, made from its fields: a constructor with keywords that checks what it is
/// given, a property for each, comparison, copies and pickling by them, and FIELDS, a table of them.
namespace description {

using namespace seacrane;
using Shape = std::vector<int>;  // -1: any length

template <class V>
inline constexpr bool is_rows = false;
template <int n>
inline constexpr bool is_rows<std::vector<Eigen::Matrix<double, n, 1>>> = true;

/// What a value is called in FIELDS, and its shape.
template <class V>
struct TypeOf {
  static constexpr const char *name = "object", *annotation = "typing.Any";
  static Shape shape() { return {}; }
};
template <>
struct TypeOf<std::string> {
  static constexpr const char *name = "text", *annotation = "str";
  static Shape shape() { return {}; }
};
template <>
struct TypeOf<std::vector<std::string>> {
  static constexpr const char *name = "texts", *annotation = "collections.abc.Sequence[str]";
  static Shape shape() { return {}; }
};
template <>
struct TypeOf<double> {
  static constexpr const char *name = "number", *annotation = "typing.SupportsFloat";
  static Shape shape() { return {}; }
};
template <>
struct TypeOf<bool> {
  static constexpr const char *name = "flag", *annotation = "bool";
  static Shape shape() { return {}; }
};
template <>
struct TypeOf<Curve> {
  static constexpr const char *name = "curve", *annotation = "Curve | typing.SupportsFloat";
  static Shape shape() { return {}; }
};
template <>
struct TypeOf<Frame> {
  static constexpr const char *name = "frame", *annotation = "Frame";
  static Shape shape() { return {}; }
};
template <>
struct TypeOf<VesselKinematics> {
  static constexpr const char *name = "text", *annotation = "str";
  static Shape shape() { return {}; }
};
template <>
struct TypeOf<ForceFunction> {
  static constexpr const char *name = "function", *annotation = "int";
  static Shape shape() { return {}; }
};
template <int rows, int columns>
struct TypeOf<Eigen::Matrix<double, rows, columns>> {
  static constexpr const char *name = "array", *annotation = "numpy.typing.ArrayLike";
  static Shape shape() { return columns == 1 ? Shape{rows} : Shape{rows, columns}; }
};
template <>
struct TypeOf<std::vector<double>> {
  static constexpr const char *name = "array", *annotation = "numpy.typing.ArrayLike";
  static Shape shape() { return {-1}; }
};
template <int n>
struct TypeOf<std::vector<Eigen::Matrix<double, n, 1>>> {
  static constexpr const char *name = "array", *annotation = "numpy.typing.ArrayLike";
  static Shape shape() { return {-1, n}; }
};

template <class T>
py::class_<T> bound() {
  return py::reinterpret_borrow<py::class_<T>>(py::type::of<T>());
}

/// A function of the Python module that checks what users give.
inline py::object checked(const char* name) {
  return py::module_::import("seacrane.inputs.checked").attr(name);
}

template <class V>
V from_python(const std::string& what, const py::handle& given) {
  if constexpr (std::is_same_v<V, std::string>) {
    return checked("text_of")(what, given, py::str("")).template cast<V>();
  } else if constexpr (std::is_same_v<V, double>) {
    return checked("number_of")(what, given).template cast<V>();
  } else if constexpr (std::is_same_v<V, bool>) {
    return checked("flag_of")(what, given).template cast<V>();
  } else if constexpr (std::is_same_v<V, Curve>) {
    return checked("curve_of")(what, given).template cast<V>();
  } else if constexpr (std::is_same_v<V, std::vector<double>>) {
    return checked("vector_of")(what, given).template cast<V>();
  } else if constexpr (std::is_same_v<V, std::vector<std::string>>) {
    return checked("texts_of")(what, given).template cast<V>();
  } else if constexpr (std::is_same_v<V, MatXd>) {
    return checked("matrix_of")(what, given).template cast<V>();
  } else if constexpr (is_rows<V>) {
    constexpr int n = V::value_type::RowsAtCompileTime;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, n, Eigen::RowMajor>;
    const Rows rows = checked("rows_of")(what, given, n).template cast<Rows>();
    V out;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) out.emplace_back(rows.row(i).transpose());
    return out;
  } else if constexpr (std::is_same_v<V, VesselKinematics>) {
    const auto name = from_python<std::string>(what, given);
    if (name == "yaw_following") return VesselKinematics::yaw_following;
    if (name == "paper") return VesselKinematics::paper;
    throw SceneError(what + " '" + name + "' is unknown; choose 'yaw_following' or 'paper'");
  } else if constexpr (std::is_same_v<V, ForceFunction>) {
    return reinterpret_cast<V>(checked("address_of")(what, given).template cast<std::uintptr_t>());
  } else if constexpr (std::is_same_v<V, Frame>) {
    if (py::isinstance<Frame>(given)) return given.cast<V>();
    throw SceneError(what + " is " + py::repr(given).cast<std::string>() + "; a frame is a seacrane.Frame");
  } else if constexpr (std::is_same_v<V, decltype(VesselDescription::memory)> ||
                       std::is_same_v<V, std::vector<StateSpaceBlock>>) {
    try {
      return given.cast<V>();
    } catch (const py::cast_error&) {
      const bool blocks = std::is_same_v<V, std::vector<StateSpaceBlock>>;
      throw SceneError(what + " is " + py::repr(given).cast<std::string>() +
                       "; give a list of seacrane.StateSpaceBlock" +
                       (blocks ? "" : " or seacrane.RetardationFunctions"));
    }
  } else {
    return checked("shaped_of")(what, given, py::tuple(py::cast(TypeOf<V>::shape()))).template cast<V>();
  }
}

/// As Python sees it: rows of numbers are one array.
template <class V>
auto seen(const V& value) {
  if constexpr (is_rows<V>) {
    constexpr int n = V::value_type::RowsAtCompileTime;
    Eigen::Matrix<double, Eigen::Dynamic, n, Eigen::RowMajor> rows(static_cast<Eigen::Index>(value.size()),
                                                                   n);
    for (std::size_t i = 0; i < value.size(); ++i) {
      rows.row(static_cast<Eigen::Index>(i)) = value[i].transpose();
    }
    return rows;
  } else if constexpr (std::is_same_v<V, VesselKinematics>) {
    return std::string(value == VesselKinematics::paper ? "paper" : "yaw_following");
  } else if constexpr (std::is_same_v<V, ForceFunction>) {
    return reinterpret_cast<std::uintptr_t>(value);
  } else {
    return value;
  }
}

template <class D, class F>
using ValueOf = std::remove_cvref_t<decltype(std::declval<F>().of(std::declval<D&>()))>;

template <class D>
inline constexpr bool has_name = requires(D d) {
  d.name;
};

inline const char* text_of(Role role) {
  switch (role) {
    case Role::body:
      return "body";
    case Role::joint:
      return "joint";
    case Role::coordinate:
      return "coordinate";
    case Role::distance:
      return "distance";
    default:
      return "value";
  }
}

/// In the words of JSON Schema.
inline py::dict in_words(const Bound& bound) {
  py::dict out;
  if (std::isfinite(bound.minimum)) out[bound.above ? "exclusiveMinimum" : "minimum"] = bound.minimum;
  if (std::isfinite(bound.maximum)) out[bound.below ? "exclusiveMaximum" : "maximum"] = bound.maximum;
  return out;
}

/// One entry of FIELDS.
struct FieldRow {
  std::string name, type, role, unit, text;
  py::tuple shape;
  bool required;
  py::object usual;
  py::dict bounds;
  double least = 0.0, most = 0.0;
};

template <class D>
py::tuple field_rows() {
  py::list out;
  const D usual;
  if constexpr (has_name<D>) {
    out.append(FieldRow{"name", "text", "name", "", "", py::tuple(), true, py::none(), py::dict()});
  }
  for_each_field<D>([&](const auto& f) {
    using V = ValueOf<D, decltype(f)>;
    out.append(FieldRow{f.name, TypeOf<V>::name, text_of(f.role), f.unit, f.text,
                        py::tuple(py::cast(TypeOf<V>::shape())), f.required,
                        f.required ? py::object(py::none()) : py::cast(seen(f.of(usual))), in_words(f.bound),
                        f.least, f.most});
  });
  return py::tuple(out);
}

/// The line from which stubs are made.
template <class D>
std::string signature(const std::string& more) {
  std::string out = std::string("__init__(self, *") + (has_name<D> ? ", name: str" : "");
  for_each_field<D>([&](const auto& f) {
    using V = ValueOf<D, decltype(f)>;
    out += std::string(", ") + f.name + ": " + TypeOf<V>::annotation + (f.required ? "" : " = ...");
  });
  return out + more + ") -> None\n";
}

/// The description of what was given, checked: `kind` names the element in messages.
template <class D>
D made(const std::string& kind, py::kwargs given) {
  D out;
  std::string what = kind + ": ";
  const auto take = [&](const char* name) {
    return given.contains(name) ? py::object(given.attr("pop")(name)) : py::object();
  };
  if constexpr (has_name<D>) {
    const py::object name = take("name");
    out.name = checked("name_of")(kind, name ? name : py::object(py::none())).template cast<std::string>();
    what = kind + " " + py::repr(py::str(out.name)).template cast<std::string>() + ": ";
  }
  std::string known;
  for_each_field<D>([&](const auto& f) {
    known += std::string(known.empty() ? "" : ", ") + f.name;
    const py::object value = take(f.name);
    if (value) {
      f.of(out) = from_python<ValueOf<D, decltype(f)>>(what + f.name, value);
    } else if (f.required) {
      throw py::type_error(what + "has no " + f.name + (*f.unit ? std::string(", ") + f.unit : "") +
                           "; give one");
    }
  });
  if constexpr (std::is_same_v<D, JointDescription>) {
    for (const auto& [key, value] : given) {
      const auto name = key.template cast<std::string>();
      out.parameters[name] = from_python<double>(what + name, value);
    }
  } else if (!given.empty()) {
    const auto unknown = py::repr((*given.begin()).first).template cast<std::string>();
    throw py::type_error(what + "has no entry " + unknown + "; it takes " + known);
  }
  return out;
}

/// What was given to make it, or would have been.
template <class D>
py::dict arguments(const D& self) {
  py::dict out;
  if constexpr (has_name<D>) out["name"] = self.name;
  for_each_field<D>([&](const auto& f) { out[f.name] = seen(f.of(self)); });
  if constexpr (std::is_same_v<D, JointDescription>) {
    for (const auto& [name, value] : self.parameters) out[name.c_str()] = value;
  }
  return out;
}

inline bool same(const py::handle& one, const py::handle& two) {
  if (!py::isinstance<py::array>(one) || !py::isinstance<py::array>(two)) return one.equal(two);
  return py::module_::import("numpy").attr("array_equal")(one, two).cast<bool>();
}

inline bool same_items(const py::dict& one, const py::dict& two) {
  if (one.size() != two.size()) return false;
  for (const auto& [name, value] : one) {
    if (!two.contains(name) || !same(value, two[name])) return false;
  }
  return true;
}

/// A class that is compared by value must not be hashed by place.
template <class T>
void copied() {
  bound<T>()
      .def("__copy__", [](const T& self) { return T(self); })
      .def(
          "__deepcopy__", [](const T& self, const py::dict&) { return T(self); }, py::arg("memo"))
      .def("__hash__", [](const T&) { return py::hash(py::type::of<T>()); });
}

/// Values that are copied and compared by what `arguments` tells of them.
template <class T, class Arguments>
void compared(const Arguments& arguments) {
  copied<T>();
  bound<T>().def("__eq__", [arguments](const py::object& self, const py::object& other) -> py::object {
    if (!py::isinstance<T>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(same_items(arguments(self), arguments(other)));
  });
}

/// Values that are pickled too: `made` makes them again from their arguments.
template <class T, class Arguments, class Made>
void by_arguments(const Arguments& arguments, const Made& made) {
  compared<T>(arguments);
  bound<T>().def(py::pickle(arguments, made));
}

/// Binds D; `kind` is its name in messages, `more` belongs to its constructor's signature.
template <class D>
py::class_<D> bind(py::module_& m, const std::string& kind, const std::string& more = "") {
  py::class_<D> type(m, D::type, (std::string(D::text) + " Immutable.").c_str());
  {
    py::options options;
    options.disable_function_signatures();
    type.def(py::init([kind](const py::kwargs& given) { return made<D>(kind, given); }),
             signature<D>(more).c_str());
  }
  if constexpr (has_name<D>) type.def_property_readonly("name", [](const D& d) { return d.name; });
  constexpr bool pickles = !std::is_same_v<D, FunctionForceDescription>;
  for_each_field<D>([&](const auto& f) {
    using V = ValueOf<D, decltype(f)>;
    if constexpr (!std::is_same_v<V, ForceFunction>) {
      const std::string unit = f.unit, text = f.text;
      type.def_property_readonly(
          f.name, [f](const D& d) { return seen(f.of(d)); },
          (unit + (unit.empty() || text.empty() ? "" : ", ") + text).c_str());
    }
  });
  const auto told = [](const py::object& self) { return arguments(self.cast<const D&>()); };
  if constexpr (pickles) {
    by_arguments<D>(told, [kind](const py::dict& given) { return made<D>(kind, py::kwargs(given)); });
  } else {
    compared<D>(told);
    type.def("__reduce__", [kind](const py::object& self) -> py::object {
      throw std::invalid_argument(kind + " '" + self.attr("name").cast<std::string>() +
                                  "': its C function has no address in another process; add it there");
    });
  }
  type.attr("FIELDS") = field_rows<D>();
  return type;
}

}  // namespace description
