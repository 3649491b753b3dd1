#include "seacrane/sea/spectrum.hpp"

#include <memory>

#include "sea_arrays.hpp"

using namespace seacrane;

void bind_spectrum(py::module_& m) {
  py::class_<Spectrum, std::shared_ptr<Spectrum>>(m, "Spectrum",
                                                  "One-sided wave spectrum S(omega) in m2 s/rad; immutable. "
                                                  "Parametric ones are normalised by quadrature to "
                                                  "hs^2 / 16.")
      .def_property_readonly("name", &Spectrum::name)
      .def_property_readonly("hs", &Spectrum::hs, "Significant wave height, m.")
      .def_property_readonly("tp", &Spectrum::tp, "Peak period, s.")
      .def_property_readonly("gamma", &Spectrum::gamma,
                             "Peak enhancement of the first part; 1 for Pierson-Moskowitz, None for a table.")
      .def_property_readonly("peak_omega", &Spectrum::peak_omega, "Peak frequency of the first part, rad/s.")
      .def_property_readonly("default_range", &Spectrum::default_range,
                             "Frequencies that a realisation covers by default, rad/s.")
      .def("parts", &Spectrum::parts,
           "Each wave system by itself, the one with the given or the highest peak first.")
      .def("density", py::vectorize(&Spectrum::operator()), py::arg("omega"),
           "S(omega) in m2 s/rad for frequencies in rad/s, any shape; zero for omega <= 0.")
      .def("energy", &Spectrum::energy, py::kw_only(), py::arg("minimum_omega") = 0.0,
           py::arg_v("maximum_omega", infinity, "float('inf')"), "Integral of S between two frequencies, m2.")
      .def(
          "moment", &Spectrum::moment, py::arg("order"),
          "Integral of omega^order S over all frequencies, for orders where it is finite (JONSWAP: -4 to 3).")
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
    Peak enhancement, 1 to 7. The width is 0.07 below and 0.09 above the peak.

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
  m.def("torsethaugen", &Spectrum::torsethaugen, py::kw_only(), py::arg("hs"), py::arg("tp"),
        py::arg("gravity") = standard_gravity,
        R"(Torsethaugen's spectrum in its simplified form: wind sea and swell from one height and period.

Parameters
----------
hs : float
    Significant wave height of both systems together, m.
tp : float
    Peak period of the primary system, s: wind sea up to 6.6 hs^(1/3), else swell.
gravity : float
    m/s2.

Raises
------
ValueError
    A parameter is not finite or out of range.

Notes
-----
K. Torsethaugen and S. Haver, ISOPE 2004; DNV-RP-C205 appendix A. Norwegian waters, fetch 370 km. Normalised by
quadrature instead of the fitted factor A_gamma.)");
  m.def("ochi_hubble", &Spectrum::ochi_hubble, py::kw_only(), py::arg("hs"), py::arg("tp"), py::arg("shape"),
        R"(Ochi-Hubble spectrum: two systems of three parameters each.

Parameters
----------
hs : tuple of float
    Significant wave heights of both systems, m.
tp : tuple of float
    Peak periods, s.
shape : tuple of float
    Their lambda, above 0.5 to 20; 1 is Pierson-Moskowitz, larger is narrower.

Raises
------
ValueError
    A parameter is not finite or out of range.

Notes
-----
M. K. Ochi and E. N. Hubble, Proc. 15th Coastal Engineering Conference, 1976.)");
  m.def(
      "tabulated_density",
      [](const Doubles& omega, const Doubles& density) {
        return Spectrum::tabulated(to_vector(omega, "tabulated spectrum", "omega"),
                                   to_vector(density, "tabulated spectrum", "density"));
      },
      py::kw_only(), py::arg("omega"), py::arg("density"),
      "Spectrum from a table in rad/s and m2 s/rad, linear between its points, zero outside.");
  m.def("dnv_gamma", &dnv_gamma, py::kw_only(), py::arg("hs"), py::arg("tp"),
        "Peak enhancement by DNV-RP-C205 (3.5.5): 5 for tp / sqrt(hs) <= 3.6, 1 from 5 on, between them "
        "exp(5.75 - 1.15 tp / sqrt(hs)); m and s.");
}
