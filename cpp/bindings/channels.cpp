#include <Eigen/Geometry>

#include "bindings.hpp"
#include "seacrane/run/channels/channel.hpp"
#include "seacrane/run/channels/registry.hpp"

using namespace seacrane;

namespace {

std::vector<std::string> dims_of(const Channel& channel, bool of_several) {
  std::vector<std::string> out;
  for (const Axis* axis : channel.axes) {
    if (of_several || !axis->only_if_several) out.push_back(axis->name);
  }
  return out;
}

using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;

Rows turned(const Rows& quaternion, const Rows& vector) {
  if (quaternion.ndim() != 2 || quaternion.shape(1) != 4 || vector.size() != 3) {
    throw py::value_error("turned: give quaternions (n, 4) and a vector (3,)");
  }
  Rows out({quaternion.shape(0), py::ssize_t{3}});
  const Eigen::Map<const Eigen::Vector3d> v(vector.data());
  for (py::ssize_t i = 0; i < quaternion.shape(0); ++i) {
    const double w = *quaternion.data(i, 0);
    const Eigen::Map<const Eigen::Vector3d> axis(quaternion.data(i, 1));
    const Eigen::Vector3d across = axis.cross(v);
    Eigen::Map<Eigen::Vector3d>(out.mutable_data(i, 0)) = v + 2.0 * (w * across + axis.cross(across));
  }
  return out;
}

}  // namespace

void bind_channels(py::module_& m) {
  py::class_<Channel>(m, "Channel", "A quantity that can be recorded.")
      .def_readonly("name", &Channel::name)
      .def_property_readonly(
          "dims", [](const Channel& c) { return dims_of(c, false); }, "Dimensions after time.")
      .def_property_readonly(
          "dims_of_several", [](const Channel& c) { return dims_of(c, true); },
          "The same where a scene holds several of what it has one of otherwise, such as vessels.")
      .def_readonly("unit", &Channel::unit)
      .def_readonly("text", &Channel::text)
      .def_property_readonly(
          "has_extremes", [](const Channel& c) { return has_extremes(c); },
          "Whether least and largest values between outputs can be kept of it.")
      .def_readonly("by_default", &Channel::by_default, "Whether it is recorded unasked.");
  m.def(
      "channels", [] { return all_channels(); }, "Every channel there is, in the order of results.");
  m.def(
      "axes",
      [] {
        std::map<std::string, std::vector<std::string>> out;
        for (const Channel& channel : all_channels()) {
          for (const Axis* axis : channel.axes) out[axis->name] = axis->labels;
        }
        return out;
      },
      "The names along each dimension of channels but time; none: those of a scene, `Model.axes`.");
  m.def("turned", &turned, py::arg("quaternion"), py::arg("vector"),
        "A vector (3,) of a body in the inertial frame (n, 3), by its quaternions (n, 4).");
}
