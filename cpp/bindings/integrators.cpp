#include "bindings.hpp"
#include "seacrane/integrate/registry.hpp"

using namespace seacrane;

void bind_integrators(py::module_& m) {
  using P = IntegratorProperties;
  py::class_<P>(m, "Integrator", "What an integration method is; see `integrators`.")
      .def_readonly("name", &P::name, "By which `simulate` takes it.")
      .def_readonly("kind", &P::kind, "What it is, in words.")
      .def_readonly("purpose", &P::purpose, "What it is there for, in words.")
      .def_readonly("joints", &P::joints, "How it keeps joints closed, in words.")
      .def_readonly("order", &P::order, "The highest one for a method of variable order.")
      .def_readonly("lowest_order", &P::lowest_order, "That of `order`, unless the order varies.")
      .def_readonly("error_order", &P::error_order,
                    "Of the embedded method that estimates the error; 0: there is none.")
      .def_readonly("dense_order", &P::dense_order, "Of the solution inside a step; 0: it varies.")
      .def_property_readonly(
          "setting", [](const P& p) { return p.is_adaptive() ? "rtol" : "dt"; },
          "What sets its accuracy: \"rtol\", or the \"dt\" of its steps.")
      .def_property_readonly(
          "default",
          [](const P& p) {
            return p.is_adaptive() ? IntegratorOptions{}.relative_tolerance : p.default_step;
          },
          "That setting without a choice of the user: a tolerance, or s.")
      .def_readonly(
          "stable_up_to", &P::stable_up_to,
          "|eigenvalue| times step up to which an oscillation does not grow, of explicit methods of "
          "fixed step; 0: no such limit.")
      .def_readonly("uses_jacobian", &P::uses_jacobian,
                    "It solves with the Jacobian, so that fast modes do not limit its steps.")
      .def_readonly("residual_form", &P::residual_form,
                    "It solves the residual form, which formulation \"redundant\" has.")
      .def_readonly("restarts", &P::restarts,
                    "It loses its history where a run continues from a state, or is changed.")
      .def_readonly("has_spectral_radius", &P::has_spectral_radius, "`spectral_radius` can be chosen.");
  m.def("integrators", &integrators, "All integration methods, in the order of the documents: a new list.");
  m.def("integrator", &integrator_of, py::arg("name"),
        "The one of that name; SceneError where there is none.");
  m.def(
      "integrator_names",
      [] {
        std::vector<std::string> names;
        for (const P& method : integrators()) names.emplace_back(method.name);
        return names;
      },
      "Their names alone.");
  m.def("stability_polynomial", &stability_polynomial, py::arg("integrator"),
        "Coefficients of the stability polynomial of an explicit Runge-Kutta method, lowest power first: a "
        "step "
        "h of y' = lambda y multiplies y by R(h lambda). Empty for an integrator that has no tableau here.");
}
