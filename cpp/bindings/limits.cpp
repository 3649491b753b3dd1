#include "bindings.hpp"
#include "seacrane/model/description.hpp"

using namespace seacrane;

namespace {

/// Properties that all elements on a joint coordinate have.
template <class D>
void bind_place(py::class_<D>& type) {
  type.def_property_readonly("name", [](const D& d) { return d.name; })
      .def_property_readonly("joint", [](const D& d) { return d.coordinate.joint; })
      .def_property_readonly("coordinate", [](const D& d) { return d.coordinate.coordinate; });
}

}  // namespace

void bind_limits(py::module_& m) {
  using L = LimitDescription;
  py::class_<L> limit(
      m, "Limit",
      "What a joint does one way only; see seacrane.add_wire, add_end_stop and add_seat. Kinds: "
      "wire, stop, seat. Bounds in m or rad, at +-1e7 none; sticking_speed in m/s or rad/s. "
      "Immutable.");
  limit.def(py::init([](std::string name, std::string kind, std::string joint, std::string coordinate,
                        double minimum, double maximum, double restitution, double sticking_speed) {
              return L{std::move(name), std::move(kind), {std::move(joint), std::move(coordinate)},
                       minimum,         maximum,         restitution,
                       sticking_speed};
            }),
            py::kw_only(), py::arg("name"), py::arg("kind"), py::arg("joint"), py::arg("coordinate") = "",
            py::arg("minimum") = -kNoStop, py::arg("maximum") = kNoStop, py::arg("restitution") = 0.0,
            py::arg("sticking_speed") = L().sticking_speed);
  bind_place(limit);
  limit.def_property_readonly("kind", [](const L& d) { return d.kind; })
      .def_property_readonly("minimum", [](const L& d) { return d.minimum; })
      .def_property_readonly("maximum", [](const L& d) { return d.maximum; })
      .def_property_readonly("restitution", [](const L& d) { return d.restitution; })
      .def_property_readonly("sticking_speed", [](const L& d) { return d.sticking_speed; });

  using F = FrictionDescription;
  py::class_<F> friction(
      m, "Friction",
      "Dry friction on a joint coordinate: -load tanh(rate / speed), load in N or N m, speed "
      "in m/s or rad/s; see seacrane.add_friction. Immutable.");
  friction.def(
      py::init([](std::string name, std::string joint, std::string coordinate, double load, double speed) {
        return F{std::move(name), {std::move(joint), std::move(coordinate)}, load, speed};
      }),
      py::kw_only(), py::arg("name"), py::arg("joint"), py::arg("coordinate"), py::arg("load"),
      py::arg("speed"));
  bind_place(friction);
  friction.def_property_readonly("load", [](const F& d) { return d.load; })
      .def_property_readonly("speed", [](const F& d) { return d.speed; });

  using S = SoftStopDescription;
  py::class_<S> stop(
      m, "SoftStop",
      "Compliant bounds of a joint coordinate: stiffness p (1 + damping p') back where it is beyond "
      "one by p, never a pull; N/m and s/m, or N m/rad and s/rad; see seacrane.add_soft_stop. "
      "Immutable.");
  stop.def(py::init([](std::string name, std::string joint, std::string coordinate, double minimum,
                       double maximum, double stiffness, double damping) {
             return S{std::move(name), {std::move(joint), std::move(coordinate)}, minimum, maximum, stiffness,
                      damping};
           }),
           py::kw_only(), py::arg("name"), py::arg("joint"), py::arg("coordinate"),
           py::arg("minimum") = -kFarthest, py::arg("maximum") = kFarthest, py::arg("stiffness"),
           py::arg("damping") = 0.0);
  bind_place(stop);
  stop.def_property_readonly("minimum", [](const S& d) { return d.minimum; })
      .def_property_readonly("maximum", [](const S& d) { return d.maximum; })
      .def_property_readonly("stiffness", [](const S& d) { return d.stiffness; })
      .def_property_readonly("damping", [](const S& d) { return d.damping; });
}
