#include "seacrane/elements/loads/flow_force.hpp"

#include "bindings.hpp"

using namespace seacrane;

void bind_flow_force(py::module_& m) {
  using F = FlowForceDescription;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  py::class_<F>(m, "FlowForce",
                R"(Wind or current on a body by coefficients; see seacrane.add_wind and seacrane.add_current.

F_x, F_y = density / 2 V^2 (C_x frontal_area, C_y lateral_area), N = density / 2 V^2 C_n lateral_area length, V the
horizontal flow relative to `point`, in axes that follow the body's yaw; C over `angles` (rad), where the relative
flow goes, from the bow towards port, by periodic cubic splines. Immutable.)")
      .def(py::init([](std::string name, std::string body, Vec3d point, double density, Curve speed,
                       double direction, double frontal_area, double lateral_area, double length,
                       std::vector<double> angles, const Rows& coefficients) {
             std::vector<Vec3d> rows;
             for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
               rows.emplace_back(coefficients.row(i).transpose());
             return F{std::move(name),  std::move(body),   point,          density,
                      std::move(speed), direction,         frontal_area,   lateral_area,
                      length,           std::move(angles), std::move(rows)};
           }),
           py::kw_only(), py::arg("name"), py::arg("body"), py::arg("point"), py::arg("density"),
           py::arg("speed"), py::arg("direction"), py::arg("frontal_area"), py::arg("lateral_area"),
           py::arg("length"), py::arg("angles"), py::arg("coefficients"))
      .def_property_readonly("name", [](const F& d) { return d.name; })
      .def_property_readonly("body", [](const F& d) { return d.body; })
      .def_property_readonly(
          "point", [](const F& d) { return d.point; }, "m, body coordinates (copy)")
      .def_property_readonly(
          "density", [](const F& d) { return d.density; }, "kg/m3")
      .def_property_readonly(
          "speed", [](const F& d) { return d.speed; }, "Curve, m/s")
      .def_property_readonly(
          "direction", [](const F& d) { return d.direction; }, "rad, where the flow goes, from +x towards +y")
      .def_property_readonly(
          "frontal_area", [](const F& d) { return d.frontal_area; }, "m2")
      .def_property_readonly(
          "lateral_area", [](const F& d) { return d.lateral_area; }, "m2")
      .def_property_readonly(
          "length", [](const F& d) { return d.length; }, "m")
      .def_property_readonly(
          "angles", [](const F& d) { return d.angles; }, "rad")
      .def_property_readonly(
          "coefficients",
          [](const F& d) {
            Rows rows(static_cast<Eigen::Index>(d.coefficients.size()), 3);
            for (std::size_t i = 0; i < d.coefficients.size(); ++i)
              rows.row(static_cast<Eigen::Index>(i)) = d.coefficients[i].transpose();
            return rows;
          },
          "C_x, C_y, C_n, shape (n, 3) (copy)");
}
