#pragma once

#include "bindings.hpp"
#include "seacrane/elements/loads/load_kind.hpp"

/// What Python has of one kind of load.
struct LoadBinding {
  py::object (*bind)(py::module_& m);
  /// Adds a description of the kind; whether it is one.
  bool (*add)(seacrane::LoadDescriptions& loads, const py::object& object);
};

/// Made in the object of that load.
template <class Load>
const LoadBinding& load_binding();

/// Sorts a description to its kind. Raises where there is none.
void add_load(seacrane::LoadDescriptions& loads, const py::object& object);
