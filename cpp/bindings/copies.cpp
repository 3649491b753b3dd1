#include <string>
#include <vector>

#include "bindings.hpp"
#include "description.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/model/description.hpp"
#include "seacrane/run/simulation.hpp"

using namespace seacrane;

using namespace description;

namespace {

/// By the arguments of the constructor, each of which can be read under its name.
template <class T>
void by_names(std::vector<std::string> names) {
  by_arguments(
      class_of<T>(),
      [names = std::move(names)](const py::object& self) {
        py::dict out;
        for (const std::string& name : names) out[name.c_str()] = self.attr(name.c_str());
        return out;
      },
      [type = py::type::of<T>()](const py::dict& given) -> py::object { return type(**given); });
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
  by_arguments(
      class_of<Curve>(), [](const py::object& self) { return py::dict(self.attr("to_pieces")()); },
      [](const py::dict& given) -> py::object { return py::type::of<Curve>().attr("pieces")(**given); });
  by_names<RetardationFunctions>({"step", "kernel"});
  by_names<StateSpaceBlock>({"inputs", "outputs", "a", "b", "c", "d", "state_scale"});
  by_names<TwistHistory>({"start", "intervals", "recent", "quadrature"});
  by_names<StepHistory>({"formulation", "integrator", "values", "rate", "kink"});
  by_names<RecordHistory>(
      {"start_energy", "start_work", "residual", "impact_loss", "quaternions", "extremes"});
  by_names<State>({"time", "values", "inputs", "histories", "steps", "closed", "record", "parts"});
  copy_models();
}
