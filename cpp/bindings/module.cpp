#include <exception>

#include "bindings.hpp"
#include "given.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/integrate/integrator.hpp"
#include "seacrane/run/contacts.hpp"
#include "seacrane/run/switches.hpp"
#include "without_gil.hpp"

namespace {

/// C++ exceptions become the classes of seacrane.errors.
void translate(std::exception_ptr pointer) {
  const auto raise = [](const char* name, const char* what) {
    const py::object type = py::module_::import("seacrane.errors").attr(name);
    PyErr_SetString(type.ptr(), what);
  };
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const given::Refused& error) {
    const py::object type = py::module_::import("seacrane.errors").attr("SceneError");
    PyErr_SetObject(type.ptr(), type.attr("of")(error.value, error.text).ptr());
  } catch (const std::invalid_argument& error) {  // SceneError too
    raise("SceneError", error.what());
  } catch (const seacrane::ChatteringError& error) {
    raise("ChatteringError", error.what());
  } catch (const seacrane::LineSlackError& error) {
    raise("LineSlackError", error.what());
  } catch (const seacrane::IntegrationError& error) {
    raise("SimulationError", error.what());
  } catch (const std::domain_error& error) {
    raise("SimulationError", error.what());
  }
}

/// What users hold tells what it is, in one way (seacrane.inputs.described) for all.
void bind_repr(const py::module_& m) {
  const py::object described = py::cpp_function(
      [](const py::object& self) {
        return py::module_::import("seacrane.inputs.described").attr("described")(self).cast<std::string>();
      },
      py::name("__repr__"), py::arg("self"));
  for (const auto& [name, member] : m.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(member.ptr()) || member.attr("__dict__").contains("__repr__")) continue;
    py::setattr(member, "__repr__", py::reinterpret_steal<py::object>(PyInstanceMethod_New(described.ptr())));
  }
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "Compiled core of seacrane: descriptions, compiled model, stepping loop. SI units, radians.";
  py::register_exception_translator(&translate);
  bind_curve(m);
  bind_given(m);
  bind_sea(m);
  bind_elements(m);
  bind_model(m);
  bind_integrators(m);
  bind_channels(m);
  bind_simulation(m);
  bind_lanes(m);
  bind_strip(m);
  bind_repr(m);
  bind_copies();
  bind_exit();
}
