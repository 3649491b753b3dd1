#include "seacrane/math/curve.hpp"

#include "bindings.hpp"
#include "given.hpp"
#include "seacrane/math/curve_table.hpp"

using seacrane::Curve;

namespace {

Curve from_pieces(const std::vector<double>& starts, const std::vector<std::array<double, 6>>& coefficients,
                  const std::vector<std::array<double, 3>>& cosines) {
  if (coefficients.size() != starts.size() || (!cosines.empty() && cosines.size() != starts.size())) {
    throw std::invalid_argument("curve: starts, coefficients and cosines must have one entry per piece");
  }
  std::vector<Curve::Piece> pieces(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    pieces[i].start = starts[i];
    pieces[i].coefficients = coefficients[i];
    if (!cosines.empty()) {
      pieces[i].amplitude = cosines[i][0];
      pieces[i].omega = cosines[i][1];
      pieces[i].phase = cosines[i][2];
    }
  }
  return Curve(std::move(pieces));
}

py::array_t<double> evaluate(const Curve& curve, const py::array_t<double, py::array::c_style>& times) {
  py::array_t<double> out({times.size(), py::ssize_t{3}});
  auto view = out.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < times.size(); ++i) {
    const auto v = curve.at(times.data()[i]);
    view(i, 0) = v.value;
    view(i, 1) = v.rate;
    view(i, 2) = v.acceleration;
  }
  return out;
}

/// Samples as users give them: any array of one dimension, also one that a result recorded.
Curve table(const py::object& times, const py::object& values, const std::string& between) {
  return seacrane::tabulated(given::vector_of("curve: times", times),
                             given::vector_of("curve: values", values), between);
}

}  // namespace

void bind_curve(py::module_& m) {
  py::class_<Curve>(m, "Curve",
                    R"(A reference as a function of time: pieces of quintic polynomials plus one cosine each.

Before its first piece a curve holds its first value at rest; its last piece goes on for ever: a polynomial
as the polynomial that it is. Values are in the unit of what the curve drives (m, rad, N, N m or m/s), times
in s. Immutable.)")
      .def_static("constant", &Curve::constant, py::kw_only(), py::arg("value"), "One value at all times.")
      .def_static(
          "quintic", &Curve::quintic, py::kw_only(), py::arg("start_time"), py::arg("end_time"),
          py::arg("start"), py::arg("end"),
          "From `start` at `start_time` to `end` at `end_time`, at rest with zero acceleration at both "
          "ends, held before and after. Raises SceneError when the times do not increase.")
      .def_static("harmonic", &Curve::harmonic, py::kw_only(), py::arg("start_time") = 0.0,
                  py::arg("offset") = 0.0, py::arg("amplitude"), py::arg("omega"), py::arg("phase") = 0.0,
                  "offset + amplitude cos(omega (t - start_time) + phase), omega in rad/s.")
      .def_static(
          "pieces", &from_pieces, py::kw_only(), py::arg("starts"), py::arg("coefficients"),
          py::arg("cosines") = std::vector<std::array<double, 3>>{},
          "Pieces from their start times on: coefficients (n, 6) of powers of (t - start), cosines (n, 3) "
          "of amplitude, omega, phase. The last piece continues as it is: end with a constant to hold a "
          "value.")
      .def_static(
          "table", &table, py::arg("times"), py::arg("values"), py::kw_only(), py::arg("between") = "linear",
          "Through samples (n,) of two or more: times in s that increase, values in the unit of what the "
          "curve drives, such as a channel of a result. `between`: \"linear\", whose rate jumps at the "
          "samples; or \"cubic\", whose rate and acceleration do not, at rest at both ends. Before the first "
          "sample it is held at its value, and after the last one at that. Steps end at its jumps.")
      .def("then", &Curve::then, py::kw_only(), py::arg("time"), py::arg("curve"),
           "This curve until `time`, the other one afterwards (at its own clock).")
      .def("evaluate", &evaluate, py::arg("times"),
           "Values, rates and accelerations, shape (n, 3), at times (n,) in s.")
      .def_property_readonly(
          "breakpoints", [](const Curve& c) { return c.breakpoints(); },
          "Times (s) where value, rate or acceleration jumps.")
      .def(
          "to_pieces",
          [](const Curve& c) {
            py::list starts, coefficients, cosines;
            for (const auto& p : c.pieces()) {
              starts.append(p.start);
              coefficients.append(py::cast(p.coefficients));
              cosines.append(py::cast(std::array<double, 3>{p.amplitude, p.omega, p.phase}));
            }
            return py::dict(py::arg("starts") = starts, py::arg("coefficients") = coefficients,
                            py::arg("cosines") = cosines);
          },
          "The arguments of Curve.pieces() that make this curve.");
}
