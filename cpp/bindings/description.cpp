#include "description.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "given.hpp"

namespace description {

namespace {

using py::detail::value_and_holder;

/// What is at a place in a value; only a new one is changed.
template <class V = char>
V& at(const void* value, std::ptrdiff_t place) {
  return *reinterpret_cast<V*>(static_cast<char*>(const_cast<void*>(value)) + place);
}
using Parameters = std::map<std::string, double>;

/// What a method is called on; for anything else it is no method.
const void* value_of(const Class& of, const py::handle& self) {
  if (!py::isinstance(self, of.type)) throw py::reference_cast_error();
  return of.value(self);
}

std::string name_of(const py::handle& type) {
  return py::str("{}.{}").format(type.attr("__module__"), type.attr("__qualname__"));
}

template <class F, class... Extra>
void method(const Class& of, const char* name, const F& f, const Extra&... extra) {
  py::setattr(of.type, name, py::cpp_function(f, py::name(name), py::is_method(of.type), extra...));
}

/// A method with a signature of its own, which stubs are made from.
template <class F, class... Extra>
void method_as(const std::string& signature, const Class& of, const char* name, const F& f,
               const Extra&... extra) {
  py::options options;
  options.disable_function_signatures();
  method(of, name, f, signature.c_str(), extra...);
}

py::tuple field_rows(const Table& table) {
  py::list out;
  if (table.name >= 0) {
    out.append(FieldRow{"name", "text", "name", "", "", py::tuple(), true, py::none(), py::dict()});
  }
  for (const Entry& f : table.entries) {
    out.append(FieldRow{
        f.name, f.type->name, text_of(f.role), f.unit, f.text, py::tuple(py::cast(f.type->shape)), f.required,
        f.required ? py::none() : f.type->seen(&at(table.usual, f.get)), in_words(f.bound), f.least, f.most});
  }
  return py::tuple(out);
}

/// The line from which stubs are made.
std::string signature(const Table& table) {
  std::string out = std::string("__init__(self") + (table.name >= 0 ? ", name: str" : "") + ", *";
  for (const Entry& f : table.entries) {
    out += std::string(", ") + f.name + ": " + f.type->given_as + (f.required ? "" : " = ...");
  }
  return out + table.more + ") -> None\n";
}

void take_parameters(const py::kwargs& given, const std::string& what, Parameters& out) {
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    out[name] = given::number_of(what + name, py::reinterpret_borrow<py::object>(value));
  }
}

/// The description of what was given, checked.
py::object made(const Table& table, const py::kwargs& given) {
  void* const value = table.of.copy(table.usual);
  py::object out = table.of.owner(value);
  std::string what = table.kind + ": ";
  const auto take = [&](const char* name) {
    return given.contains(name) ? py::object(given.attr("pop")(name)) : py::object();
  };
  if (table.name >= 0) {
    const py::object name = take("name");
    auto& text = at<std::string>(value, table.name);
    text = given::name_of(table.kind, name ? name : py::none());
    what = table.kind + " " + py::repr(py::str(text)).cast<std::string>() + ": ";
  }
  std::string known;
  for (const Entry& f : table.entries) {
    known += std::string(known.empty() ? "" : ", ") + f.name;
    if (const py::object entry = take(f.name)) {
      f.type->take(&at(value, f.get), what + f.name, entry);
    } else if (f.required) {
      throw py::type_error(what + "has no " + f.name + (*f.unit ? std::string(", ") + f.unit : "") +
                           "; give one");
    }
  }
  if (table.parameters >= 0) {
    take_parameters(given, what, at<Parameters>(value, table.parameters));
  } else if (!given.empty()) {
    const auto unknown = py::repr((*given.begin()).first).cast<std::string>();
    throw py::type_error(what + "has no entry " + unknown + "; it takes " + known);
  }
  return out;
}

/// What was given to make it, or would have been.
py::dict arguments(const Table& table, const void* value) {
  py::dict out;
  if (table.name >= 0) out["name"] = at<std::string>(value, table.name);
  for (const Entry& f : table.entries) out[f.name] = f.type->seen(&at(value, f.get));
  if (table.parameters >= 0) {
    for (const auto& [name, number] : at<Parameters>(value, table.parameters)) out[name.c_str()] = number;
  }
  return out;
}

bool same(const py::handle& one, const py::handle& two) {
  if (!py::isinstance<py::array>(one) || !py::isinstance<py::array>(two)) return one.equal(two);
  return py::module_::import("numpy").attr("array_equal")(one, two).cast<bool>();
}

bool same_items(const py::dict& one, const py::dict& two) {
  if (one.size() != two.size()) return false;
  for (const auto& [name, value] : one) {
    if (!two.contains(name) || !same(value, two[name])) return false;
  }
  return true;
}

/// A class that is compared by value must not be hashed by place.
void compared(const Class& of, const Arguments& arguments) {
  const auto copied = [of](const py::handle& self) { return of.owner(of.copy(value_of(of, self))); };
  const std::string name = name_of(of.type);
  method_as("__copy__(self: " + name + ") -> " + name + "\n", of, "__copy__", copied);
  method_as(
      "__deepcopy__(self: " + name + ", memo: dict) -> " + name + "\n", of, "__deepcopy__",
      [copied](const py::handle& self, const py::dict&) { return copied(self); }, py::arg("memo"));
  method_as("__hash__(self: " + name + ") -> int\n", of, "__hash__", [of](const py::handle& self) {
    value_of(of, self);
    return py::hash(of.type);
  });
  method(of, "__eq__", [of, arguments](const py::object& self, const py::object& other) -> py::object {
    if (!py::isinstance(other, of.type)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(same_items(arguments(self), arguments(other)));
  });
}

void property(const Class& of, const char* name, const std::string& seen_as, const std::string& text,
              const std::function<py::object(const py::handle& self)>& get) {
  py::options options;
  options.disable_function_signatures();
  const std::string signature = "(arg0: " + name_of(of.type) + ") -> " + seen_as + "\n";
  const py::cpp_function getter(get, py::is_method(of.type), signature.c_str());
  const py::handle type(reinterpret_cast<PyObject*>(&PyProperty_Type));
  py::setattr(of.type, name, type(getter, py::none(), py::none(), text));
}

void bind_properties(const Table& table) {
  const Class& of = table.of;
  if (table.name >= 0) {
    property(of, "name", "str", "", [&](const py::handle& self) -> py::object {
      return py::str(at<std::string>(value_of(of, self), table.name));
    });
  }
  for (const Entry& f : table.entries) {
    if (f.type->seen_as.empty()) continue;
    const std::string unit = f.unit, text = f.text;
    property(of, f.name, f.type->seen_as, unit + (unit.empty() || text.empty() ? "" : ", ") + text,
             [&](const py::handle& self) { return f.type->seen(&at(value_of(of, self), f.get)); });
  }
}

}  // namespace

const char* text_of(Role role) {
  constexpr const char* names[] = {"value", "body", "joint", "coordinate", "distance"};
  return names[static_cast<std::size_t>(role)];
}

py::dict in_words(const Bound& bound) {
  py::dict out;
  if (std::isfinite(bound.minimum)) out[bound.above ? "exclusiveMinimum" : "minimum"] = bound.minimum;
  if (std::isfinite(bound.maximum)) out[bound.below ? "exclusiveMaximum" : "maximum"] = bound.maximum;
  return out;
}

void by_arguments(const Class& of, const Arguments& arguments, const Made& made) {
  compared(of, arguments);
  method(of, "__getstate__", arguments, py::pos_only());
  method(
      of, "__setstate__",
      [of, made](value_and_holder& self, const py::dict& given) {
        self.value_ptr() = of.copy(of.value(made(given)));
      },
      py::detail::is_new_style_constructor());
}

void bind(const Table& table) {
  const Class& of = table.of;
  method_as(
      signature(table), of, "__init__",
      [&](value_and_holder& self, const py::args& name, const py::kwargs& given) {
        if (name.size() > (table.name < 0 || given.contains("name") ? 0 : 1)) {
          throw py::type_error(table.kind + ": takes keywords; name all but the first, its name");
        }
        if (!name.empty()) given["name"] = name[0];
        self.value_ptr() = of.copy(of.value(made(table, given)));
      },
      py::detail::is_new_style_constructor());
  bind_properties(table);
  const auto told = [&](const py::object& self) { return arguments(table, value_of(of, self)); };
  if (std::ranges::any_of(table.entries, [](const Entry& f) { return f.type->seen_as.empty(); })) {
    compared(of, told);
    method(of, "__reduce__", [&](const py::object& self) -> py::object {
      throw std::invalid_argument(table.kind + " '" + self.attr("name").cast<std::string>() +
                                  "': its C function has no address in another process; add it there");
    });
  } else {
    by_arguments(of, told, [&](const py::dict& given) { return made(table, py::kwargs(given)); });
  }
  py::setattr(of.type, "FIELDS", field_rows(table));
}

void bind_example(const py::object& type, py::object (*example)()) {
  py::options options;
  options.disable_function_signatures();
  const auto doc =
      "example() -> " + name_of(type) + "\n\nOne for checks, on bodies 'first', 'second' and 'third'.\n";
  type.attr("example") =
      py::staticmethod(py::cpp_function(example, py::name("example"), py::scope(type), doc.c_str()));
}

}  // namespace description
