#include <string>
#include <vector>

#include "bindings.hpp"
#include "sea_arrays.hpp"
#include "seacrane/strip/section_radiation.hpp"
#include "seacrane/strip/strip_theory.hpp"
#include "without_gil.hpp"

using namespace seacrane::strip;

namespace {

constexpr const char* kStripTheory = "strip theory";

constexpr const char* strip_theory_doc =
    R"(Strip theory of Salvesen, Tuck and Faltinsen (1970) for a port-starboard symmetric hull in deep water.

Parameters
----------
x : array_like, shape (s,)
    Stations, m, increasing, forward.
sections : list of array_like, each of shape (p_i, 2)
    y >= 0 and z <= 0 in m on the port half, from the waterline (z = 0) to the keel (y = 0). A last section
    aft of finite area is a transom.
omega : array_like, shape (n,)
    Frequencies above zero, rad/s: of encounter for the matrices, of the waves for the forces.
heading : array_like, shape (m,)
    Direction the waves travel to, rad: 0 following, pi head sea.
speed : float
    Forward speed, m/s.
rho, g : float
    kg/m3, m/s2.
panels : int
    Panels on each half section.

Returns
-------
dict of arrays, SI units, about x = 0 on the centre line at the waterline, time factor exp(+i omega t)
    added_mass, damping : (n, 6, 6). Surge is zero: the theory has none.
    infinite_frequency_added_mass : (6, 6)
    zero_frequency_added_mass : (6, 6), at zero speed; NaN in heave and pitch, which have no limit.
    force, froude_krylov : (m, n, 6) complex, per metre of wave amplitude, phases at the origin. Surge is the
    Froude-Krylov force alone.
    encounter_frequency : (m, n), rad/s
    sectional_added_mass, sectional_damping : (n, s, 3, 3), per metre of length, sway, heave and roll.
    sectional_infinite_added_mass, sectional_zero_added_mass : (s, 3, 3)

Raises
------
ValueError
    Stations not increasing, a section that is not a half section as above, values that are not finite or
    out of range, a wave that the ship keeps up with (encounter frequency zero), or panels too few for the
    shape, which shows as radiated energy that is not the damping's.

Notes
-----
N. Salvesen, E. O. Tuck and O. Faltinsen, Ship motions and sea loads, Trans. SNAME 78, 1970; with the end
terms of the transom. Sections by `section_radiation`; between stations everything but the wave's phase is
linear. Unlike theirs, the Froude-Krylov part is the exact pressure integral over the piecewise linear hull,
with what faces forward or aft (surge, and small parts of pitch and yaw), both ends included.)";

constexpr const char* section_radiation_doc =
    R"(Added mass and damping of a symmetric section on deep water, per metre of length.

Parameters
----------
points : array_like, shape (p, 2)
    y >= 0 and z <= 0 in m on the port half, from the waterline (z = 0) to the keel (y = 0).
omega : array_like, shape (n,)
    Frequencies above zero, rad/s.
rho, g : float
    kg/m3, m/s2.
panels : int
    Panels on the half section.

Returns
-------
dict of arrays; rows and columns are sway, heave, roll about the waterline on the centre line
    added_mass, damping : (n, 3, 3)
    wave_amplitude : (n, 3) complex, of the waves far to port per unit of motion (m/m, m/rad)
    infinite_added_mass : (3, 3)
    zero_added_mass : (3, 3), NaN in heave, which has no limit.

Raises
------
ValueError
    The points are not a half section as above, a value is not finite or out of range, or the panels are too
    few for the shape, which shows as radiated energy that is not the damping's.

Notes
-----
Close-fit sources on straight panels (Frank, NSRDC report 2375, 1967), with a rigid lid on the interior free
surface against irregular frequencies. Sections thinner than 2 % are solved as 2 % thick: a stem in sway is
a plate.)";

HalfSection to_section(const Doubles& a, const std::string& name) {
  if (a.ndim() != 2 || a.shape(1) != 2) {
    throw py::value_error("strip theory: " + name + " must have shape (points, 2), columns y and z in m");
  }
  return Eigen::Map<const HalfSection>(a.data(), a.shape(0), 2);
}

/// Array of the given shape, followed by that of the items, which Eigen stores by columns.
template <class Item>
py::array to_array(const std::vector<Item>& items, std::vector<py::ssize_t> shape) {
  using Scalar = typename Item::Scalar;
  shape.push_back(Item::RowsAtCompileTime);
  if (Item::ColsAtCompileTime > 1) shape.push_back(Item::ColsAtCompileTime);
  py::array_t<Scalar> out(shape);
  Scalar* target = out.mutable_data();
  for (const Item& item : items) {
    for (Eigen::Index i = 0; i < item.rows(); ++i) {
      for (Eigen::Index j = 0; j < item.cols(); ++j) *target++ = item(i, j);
    }
  }
  return out;
}

template <class Item, class Of>
py::array each(const std::vector<Of>& items, Item Of::*member, const std::vector<py::ssize_t>& shape) {
  std::vector<Item> out;
  for (const Of& item : items) out.push_back(item.*member);
  return to_array(out, shape);
}

void check_interrupt() {
  if (WithoutGil::should_return()) throw std::domain_error("strip theory: the interpreter is ending");
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

py::dict bound_section_radiation(const Doubles& points, const Doubles& omega, double rho, double g,
                                 int panels) {
  const HalfSection section = to_section(points, "points");
  const std::vector<double> w = to_vector(omega, kStripTheory, "omega");
  const SectionRadiation r = [&] {
    const WithoutGil released;
    return section_radiation(section, w, {rho, g, panels}, &check_interrupt);
  }();
  const std::vector<py::ssize_t> n{static_cast<py::ssize_t>(w.size())};
  py::dict out;
  out["added_mass"] = each(r.at, &SectionCoefficients::added_mass, n);
  out["damping"] = each(r.at, &SectionCoefficients::damping, n);
  out["wave_amplitude"] = each(r.at, &SectionCoefficients::wave_amplitude, n);
  out["infinite_added_mass"] = to_array(std::vector{r.limits.infinite}, {});
  out["zero_added_mass"] = to_array(std::vector{r.limits.zero}, {});
  return out;
}

py::dict bound_strip_theory(const Doubles& x, const std::vector<Doubles>& sections, const Doubles& omega,
                            const Doubles& heading, double speed, double rho, double g, int panels) {
  StripCase input{to_vector(x, kStripTheory, "x"),
                  {},
                  to_vector(omega, kStripTheory, "omega"),
                  to_vector(heading, kStripTheory, "heading"),
                  speed,
                  {rho, g, panels}};
  for (std::size_t i = 0; i < sections.size(); ++i) {
    input.sections.push_back(to_section(sections[i], "sections[" + std::to_string(i) + "]"));
  }
  const StripResult r = [&] {
    const WithoutGil released;
    return strip_theory(input, &check_interrupt);
  }();
  const auto n = static_cast<py::ssize_t>(input.omega.size());
  const auto m = static_cast<py::ssize_t>(input.heading.size());
  const auto s = static_cast<py::ssize_t>(input.x.size());
  py::dict out;
  out["added_mass"] = to_array(r.added_mass, {n});
  out["damping"] = to_array(r.damping, {n});
  out["infinite_frequency_added_mass"] = to_array(std::vector{r.infinite_frequency}, {});
  out["zero_frequency_added_mass"] = to_array(std::vector{r.zero_frequency}, {});
  out["force"] = to_array(r.force, {m, n});
  out["froude_krylov"] = to_array(r.froude_krylov, {m, n});
  out["encounter_frequency"] = py::array_t<double>({m, n}, r.encounter_frequency.data());
  out["sectional_added_mass"] = to_array(r.sectional_added_mass, {n, s});
  out["sectional_damping"] = to_array(r.sectional_damping, {n, s});
  out["sectional_infinite_added_mass"] = each(r.sectional_limits, &SectionLimits::infinite, {s});
  out["sectional_zero_added_mass"] = each(r.sectional_limits, &SectionLimits::zero, {s});
  return out;
}

}  // namespace

void bind_strip(py::module_& m) {
  m.def("section_radiation", &bound_section_radiation, py::kw_only(), py::arg("points"), py::arg("omega"),
        py::arg("rho") = 1025.0, py::arg("g") = 9.81, py::arg("panels") = SectionSettings{}.panels,
        section_radiation_doc);
  m.def("strip_theory", &bound_strip_theory, py::kw_only(), py::arg("x"), py::arg("sections"),
        py::arg("omega"), py::arg("heading"), py::arg("speed") = 0.0, py::arg("rho") = 1025.0,
        py::arg("g") = 9.81, py::arg("panels") = SectionSettings{}.panels, strip_theory_doc);
}
