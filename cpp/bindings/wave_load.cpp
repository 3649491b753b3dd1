#include "seacrane/sea/wave_load.hpp"

#include <algorithm>
#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "sea_arrays.hpp"

using namespace seacrane;

namespace {

using Complexes = py::array_t<std::complex<double>, py::array::c_style | py::array::forcecast>;
using Point = std::pair<double, double>;

Eigen::MatrixXcd to_matrix(const Complexes& a) {
  if (a.ndim() != 2) {
    throw py::value_error("wave load: transfer has " + std::to_string(a.ndim()) +
                          " dimensions; give (components, 6)");
  }
  using RowMajor = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(a.data(), a.shape(0), a.shape(1));
}

py::array_t<double> exact_load(const ExactWaveLoad& load, const Doubles& times, int derivative) {
  if (derivative < 0 || derivative > 2) {
    throw py::value_error("wave load: derivative is " + std::to_string(derivative) + "; give 0, 1 or 2");
  }
  return at_times(times, 0, 6, [&](double t, double* out) {
    if (derivative == 0) {
      load.evaluate(t, out);
      return;
    }
    double orders[3][wave_channels];
    load.evaluate(t, orders[0], orders[1], orders[2]);
    std::copy_n(orders[derivative], wave_channels, out);
  });
}

py::array_t<double> table_channels(const WaveTable& table, const Doubles& times, std::size_t first,
                                   std::size_t width) {
  WaveTableBlock block = table.make_block();
  return at_times(times, first, width, [&](double t, double* out) { table.evaluate(t, block, out); });
}

void bind_exact(py::module_& m) {
  py::class_<ExactWaveLoad, std::shared_ptr<ExactWaveLoad>>(
      m, "ExactWaveLoad",
      R"(First-order wave load of a vessel at its mean position, summed over all components; immutable.

F_j(t) = Re sum_i a_i X_ij exp(i (omega_i t + phase_i - k_i (x cos b_i + y sin b_i))), in the axes and about the
reference point of the transfer.

Parameters
----------
waves : WaveComponents
transfer : array_like of complex, shape (components, 6)
    X: N/m and N m/m, time factor exp(+i omega t), phase referring to `position`. Copied.
position : tuple of float
    x, y of the phase reference of X, m, inertial frame.
elevation_point : tuple of float, optional
    x, y where the elevation is taken, m; `position` by default.

Raises
------
ValueError
    A wrong shape or a value that is not finite.)")
      .def(py::init([](const WaveComponents& waves, const Complexes& transfer, Point position,
                       std::optional<Point> elevation_point) {
             const Point e = elevation_point.value_or(position);
             return std::make_shared<ExactWaveLoad>(waves, to_matrix(transfer),
                                                    WavePoint{position.first, position.second},
                                                    WavePoint{e.first, e.second});
           }),
           py::arg("waves"), py::kw_only(), py::arg("transfer"), py::arg("position") = Point(0.0, 0.0),
           py::arg("elevation_point") = py::none())
      .def("evaluate", &exact_load, py::arg("times"), py::kw_only(), py::arg("derivative") = 0,
           "Forces (N) and moments (N m) at times (s): shape times.shape + (6,). `derivative` 1 or 2 gives "
           "the "
           "time derivatives of that order.")
      .def(
          "elevation",
          [](const ExactWaveLoad& load, const Doubles& times) {
            return at_times(times, 6, 1, [&](double t, double* out) { load.evaluate(t, out); });
          },
          py::arg("times"), "Wave elevation (m) at the elevation point, shape of `times` (s).")
      .def_property_readonly(
          "waves", [](const ExactWaveLoad& load) { return load.waves(); }, "The components (a copy).")
      .def(
          "magnitude",
          [](const ExactWaveLoad& load, int order) {
            const WaveChannels sum = load.magnitude(order);
            return py::array_t<double>(6, sum.data());
          },
          py::arg("order") = 0,
          "sum |a X_ij| omega^order, shape (6,): no time derivative of that order exceeds it.")
      .def("__repr__", [](const ExactWaveLoad& load) {
        return py::str("ExactWaveLoad({} components)").format(load.waves().size());
      });
}

void bind_table(py::module_& m) {
  py::class_<WaveTable, std::shared_ptr<WaveTable>>(
      m, "WaveTable",
      R"(A wave load by quintic Hermite interpolation on a global time grid; immutable.

|table - exact| <= step^6 / 46080 sum |a X_ij| omega^6 at any time (Hermite remainder), plus rounding. Knots are
computed when a run reaches them and held in a ring of fixed size: constant memory for any duration.

Parameters
----------
load : ExactWaveLoad
relative_bound : float
    The bound over sum |a X_ij|, 1e-14 to 1e-2; it sets the step. The default 1e-9 is about 1e-8 of a load's
    standard deviation with 200 components.

Raises
------
ValueError
    `relative_bound` is out of range.)")
      .def(py::init([](const std::shared_ptr<ExactWaveLoad>& load, double relative_bound) {
             return std::make_shared<WaveTable>(load, relative_bound);
           }),
           py::arg("load").none(false), py::kw_only(), py::arg("relative_bound") = 1e-9)
      .def(
          "evaluate",
          [](const WaveTable& table, const Doubles& times) { return table_channels(table, times, 0, 6); },
          py::arg("times"), "Forces (N) and moments (N m) at times (s): shape times.shape + (6,).")
      .def(
          "elevation",
          [](const WaveTable& table, const Doubles& times) { return table_channels(table, times, 6, 1); },
          py::arg("times"), "Wave elevation (m) at the elevation point, shape of `times` (s).")
      .def_property_readonly("step", &WaveTable::step, "Distance of the knots, s.")
      .def_property_readonly(
          "error_bound",
          [](const WaveTable& table) { return py::array_t<double>(6, table.error_bound().data()); },
          "Bound of |table - exact| per motion, N and N m, shape (6,).")
      .def_property_readonly(
          "elevation_error_bound", [](const WaveTable& table) { return table.error_bound()[6]; },
          "The same, m.")
      .def("__repr__", [](const WaveTable& table) {
        return py::str("WaveTable({} components, step={:.4g} s)")
            .format(table.exact()->waves().size(), table.step());
      });
}

}  // namespace

void bind_wave_load(py::module_& m) {
  bind_exact(m);
  bind_table(m);
}
