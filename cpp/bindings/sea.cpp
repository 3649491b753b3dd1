#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "sea_arrays.hpp"
#include "seacrane/sea/philox.hpp"
#include "seacrane/sea/realisation.hpp"
#include "vector_state.hpp"

using namespace seacrane;

namespace {

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

FrequencyPlacement placement_of(const std::string& name) {
  if (name == "jittered") return FrequencyPlacement::jittered;
  if (name == "uniform") return FrequencyPlacement::uniform;
  throw py::value_error("wave realisation: placement is '" + name + "'; give 'jittered' or 'uniform'");
}

BinOptions bin_options(const py::object& count, std::optional<double> minimum_omega,
                       std::optional<double> maximum_omega, const std::string& placement) {
  return {static_cast<long>(whole_number(count, "count", 1, 1'000'000)), minimum_omega, maximum_omega,
          placement_of(placement)};
}

RealisationOptions realisation_options(BinOptions bins, const py::object& seed, double direction,
                                       double depth, double gravity, const py::object& system) {
  return {std::move(bins),
          direction,
          whole_number(seed, "seed", 0, std::numeric_limits<std::uint64_t>::max()),
          whole_number(system, "system", 0, 1'000'000),
          depth,
          gravity};
}

void bind_bins(py::module_& m) {
  py::class_<WaveBins>(m, "WaveBins",
                       "A spectrum cut into bins, of which `realise` makes what `realise_waves` makes of the "
                       "spectrum. What the seeds share is worked out once.")
      .def(py::init([](const Spectrum& spectrum, const py::object& count, std::optional<double> minimum_omega,
                       std::optional<double> maximum_omega, const std::string& placement) {
             clear_vector_state();
             return WaveBins(spectrum, bin_options(count, minimum_omega, maximum_omega, placement));
           }),
           py::arg("spectrum"), py::kw_only(), py::arg("count") = 200, py::arg("minimum_omega") = py::none(),
           py::arg("maximum_omega") = py::none(), py::arg("placement") = "jittered")
      .def(
          "realise",
          [](const WaveBins& bins, const py::object& seed, double direction, double depth, double gravity,
             const py::object& system) {
            clear_vector_state();
            return bins.realise(realisation_options({}, seed, direction, depth, gravity, system));
          },
          py::kw_only(), py::arg("seed"), py::arg("direction"), py::arg_v("depth", infinity, "float('inf')"),
          py::arg("gravity") = standard_gravity, py::arg("system") = 0, "Arguments as of `realise_waves`.");
}

void bind_realisation(py::module_& m) {
  m.def(
      "realise_waves",
      [](const Spectrum& spectrum, const py::object& seed, double direction, const py::object& count,
         std::optional<double> minimum_omega, std::optional<double> maximum_omega, double depth,
         double gravity, const std::string& placement, const py::object& system) {
        clear_vector_state();
        return realise(spectrum,
                       realisation_options(bin_options(count, minimum_omega, maximum_omega, placement), seed,
                                           direction, depth, gravity, system));
      },
      py::arg("spectrum"), py::kw_only(), py::arg("seed"), py::arg("direction"), py::arg("count") = 200,
      py::arg("minimum_omega") = py::none(), py::arg("maximum_omega") = py::none(),
      py::arg_v("depth", infinity, "float('inf')"), py::arg("gravity") = standard_gravity,
      py::arg("placement") = "jittered", py::arg("system") = 0,
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
minimum_omega, maximum_omega : float, optional
    Range, rad/s; by default `Spectrum.default_range`. For JONSWAP and Pierson-Moskowitz the realised hs is
    then within 1 %.
depth : float
    Water depth, m.
gravity : float
    m/s2.
placement : str
    "jittered" (default), or "uniform": frequencies are multiples of one bin width, as an FFT needs them, and
    the sea repeats after 2 pi over that width.
system : int
    Number of the wave system in a sea of several: each takes random numbers of its own, from the streams
    3 system (jitter) and 3 system + 1 (phase).

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
  bind_current(m);
  bind_wave_components(m);
  bind_sea_field(m);
  bind_bins(m);
  bind_realisation(m);
  bind_wave_load(m);
}
