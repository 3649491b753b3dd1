#pragma once

#include "description.hpp"
#include "load_binding.hpp"
#include "seacrane/elements/loads/proportion.hpp"
#include "seacrane/elements/loads/span.hpp"

template <class Load>
const LoadBinding& load_binding() {
  using Description = typename Load::Description;
  static const LoadBinding out{
      .bind = [](py::module_& m) -> py::object {
        auto type = description::bind<Description>(m, Load::kind);
        description::bind_example(type, [] { return py::cast(Load::example()); });
        if constexpr (requires(const Description& d, const seacrane::Vec3d& x) {
                        d.shape().template at<double>(x);
                      }) {
          type.def(
              "distance",
              [](const Description& d, const seacrane::Vec3d& point) {
                const auto found = d.shape().template at<double>(point);
                return std::pair(found.distance, found.normal);
              },
              pybind11::arg("point"),
              "How far a point in axes of the surface, from its place, is outside (m; negative: inside), and "
              "the way out.");
        }
        type.attr("STIFF") = seacrane::StiffLoad<Load>;
        type.attr("OWN_PACE") = requires { requires Load::own_pace; };
        type.attr("PASSIVE") = requires { requires Load::passive; };
        type.attr("HOLDS") = requires { requires Load::holds; };
        type.attr("DRAWN") = [] {
          if constexpr (requires { Load::drawn; }) return Load::drawn;
          return std::is_base_of_v<seacrane::SpanDescription, Description> ? "spring" : "";
        }();
        py::list proportions;
        if constexpr (requires { Load::proportions; }) {
          for (const seacrane::Proportion& one : Load::proportions) {
            proportions.append(py::make_tuple(one.field, one.beside, one.makes, one.least, one.most));
          }
        }
        type.attr("PROPORTIONS") = py::tuple(proportions);
        return type;
      },
      .add =
          [](seacrane::LoadDescriptions& loads, const py::object& object) {
            const bool is_one = py::isinstance<Description>(object);
            if (is_one) loads.of<Load>().push_back(object.cast<Description>());
            return is_one;
          },
  };
  return out;
}
