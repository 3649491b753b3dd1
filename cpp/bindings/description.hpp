#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "seacrane/elements/field.hpp"

/// A description's Python class, made from its fields: a constructor with keywords that checks what it is
/// given, a property for each, comparison, copies and pickling by them, and FIELDS, a table of them. What
/// fields and classes have in common is compiled once, in description.cpp and value_types.cpp.
namespace description {

using namespace seacrane;

/// What Python has of one type of value, which is at an address.
struct ValueType {
  const char* name;               // in FIELDS
  std::string given_as, seen_as;  // in stubs
  std::vector<int> shape;         // of an array; -1: any length
  py::object (*seen)(const void* value);
  void (*take)(void* value, const std::string& what, const py::object& given);  // checks
};

/// Those that there are stand at the end of value_types.cpp.
template <class V>
const ValueType& value_type();

/// What C++ does with values of a Python class.
struct Class {
  py::handle type;
  const void* (*value)(const py::handle& object);
  void* (*copy)(const void* value);
  py::object (*owner)(void* value);
};

template <class T>
Class class_of() {
  return {
      py::type::of<T>(), [](const py::handle& object) -> const void* { return object.cast<const T*>(); },
      [](const void* value) -> void* { return new T(*static_cast<const T*>(value)); },
      [](void* value) { return py::cast(static_cast<T*>(value), py::return_value_policy::take_ownership); }};
}

/// A field of a description: what it says of itself, and where its value is.
struct Entry : Field<std::ptrdiff_t> {
  const ValueType* type;
};

/// A description without its type.
struct Table {
  std::string kind, more;  // its name in messages; what else its constructor takes, for stubs
  const void* usual;       // the description by default
  std::vector<Entry> entries = {};
  std::ptrdiff_t name = -1, parameters = -1;  // where they are; -1: it has none
  Class of = {};
};

/// One entry of FIELDS.
struct FieldRow {
  std::string name, type, role, unit, text;
  py::tuple shape;
  bool required;
  py::object usual;
  py::dict bounds;
  double least = 0.0, most = 0.0;
};

const char* text_of(Role role);
/// In the words of JSON Schema.
py::dict in_words(const Bound& bound);

using Arguments = std::function<py::dict(const py::object& self)>;
using Made = std::function<py::object(const py::dict& arguments)>;

/// Values that are copied, compared and pickled by what `arguments` tells of them: `made` makes them again.
void by_arguments(const Class& of, const Arguments& arguments, const Made& made);
/// All that a description's class has; the table stays where it is.
void bind(const Table& table);
/// A function without arguments that makes an object of a class.
void bind_example(const py::object& type, py::object (*example)());

/// Binds D; `kind` is its name in messages, `more` belongs to its constructor's signature.
template <class D>
py::class_<D> bind(py::module_& m, const std::string& kind, const std::string& more = "") {
  static const D usual;
  static Table table{kind, more, &usual};
  const auto place = [](const auto& value) {
    return reinterpret_cast<const char*>(&value) - reinterpret_cast<const char*>(&usual);
  };
  for_each_field<D>([&](const auto& f) {
    const auto& value = f.of(usual);
    table.entries.push_back(
        {{f.name, place(value), f.unit, f.text, f.required, f.role, f.bound, f.least, f.most},
         &value_type<std::remove_cvref_t<decltype(value)>>()});
  });
  if constexpr (requires { usual.name; }) table.name = place(usual.name);
  if constexpr (requires { usual.parameters.find(""); }) table.parameters = place(usual.parameters);
  py::class_<D> type(m, D::type, (std::string(D::text) + " Immutable.").c_str());
  table.of = class_of<D>();
  bind(table);
  return type;
}

}  // namespace description
