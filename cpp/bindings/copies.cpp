#include <string>
#include <vector>

#include "bindings.hpp"
#include "seacrane/elements/loads/flow_force.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/model/description.hpp"
#include "seacrane/run/simulation.hpp"

using namespace seacrane;

namespace {

bool same(const py::handle& one, const py::handle& two) {
  if (!py::isinstance<py::array>(one) || !py::isinstance<py::array>(two)) return one.equal(two);
  return py::module_::import("numpy").attr("array_equal")(one, two).cast<bool>();
}

bool same_items(const py::dict& one, const py::dict& two) {
  for (const auto& [name, value] : one) {
    if (!same(value, two[name])) return false;
  }
  return true;
}

template <class T>
py::class_<T> bound() {
  return py::reinterpret_borrow<py::class_<T>>(py::type::of<T>());
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

/// Values that are copied, pickled and compared by what `arguments` tells of them, from which `made` makes
/// them again.
template <class T, class Arguments, class Made>
void by_arguments(const Arguments& arguments, const Made& made) {
  copied<T>();
  bound<T>()
      .def(py::pickle(arguments, made))
      .def("__eq__", [arguments](const py::object& self, const py::object& other) -> py::object {
        if (!py::isinstance<T>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
        return py::bool_(same_items(arguments(self), arguments(other)));
      });
}

/// By the arguments of the constructor, each of which can be read under its name.
template <class T>
void by_arguments(const std::vector<std::string>& names) {
  by_arguments<T>(
      [names](const py::object& self) {
        py::dict out;
        for (const std::string& name : names) out[name.c_str()] = self.attr(name.c_str());
        return out;
      },
      [](const py::dict& given) { return py::type::of<T>()(**given).template cast<T>(); });
}

void copy_function_forces() {
  using F = FunctionForceDescription;
  copied<F>();
  bound<F>()
      .def("__reduce__",
           [](const F& self) -> py::object {
             throw std::invalid_argument("function force '" + self.name +
                                         "': its C function has no address in another process; add it there");
           })
      .def("__eq__", [](const F& self, const py::object& other) -> py::object {
        if (!py::isinstance<F>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
        const F& two = other.cast<const F&>();
        return py::bool_(self.name == two.name && self.body == two.body && self.function == two.function &&
                         self.parameters == two.parameters);
      });
}

/// A model does not change: it is its own copy, and is pickled as the scene that it was compiled from.
void copy_models() {
  auto type = py::reinterpret_borrow<py::class_<Model, std::shared_ptr<Model>>>(py::type::of<Model>());
  type.def("__copy__", [](const py::object& self) { return self; })
      .def(
          "__deepcopy__", [](const py::object& self, const py::dict&) { return self; }, py::arg("memo"))
      .def_property(
          "compiled_from", [](const py::object& self) { return py::tuple(self.attr("__dict__")["scene"]); },
          [](const py::object& self, const py::tuple& scene) { self.attr("__dict__")["scene"] = scene; },
          "The scene as it was, and whether bodies were merged.")
      .def("__reduce__", [](const py::object& self) {
        const py::object compiled = py::module_::import("seacrane.description.compilation").attr("compiled");
        return py::make_tuple(compiled, py::tuple(self.attr("compiled_from")));
      });
}

}  // namespace

void bind_copies() {
  by_arguments<Curve>(
      [](const py::object& self) { return py::dict(self.attr("to_pieces")()); },
      [](const py::dict& given) { return py::type::of<Curve>().attr("pieces")(**given).cast<Curve>(); });
  by_arguments<BodyDescription>({"name", "mass", "inertia", "center_of_mass", "position", "quaternion",
                                 "velocity", "angular_velocity", "gravity"});
  by_arguments<Frame>({"point", "axes"});
  by_arguments<JointDescription>(
      {"name", "kind", "first", "second", "first_frame", "second_frame", "length"});
  by_arguments<DriverDescription>({"name", "joint", "coordinate", "curve"});
  by_arguments<ActuatorDescription>(
      {"name", "joint", "coordinate", "stiffness", "damping", "feed_forward", "reference"});
  by_arguments<PointForceDescription>({"name", "body", "point", "force", "body_axes"});
  by_arguments<SpringDescription>({"name", "first", "second", "first_point", "second_point", "stiffness",
                                   "damping", "natural_length", "lengths", "forces"});
  by_arguments<ForceTableDescription>({"name", "body", "point", "times", "wrenches"});
  copy_function_forces();
  by_arguments<FlowForceDescription>({"name", "body", "point", "density", "speed", "direction",
                                      "frontal_area", "lateral_area", "length", "angles", "coefficients"});
  by_arguments<LimitDescription>(
      {"name", "kind", "joint", "coordinate", "minimum", "maximum", "restitution", "sticking_speed"});
  by_arguments<FrictionDescription>({"name", "joint", "coordinate", "load", "speed"});
  by_arguments<SoftStopDescription>(
      {"name", "joint", "coordinate", "minimum", "maximum", "stiffness", "damping"});
  by_arguments<RetardationFunctions>({"step", "kernel"});
  by_arguments<StateSpaceBlock>({"inputs", "outputs", "a", "b", "c", "d", "state_scale"});
  by_arguments<VesselDescription>({"name", "body", "added_mass", "linear_damping", "quadratic_damping",
                                   "restoring", "mooring_stiffness", "mooring_damping", "memory",
                                   "kinematics"});
  by_arguments<TwistHistory>({"start", "intervals", "recent", "quadrature"});
  by_arguments<StepHistory>({"formulation", "integrator", "values", "rate"});
  by_arguments<RecordHistory>({"start_energy", "start_work", "open", "impact_loss", "quaternions"});
  by_arguments<State>({"time", "values", "inputs", "histories", "steps", "closed", "record", "parts"});
  copy_models();
}
