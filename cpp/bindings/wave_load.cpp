#include "seacrane/sea/wave_load.hpp"

#include <algorithm>
#include <complex>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sea_arrays.hpp"
#include "seacrane/math/spline_weights.hpp"
#include "seacrane/math/weighted_sums.hpp"
#include "seacrane/model/description.hpp"
#include "seacrane/sea/kept_components.hpp"

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

/// The six loads or a time derivative of them.
template <class Load>
py::array_t<double> derivatives(const Load& load, const Doubles& times, int derivative) {
  if (derivative < 0 || derivative > 2) {
    throw py::value_error("wave load: derivative is " + std::to_string(derivative) + "; give 0, 1 or 2");
  }
  return at_times(times, 0, 6, [&](double t, double* out) {
    if (derivative == 0) {
      load.evaluate(t, out);
      return;
    }
    double orders[3][Load::channels];
    load.evaluate(t, orders[0], orders[1], orders[2]);
    std::copy_n(orders[derivative], Load::channels, out);
  });
}

/// Six loads, or the seventh channel, at every time.
template <class Source>
py::array_t<double> table_channels(const KnotTable<Source>& table, const Doubles& times, std::size_t first,
                                   std::size_t width) {
  KnotBlock<Source> block = table.make_block();
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
      .def("evaluate", &derivatives<ExactWaveLoad>, py::arg("times"), py::kw_only(),
           py::arg("derivative") = 0,
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
          [](const ExactWaveLoad& load) { return py::array_t<double>(6, load.bounds()[0].data()); },
          "sum |a X_ij|, shape (6,): no load ever exceeds it.")
      .def("__repr__", [](const ExactWaveLoad& load) {
        return py::str("ExactWaveLoad({} components)").format(load.waves().size());
      });
}

template <class Source>
auto bind_table(py::module_& m, const char* name, const char* text) {
  using Table = KnotTable<Source>;
  return py::class_<Table, std::shared_ptr<Table>>(m, name, text)
      .def(py::init<std::shared_ptr<Source>, double>(), py::arg("load").none(false), py::kw_only(),
           py::arg("relative_bound") = 1e-9)
      .def(
          "evaluate",
          [](const Table& table, const Doubles& times) { return table_channels(table, times, 0, 6); },
          py::arg("times"), "Forces (N) and moments (N m) at times (s): shape times.shape + (6,).")
      .def_property_readonly("step", &Table::step, "Distance of the knots, s.")
      .def_property_readonly(
          "error_bound",
          [](const Table& table) { return py::array_t<double>(6, table.error_bound().data()); },
          "Bound of |table - exact| per motion, N and N m, shape (6,).")
      .def("__repr__", [name = std::string(name)](const Table& table) {
        return py::str("{}({} components, step={:.4g} s)")
            .format(name, table.exact()->waves().size(), table.step());
      });
}

void bind_wave_table(py::module_& m) {
  bind_table<ExactWaveLoad>(
      m, "WaveTable",
      R"(A wave load by Hermite interpolation of degree 11 on a global time grid; immutable.

|table - exact| <= 3.72e-10 step^12 sum |a X_ij| omega^12 at any time (Hermite remainder), plus rounding. Knots are
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
      .def(
          "elevation",
          [](const WaveTable& table, const Doubles& times) { return table_channels(table, times, 6, 1); },
          py::arg("times"), "Wave elevation (m) at the elevation point, shape of `times` (s).");
}

void bind_drift(py::module_& m) {
  py::class_<DriftLoad, std::shared_ptr<DriftLoad>>(
      m, "DriftLoad",
      R"(Slowly varying second-order load at the mean position, Newman's approximation; immutable.

F_j(t) = sum_ik a_i a_k (D_ij + D_kj) / 2 cos(theta_i - theta_k), theta_i = omega_i t + phase_i
- k_i (x cos b_i + y sin b_i); its mean is sum a^2 D.

Parameters
----------
waves : WaveComponents
coefficient : array_like, shape (components, 6)
    D: mean load over amplitude squared, N/m2 and N m/m2. Copied.
position : tuple of float
    x, y of the vessel, m, inertial frame.

Raises
------
ValueError
    A wrong shape or a value that is not finite.)")
      .def(py::init([](const WaveComponents& waves, const MatXd& coefficient, Point position) {
             return std::make_shared<DriftLoad>(waves, coefficient,
                                                WavePoint{position.first, position.second});
           }),
           py::arg("waves"), py::kw_only(), py::arg("coefficient"), py::arg("position") = Point(0.0, 0.0))
      .def("evaluate", &derivatives<DriftLoad>, py::arg("times"), py::kw_only(), py::arg("derivative") = 0,
           "Forces (N) and moments (N m) at times (s): shape times.shape + (6,); `derivative` 0, 1 or 2.")
      .def_property_readonly(
          "waves", [](const DriftLoad& load) { return load.waves(); }, "The components (a copy).");
  bind_table<DriftLoad>(m, "DriftTable",
                        "A DriftLoad by Hermite interpolation on a global time grid, as WaveTable.");
}

/// Headings x components x `width`, real.
template <std::size_t width>
HeadingTable<width> heading_table(const char* object, const std::vector<double>& headings,
                                  std::size_t components, const double* values, const py::array& from,
                                  py::ssize_t columns) {
  const auto m = static_cast<py::ssize_t>(headings.size()), n = static_cast<py::ssize_t>(components);
  if (from.ndim() != 3 || from.shape(0) != m || from.shape(1) != n || from.shape(2) != columns) {
    throw py::value_error(std::string(object) + ": values need the shape (" + std::to_string(m) + ", " +
                          std::to_string(n) + ", 6): headings, components, motions");
  }
  return HeadingTable<width>(object, headings, components, values);
}

void bind_positioned(py::module_& m) {
  py::class_<PositionedWaveLoad, std::shared_ptr<PositionedWaveLoad>>(
      m, "PositionedWaveLoad",
      R"(Wave loads with phase and heading of the vessel as it is now, in axes that follow its yaw; immutable.

F_j = Re sum_i a_i X_j(omega_i, b_i - psi) exp(i (omega_i t + phase_i - k_i (x cos b_i + y sin b_i))), X by periodic
cubic splines in the relative heading; slow drift, if asked for, as in DriftLoad with D at b_i - psi.

Parameters
----------
waves : WaveComponents
headings : array_like, shape (m,)
    Increasing within one turn, at most 45 deg apart, rad.
transfer : array_like of complex, shape (m, components, 6)
    X at each heading for each component's frequency, N/m and N m/m. Copied.
drift_headings, drift : array_like, shapes (p,) and (p, components, 6), optional
    D over its headings, N/m2 and N m/m2. Copied.
cutoff : float
    rad/s: in a run the loads are those of the position and heading below this frequency; 0: of the moment.

Raises
------
ValueError
    A wrong shape, a value that is not finite or out of range, or a gap between headings.)")
      .def(py::init([](const WaveComponents& waves, const std::vector<double>& headings,
                       const Complexes& transfer, const std::vector<double>& drift_headings,
                       const std::optional<Doubles>& drift, double cutoff) {
             // A complex number lies in memory as its real and imaginary part.
             auto force = heading_table<12>("force by heading", headings, waves.size(),
                                            reinterpret_cast<const double*>(transfer.data()), transfer, 6);
             DriftByHeading slow;
             if (drift) {
               slow = heading_table<6>("drift by heading", drift_headings, waves.size(), drift->data(),
                                       *drift, 6);
             }
             return std::make_shared<PositionedWaveLoad>(waves, std::move(force), std::move(slow), cutoff);
           }),
           py::arg("waves"), py::kw_only(), py::arg("headings"), py::arg("transfer"),
           py::arg("drift_headings") = std::vector<double>{}, py::arg("drift") = py::none(),
           py::arg("cutoff") = 0.0)
      .def(
          "evaluate",
          [](const PositionedWaveLoad& load, double time, double x, double y, double yaw) {
            if (!std::isfinite(time + x + y + yaw)) {
              throw py::value_error("wave load: time, x, y or yaw is not finite; give s, m, m, rad");
            }
            PositionedLoad out;
            load.evaluate(time, x, y, yaw, out);
            return py::make_tuple(py::array_t<double>(6, out.force), py::array_t<double>(6, out.drift),
                                  out.elevation);
          },
          py::arg("time"), py::kw_only(), py::arg("x") = 0.0, py::arg("y") = 0.0, py::arg("yaw") = 0.0,
          "First-order load (6,), slow drift (6,), in yaw-following axes, and elevation (m) at one time (s) "
          "and "
          "pose (m, rad).")
      .def_property_readonly(
          "waves", [](const PositionedWaveLoad& load) { return load.waves(); }, "The components (a copy).");
}

void bind_wave_loads(py::module_& m) {
  using W = WaveLoadDescription;
  py::class_<W>(
      m, "WaveLoads",
      "Wave loads on a vessel: exact sums at the mean position, or tables of them with a stated error "
      "bound; or loads at the actual position, which replace all others.")
      .def(py::init([](std::string name, std::string body, std::shared_ptr<ExactWaveLoad> exact,
                       std::shared_ptr<WaveTable> table, std::shared_ptr<DriftLoad> drift,
                       std::shared_ptr<DriftTable> drift_table,
                       std::shared_ptr<PositionedWaveLoad> positioned) {
             return W{std::move(name),  std::move(body),        std::move(exact),     std::move(table),
                      std::move(drift), std::move(drift_table), std::move(positioned)};
           }),
           py::kw_only(), py::arg("name"), py::arg("body"), py::arg("exact") = py::none(),
           py::arg("table") = py::none(), py::arg("drift") = py::none(), py::arg("drift_table") = py::none(),
           py::arg("positioned") = py::none())
      .def_readonly("name", &W::name);
}

Complexes weighted_sums(const Doubles& weights, const Complexes& values) {
  const bool shared = values.ndim() == 2;
  const py::ssize_t first = shared ? 0 : 1;
  if (weights.ndim() != 2 || values.ndim() != first + 2 || values.shape(first) != weights.shape(1) ||
      (!shared && values.shape(0) != weights.shape(0))) {
    throw py::value_error("weighted sums: give weights (q, n) and values (n, d) or (q, n, d)");
  }
  const py::ssize_t width = values.shape(first + 1);
  Complexes out({weights.shape(0), width});
  const WeightedSums sums{static_cast<std::size_t>(weights.shape(0)),
                          static_cast<std::size_t>(weights.shape(1)), 2 * static_cast<std::size_t>(width),
                          shared};
  // A complex number lies in memory as its real and imaginary part.
  sums.evaluate(weights.data(), reinterpret_cast<const double*>(values.data()),
                reinterpret_cast<double*>(out.mutable_data()));
  return out;
}

using Places = py::array_t<std::ptrdiff_t, py::array::c_style | py::array::forcecast>;

Doubles spline_rows(const Places& knot, const Places& column, const Doubles& left, const Doubles& right,
                    const Doubles& bend_left, const Doubles& bend_right, const Doubles& curvature) {
  const py::ssize_t places = knot.size();
  for (const Doubles& one : {left, right, bend_left, bend_right}) {
    if (one.size() != places) throw py::value_error("spline rows: give as many shares as knots");
  }
  if (curvature.ndim() != 2 || column.size() != curvature.shape(0)) {
    throw py::value_error("spline rows: give curvature (knots, values) and a column for each knot");
  }
  const auto inside = [](const Places& at, py::ssize_t end) {
    return std::all_of(at.data(), at.data() + at.size(),
                       [end](std::ptrdiff_t i) { return i >= 0 && i < end; });
  };
  if (!inside(knot, curvature.shape(0) - 1) || !inside(column, curvature.shape(1))) {
    throw py::value_error("spline rows: a knot or column is not there");
  }
  Doubles out({places, curvature.shape(1)});
  const SplineWeights rows{static_cast<std::size_t>(places), static_cast<std::size_t>(curvature.shape(1)),
                           curvature.data()};
  rows.evaluate(knot.data(), column.data(), left.data(), right.data(), bend_left.data(), bend_right.data(),
                out.mutable_data());
  return out;
}

/// As `seacrane.description.compilation.kept_components` says.
py::array_t<bool> without_smallest(const Doubles& magnitudes, double limit) {
  if (magnitudes.ndim() != 2) throw py::value_error("magnitudes: give (components, channels)");
  const auto n = static_cast<std::size_t>(magnitudes.shape(0));
  const std::vector<char> kept =
      kept_components(magnitudes.data(), n, static_cast<std::size_t>(magnitudes.shape(1)), limit);
  py::array_t<bool> out(magnitudes.shape(0));
  std::copy(kept.begin(), kept.end(), out.mutable_data());
  return out;
}

}  // namespace

void bind_wave_load(py::module_& m) {
  bind_exact(m);
  bind_wave_table(m);
  bind_drift(m);
  bind_positioned(m);
  bind_wave_loads(m);
  m.def("spline_rows", &spline_rows, py::kw_only(), py::arg("knot"), py::arg("column"), py::arg("left"),
        py::arg("right"), py::arg("bend_left"), py::arg("bend_right"), py::arg("curvature"),
        "Weights (q, n) of a cubic spline at places behind knots (q,), by their shares of the values and of "
        "the second derivatives at both ends; see seacrane.hydro.data.interpolation. Raises ValueError for "
        "other shapes.");
  m.def(
      "without_smallest", &without_smallest, py::arg("magnitudes"), py::arg("limit"),
      "Which rows of magnitudes (n, m) are left where the smallest are left out, which sum to no more than a "
      "share of all in each column; at least one.");
  m.def("weighted_sums", &weighted_sums, py::arg("weights"), py::arg("values"),
        "Complex sums (q, d) of weights (q, n) times values (n, d), or (q, n, d), term by term in their "
        "order. Raises ValueError for other shapes.");
}
