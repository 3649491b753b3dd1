#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sea_arrays.hpp"
#include "seacrane/sea/philox.hpp"
#include "seacrane/sea/realisation.hpp"
#include "seacrane/sea/spectrum.hpp"

using namespace seacrane;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An integer of Python or NumPy; anything else, or one out of range, is a ValueError with the fix.
std::uint64_t whole_number(const py::object& value, const std::string& name, std::uint64_t smallest,
                           std::uint64_t largest) {
  const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  unsigned long long number = 0;
  bool valid = static_cast<bool>(index);
  if (valid) {
    number = PyLong_AsUnsignedLongLong(index.ptr());
    valid = PyErr_Occurred() == nullptr && number >= smallest && number <= largest;
  }
  PyErr_Clear();
  if (!valid) {
    throw py::value_error("wave realisation: " + name + " is " + py::repr(value).cast<std::string>() +
                          "; give a whole number from " + std::to_string(smallest) + " to " +
                          std::to_string(largest));
  }
  return number;
}

std::vector<double> to_vector(const Doubles& a, const std::string& name) {
  if (a.ndim() != 1) {
    throw py::value_error("wave components: " + name + " has " + std::to_string(a.ndim()) +
                          " dimensions; give a one-dimensional array");
  }
  return {a.data(), a.data() + a.size()};
}

/// One value for all components, or one for each.
std::vector<double> spread(const Doubles& a, std::size_t count, const std::string& name) {
  return a.ndim() == 0 ? std::vector<double>(count, *a.data()) : to_vector(a, name);
}

/// Read-only view of a vector that `owner` keeps alive.
template <const std::vector<double>& (WaveComponents::*member)() const>
py::array view(const py::object& owner) {
  const std::vector<double>& values = (owner.cast<const WaveComponents&>().*member)();
  py::array_t<double> out(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}

void bind_spectrum(py::module_& m) {
  py::class_<Spectrum, std::shared_ptr<Spectrum>>(m, "Spectrum",
                                                  "One-sided wave spectrum S(omega) in m2 s/rad, normalised "
                                                  "by quadrature to hs^2 / 16. Made by `jonswap` "
                                                  "or `pierson_moskowitz`.")
      .def_property_readonly("name", &Spectrum::name)
      .def_property_readonly("hs", &Spectrum::hs, "Significant wave height, m.")
      .def_property_readonly("tp", &Spectrum::tp, "Peak period, s.")
      .def_property_readonly("gamma", &Spectrum::gamma, "Peak enhancement; 1 for Pierson-Moskowitz.")
      .def_property_readonly("peak_omega", &Spectrum::peak_omega, "Peak frequency, rad/s.")
      .def("density", py::vectorize(&Spectrum::operator()), py::arg("omega"),
           "S(omega) in m2 s/rad for frequencies in rad/s, any shape; zero for omega <= 0.")
      .def("energy", &Spectrum::energy, py::kw_only(), py::arg("omega_min") = 0.0,
           py::arg_v("omega_max", infinity, "float('inf')"), "Integral of S between two frequencies, m2.")
      .def("moment", &Spectrum::moment, py::arg("order"),
           "Integral of omega^order S over all frequencies, order -4 to 3.")
      .def("steepness", &Spectrum::steepness, py::kw_only(), py::arg("gravity") = standard_gravity,
           "hs over the deep-water wave length of the peak period, hs / (g tp^2 / 2 pi).")
      .def("__repr__", [](const Spectrum& s) {
        return py::str("Spectrum({}, hs={}, tp={}, gamma={})").format(s.name(), s.hs(), s.tp(), s.gamma());
      });

  m.def("jonswap", &Spectrum::jonswap, py::kw_only(), py::arg("hs"), py::arg("tp"), py::arg("gamma") = 3.3,
        R"(JONSWAP spectrum.

Parameters
----------
hs : float
    Significant wave height, m.
tp : float
    Peak period, s.
gamma : float
    Peak enhancement, at least 1. The width is 0.07 below and 0.09 above the peak.

Raises
------
ValueError
    A parameter is not finite or out of range.

Notes
-----
Hasselmann et al., Deutsche Hydrographische Zeitschrift A8 (12), 1973. Normalised by quadrature.)");
  m.def("pierson_moskowitz", &Spectrum::pierson_moskowitz, py::kw_only(), py::arg("hs"), py::arg("tp"),
        R"(Pierson-Moskowitz spectrum, in its form for a given significant wave height and peak period.

Parameters
----------
hs : float
    Significant wave height, m.
tp : float
    Peak period, s.

Raises
------
ValueError
    A parameter is not finite or not above zero.

Notes
-----
W. J. Pierson and L. Moskowitz, J. Geophys. Res. 69 (24), 1964.)");
}

void bind_components(py::module_& m) {
  py::class_<RepeatPeriod>(m, "RepeatPeriod", "Answer of `WaveComponents.repeat_period`.")
      .def_readonly("time", &RepeatPeriod::time, "First repeat, or the proven lower bound of it, s.")
      .def_readonly("found", &RepeatPeriod::found, "Whether the sea repeats at `time`.")
      .def("__repr__", [](const RepeatPeriod& r) {
        return py::str("RepeatPeriod(time={}, found={})").format(r.time, r.found);
      });

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

Raises
------
ValueError
    A value is not finite or out of range, or the lengths differ.)")
      .def(py::init([](const Doubles& omega, const Doubles& amplitude, const Doubles& phase,
                       const Doubles& direction, double depth, double gravity) {
             std::vector<double> w = to_vector(omega, "omega");
             const std::size_t n = w.size();
             return WaveComponents(std::move(w), spread(amplitude, n, "amplitude"), spread(phase, n, "phase"),
                                   spread(direction, n, "direction"), depth, gravity);
           }),
           py::kw_only(), py::arg("omega"), py::arg("amplitude"), py::arg("phase") = 0.0,
           py::arg("direction") = 0.0, py::arg_v("depth", infinity, "float('inf')"),
           py::arg("gravity") = standard_gravity)
      .def("__len__", &WaveComponents::size)
      .def_property_readonly("omega", &view<&WaveComponents::omega>, "rad/s")
      .def_property_readonly("wavenumber", &view<&WaveComponents::wavenumber>, "rad/m")
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
           py::call_guard<py::gil_scoped_release>(),
           "First time after the initial decay at which the autocorrelation is 0.99 again, s; `found` is "
           "False "
           "when it is proven that there is none before `horizon`.")
      .def(
          "elevation",
          [](const WaveComponents& w, const Doubles& times, double x, double y) {
            return at_times(times, 0, 1, [&](double t, double* out) { out[0] = w.elevation(t, x, y); });
          },
          py::arg("times"), py::kw_only(), py::arg("x") = 0.0, py::arg("y") = 0.0,
          "Wave elevation (m) at one point (m, inertial frame), shape of `times` (s).")
      .def("__repr__", [](const WaveComponents& w) {
        return py::str("WaveComponents({} components, realised_hs={:.4g} m)")
            .format(w.size(), w.realised_hs());
      });
}

void bind_realisation(py::module_& m) {
  m.def(
      "realise_waves",
      [](const Spectrum& spectrum, const py::object& seed, double direction, const py::object& count,
         std::optional<double> omega_min, std::optional<double> omega_max, double depth, double gravity) {
        RealisationOptions o;
        o.count = static_cast<long>(whole_number(count, "count", 1, 1'000'000));
        o.omega_min = omega_min;
        o.omega_max = omega_max;
        o.direction = direction;
        o.seed = whole_number(seed, "seed", 0, std::numeric_limits<std::uint64_t>::max());
        o.depth = depth;
        o.gravity = gravity;
        return realise(spectrum, o);
      },
      py::arg("spectrum"), py::kw_only(), py::arg("seed"), py::arg("direction"), py::arg("count") = 200,
      py::arg("omega_min") = py::none(), py::arg("omega_max") = py::none(),
      py::arg_v("depth", infinity, "float('inf')"), py::arg("gravity") = standard_gravity,
      R"(Long-crested sea with deterministic amplitudes and jittered frequencies.

The frequency range is cut into `count` bins of one width. Component i has exactly the energy of bin i, a
frequency placed uniformly within it and a uniform phase; both from Philox4x32-10 with the seed as key,
streams 0 and 1, index i (`philox_uniform`). Energy outside the range is left out and not made up for: see
`realised_hs`.

Parameters
----------
spectrum : Spectrum
seed : int
    0 to 2^64 - 1. The same seed gives the same waves; the random bits are the same on every platform, the
    derived numbers up to the rounding of its mathematical library.
direction : float
    Where the waves travel to, rad, from +x (forward) towards +y (port).
count : int
    Number of components.
omega_min, omega_max : float, optional
    Range, rad/s. By default min(0.3, peak / 2) to max(2.5, 3 peak): the realised hs is then within 1 %.
depth : float
    Water depth, m.
gravity : float
    m/s2.

Raises
------
ValueError
    A parameter is not finite or out of range.)");

  m.def(
      "philox_uniform",
      [](const py::object& seed, const py::object& stream, const py::object& index) {
        constexpr auto largest = std::numeric_limits<std::uint64_t>::max();
        return Philox::uniform(whole_number(seed, "seed", 0, largest),
                               whole_number(stream, "stream", 0, largest),
                               whole_number(index, "index", 0, largest));
      },
      py::kw_only(), py::arg("seed"), py::arg("stream"), py::arg("index"),
      "Uniform number in (0, 1) by Philox4x32-10 (Salmon et al., SC11, 2011): key = seed, counter = index + "
      "2^64 "
      "stream; the first two output words, lowest first, shifted right by 11, made odd, times 2^-53.");
}

}  // namespace

void bind_sea(py::module_& m) {
  bind_spectrum(m);
  bind_components(m);
  bind_realisation(m);
  bind_wave_load(m);
}
