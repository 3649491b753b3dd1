#include "seacrane/sea/wave_components.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sea_arrays.hpp"
#include "seacrane/sea/require.hpp"
#include "seacrane/sea/wave_kinematics.hpp"
#include "vector_state.hpp"

using namespace seacrane;

namespace {

const char* const object = "wave components";

/// One value for all components, or one for each.
std::vector<double> spread(const Doubles& a, std::size_t count, const std::string& name) {
  return a.ndim() == 0 ? std::vector<double>(count, *a.data()) : to_vector(a, object, name);
}

/// Read-only view of a vector that `owner` keeps alive.
template <const std::vector<double>& (WaveComponents::*member)() const>
py::array view(const py::object& owner) {
  const std::vector<double>& values = (owner.cast<const WaveComponents&>().*member)();
  py::array_t<double> out(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}

/// Array of `shape` followed by `width`, unless that is one.
template <class Value>
py::array_t<Value> shaped_like(const Doubles& points, py::ssize_t width) {
  std::vector<py::ssize_t> shape(points.shape(), points.shape() + points.ndim());
  if (width > 1) shape.push_back(width);
  return py::array_t<Value>(shape);
}

void require_finite_points(const std::vector<Doubles>& points) {
  for (const Doubles& one : points) {
    for (py::ssize_t i = 0; i < one.size(); ++i) {
      sea::require(std::isfinite(one.data()[i]), "wave components", "a time or coordinate", one.data()[i],
                   "give finite numbers, times in s, coordinates in m");
    }
  }
}

py::array_t<double> elevation(const WaveComponents& waves, const py::object& times, const py::object& x,
                              const py::object& y) {
  const std::vector<Doubles> at = broadcast(times, x, y, py::float_(0.0));
  require_finite_points(at);
  auto out = shaped_like<double>(at[0], 1);
  double* target = out.mutable_data();
  const py::ssize_t count = out.size();
  const double *t = at[0].data(), *px = at[1].data(), *py_ = at[2].data();
  const WithoutGil released;
  clear_vector_state();
  for (py::ssize_t i = 0; i < count; ++i) target[i] = waves.elevation(t[i], px[i], py_[i]);
  return out;
}

struct WaveKinematics {
  py::array_t<double> elevation, velocity, acceleration, dynamic_pressure;
  py::array_t<bool> submerged;
};

/// Every point above any crest that this sea can have: a depth where z, upwards, is due.
void warn_of_air(const WaveComponents& waves, const Doubles& z) {
  double crest = 0.0;
  for (const double amplitude : waves.amplitude()) crest += std::abs(amplitude);
  const double* end = z.data() + z.size();
  const double* lowest = std::min_element(z.data(), end);
  if (lowest == end || *lowest <= crest) return;
  py::module_::import("seacrane.inputs.plausible").attr("warn_of_air")(*lowest, crest);
}

WaveKinematics kinematics_at(const WaveComponents& waves, const py::object& time, const py::object& x,
                             const py::object& y, const py::object& z, const std::string& stretching,
                             double density) {
  const std::vector<Doubles> at = broadcast(time, x, y, z);
  require_finite_points(at);
  sea::require_positive(density, "wave kinematics", "density", "kg/m3");
  const Stretching kind = stretching_of(stretching);
  warn_of_air(waves, at[3]);
  WaveKinematics out{shaped_like<double>(at[0], 1), shaped_like<double>(at[0], 3),
                     shaped_like<double>(at[0], 3), shaped_like<double>(at[0], 1),
                     shaped_like<bool>(at[0], 1)};
  double *eta = out.elevation.mutable_data(), *v = out.velocity.mutable_data();
  double *a = out.acceleration.mutable_data(), *p = out.dynamic_pressure.mutable_data();
  bool* wet = out.submerged.mutable_data();
  const py::ssize_t count = at[0].size();
  const double *t = at[0].data(), *px = at[1].data(), *py_ = at[2].data(), *pz = at[3].data();
  const WithoutGil released;
  clear_vector_state();
  for (py::ssize_t i = 0; i < count; ++i) {
    const WaveParticle particle = kinematics(waves, t[i], px[i], py_[i], pz[i], kind);
    eta[i] = particle.elevation;
    std::copy_n(particle.velocity.data(), 3, v + 3 * i);
    std::copy_n(particle.acceleration.data(), 3, a + 3 * i);
    p[i] = density * particle.pressure_per_density;
    wet[i] = particle.submerged;
  }
  return out;
}

}  // namespace

void bind_wave_components(py::module_& m) {
  py::class_<RepeatPeriod>(m, "RepeatPeriod", "Answer of `WaveComponents.repeat_period`.")
      .def_readonly("time", &RepeatPeriod::time, "First repeat, or the proven lower bound of it, s.")
      .def_readonly("found", &RepeatPeriod::found, "Whether the sea repeats at `time`.")
      .def("__repr__", [](const RepeatPeriod& r) {
        return py::str("RepeatPeriod(time={}, found={})").format(r.time, r.found);
      });

  py::class_<WaveKinematics>(m, "WaveKinematics",
                             "Answer of `WaveComponents.kinematics`. Arrays of the shape of the points; "
                             "vectors have three inertial components last. In air velocity, acceleration "
                             "and pressure are zero.")
      .def_readonly("elevation", &WaveKinematics::elevation, "m, of the surface above the point")
      .def_readonly("velocity", &WaveKinematics::velocity, "m/s, with the current")
      .def_readonly("acceleration", &WaveKinematics::acceleration,
                    "m/s2, of the water, first order: partial derivative in time, and along a current")
      .def_readonly("dynamic_pressure", &WaveKinematics::dynamic_pressure,
                    "Pa, without the hydrostatic -density g z")
      .def_readonly("submerged", &WaveKinematics::submerged, "Whether the point is below the surface.");

  py::class_<WaveComponents, std::shared_ptr<WaveComponents>>(
      m, "WaveComponents",
      R"(Regular waves whose sum is the sea; immutable.

Elevation = sum a cos(omega t - k (x cos b + y sin b) + phase), inertial frame (x forward, y port), b the
direction of travel from +x towards +y. Arrays are read-only views of shape (components,).

Parameters
----------
omega : array_like, shape (n,)
    Frequencies, rad/s, above zero.
amplitude, phase, direction : float or array_like, shape (n,)
    m, rad, rad.
depth : float
    Water depth, m; infinity for deep water. Wavenumbers follow from omega^2 = g k tanh(k depth).
gravity : float
    m/s2.
current : Current, optional
    On which the waves travel: (omega - k U)^2 = g k tanh(k depth), see `Current.wavenumber`; omega is what a
    fixed observer sees.

Raises
------
ValueError
    A value is not finite or out of range, the lengths differ, or the current stops a wave.)")
      .def(py::init([](const Doubles& omega, const Doubles& amplitude, const Doubles& phase,
                       const Doubles& direction, double depth, double gravity,
                       const std::shared_ptr<Current>& current) {
             std::vector<double> w = to_vector(omega, object, "omega");
             const std::size_t n = w.size();
             return WaveComponents(std::move(w), spread(amplitude, n, "amplitude"), spread(phase, n, "phase"),
                                   spread(direction, n, "direction"), depth, gravity,
                                   current ? *current : Current());
           }),
           py::kw_only(), py::arg("omega"), py::arg("amplitude"), py::arg("phase") = 0.0,
           py::arg("direction") = 0.0, py::arg_v("depth", infinity, "float('inf')"),
           py::arg("gravity") = standard_gravity, py::arg("current") = py::none())
      .def("__len__", &WaveComponents::size)
      .def_property_readonly("omega", &view<&WaveComponents::omega>, "rad/s")
      .def_property_readonly("wavenumber", &view<&WaveComponents::wavenumber>, "rad/m")
      .def_property_readonly("intrinsic", &view<&WaveComponents::intrinsic>,
                             "rad/s, omega - k U: with which the water moves")
      .def_property_readonly("direction", &view<&WaveComponents::direction>, "rad, travelling to")
      .def_property_readonly("amplitude", &view<&WaveComponents::amplitude>, "m")
      .def_property_readonly("phase", &view<&WaveComponents::phase>, "rad")
      .def_property_readonly("depth", &WaveComponents::depth, "m")
      .def_property_readonly("gravity", &WaveComponents::gravity, "m/s2")
      .def_property_readonly("realised_hs", &WaveComponents::realised_hs,
                             "4 sqrt(m0) of the amplitudes, m: no sampling scatter.")
      .def_property_readonly(
          "m0", [](const WaveComponents& w) { return w.moment(0); }, "sum a^2 / 2, m2.")
      .def_property_readonly("mean_period", &WaveComponents::mean_period,
                             "Mean zero-upcrossing period 2 pi sqrt(m0 / m2), s.")
      .def("autocorrelation", py::vectorize(&WaveComponents::autocorrelation), py::arg("lag"),
           "Autocorrelation coefficient of the elevation at one point, for lags in s, any shape.")
      .def("repeat_period", &WaveComponents::repeat_period, py::arg("horizon") = 10800.0,
           py::call_guard<WithoutGil>(),
           "First time after the initial decay at which the autocorrelation is 0.99 again, s; `found` is "
           "False "
           "when it is proven that there is none before `horizon`.")
      .def("elevation", &elevation, py::arg("times"), py::kw_only(), py::arg("x") = 0.0, py::arg("y") = 0.0,
           "Wave elevation (m) at times (s) and points (m, inertial frame), broadcast against each other.")
      .def("kinematics", &kinematics_at, py::kw_only(), py::arg("time"), py::arg("x"), py::arg("y"),
           py::arg("z"), py::arg("stretching") = "wheeler", py::arg("density") = 1025.0,
           R"(Undisturbed wave at points by linear theory, for finite or infinite depth.

Parameters
----------
time, x, y, z : array_like, broadcast against each other
    s; m, inertial frame, z up from the still water.
stretching : str
    How linear theory, which ends at z = 0, is taken to the moving surface. "wheeler" (default): at
    z' = (z - elevation) / (1 + elevation / depth), so that the pressure vanishes at the surface. "none": linear
    theory itself up to z = 0, the values of z = 0 above it.
density : float
    kg/m3, for the pressure.

Returns
-------
WaveKinematics

Raises
------
ValueError
    A value is not finite, a point lies below the sea floor, or `stretching` is unknown.

Notes
-----
J. D. Wheeler, "Method for calculating forces produced by irregular waves", J. Petroleum Technology 22, 1970;
DNV-RP-C205, 3.3.)")
      .def("__repr__", [](const WaveComponents& w) {
        return py::str("WaveComponents({} components, realised_hs={:.4g} m)")
            .format(w.size(), w.realised_hs());
      });
}
