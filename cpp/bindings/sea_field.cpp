#include "seacrane/sea/sea_field.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "sea_arrays.hpp"
#include "seacrane/sea/flow_evaluator.hpp"
#include "seacrane/sea/require.hpp"
#include "vector_state.hpp"

using namespace seacrane;

namespace {

using Flows = std::span<const LocalFlow<double>>;

/// Rows of eleven: elevation, its rate, its two slopes, velocity, acceleration, pressure over density.
constexpr py::ssize_t flow_width = 11;

double* write_flow(const LocalFlow<double>& flow, double* to) {
  LocalFlow<double> copy;
  LocalFlow<double>::each(flow, copy, [&](double from, double&) { *to++ = from; });
  return to;
}

py::array_t<double> flow_rows(Flows flows) {
  py::array_t<double> out({static_cast<py::ssize_t>(flows.size()), flow_width});
  double* to = out.mutable_data();
  for (const LocalFlow<double>& flow : flows) to = write_flow(flow, to);
  return out;
}

py::array_t<double> flow_at(const SeaField& field, const Doubles& times, const Doubles& points) {
  if (times.ndim() != 1 || points.ndim() != 2 || points.shape(1) != 3) {
    throw py::value_error("sea field: give times (n,) and points (m, 3)");
  }
  py::array_t<double> out({times.size(), points.shape(0), flow_width});
  double* to = out.mutable_data();
  const double *t = times.data(), *p = points.data();
  const py::ssize_t count = times.size(), places = points.shape(0);
  for (py::ssize_t i = 0; i < 3 * places; ++i) {
    sea::require(std::isfinite(p[i]), "sea field", "a coordinate", p[i], "give finite ones in m");
    sea::require(i % 3 != 2 || p[i] >= -field.depth(), "sea field", "z", p[i],
                 "give a height above the sea floor at z = -" + std::to_string(field.depth()) + " m");
  }
  for (py::ssize_t i = 0; i < count; ++i) {
    sea::require(std::isfinite(t[i]), "sea field", "a time", t[i], "give finite ones in s");
  }
  const WithoutGil released;
  clear_vector_state();
  for (py::ssize_t i = 0; i < count; ++i) {
    for (py::ssize_t j = 0; j < places; ++j) {
      to = write_flow(field.at<double>(t[i], Vec3d(p[3 * j], p[3 * j + 1], p[3 * j + 2])), to);
    }
  }
  return out;
}

}  // namespace

void bind_current(py::module_& m) {
  py::class_<Current, std::shared_ptr<Current>>(
      m, "Current",
      "Steady horizontal current over depth: linear between depths, held beyond the first and the last.\n\n"
      "`depth` (n,), m below the still water, increasing; `x`, `y` (n,), m/s, inertial frame. Raises\n"
      "ValueError.")
      .def(py::init([](const Doubles& depth, const Doubles& x, const Doubles& y) {
             return Current(to_vector(depth, "current", "depth"), to_vector(x, "current", "x"),
                            to_vector(y, "current", "y"));
           }),
           py::kw_only(), py::arg("depth"), py::arg("x"), py::arg("y"))
      .def(
          "wavenumber",
          [](const Current& c, const Doubles& omega, const Doubles& direction, double depth, double gravity) {
            const std::vector<double> w = to_vector(omega, "current", "omega");
            const std::vector<double> b = to_vector(direction, "current", "direction");
            sea::require(b.size() == w.size(), "current", "length of direction", b.size(),
                         "give one value per frequency");
            py::array_t<double> out(omega.size());
            for (std::size_t i = 0; i < w.size(); ++i) {
              out.mutable_data()[i] = c.wavenumber(w[i], std::cos(b[i]), std::sin(b[i]), depth, gravity);
            }
            return out;
          },
          py::kw_only(), py::arg("omega"), py::arg("direction"), py::arg_v("depth", infinity, "float('inf')"),
          py::arg("gravity") = standard_gravity,
          "Wavenumbers (n,), rad/m, of waves that a fixed observer sees at omega (n,), rad/s, and that "
          "travel "
          "to direction (n,), rad: (omega - k U)^2 = g k tanh(k depth), with U of the profile by Stewart and "
          "Joy (1974) and Skop (1987). NaN where the current stops the wave.")
      .def(
          "velocity",
          [](const Current& c, const Doubles& z) {
            py::array_t<double> out({z.size(), py::ssize_t{2}});
            for (py::ssize_t i = 0; i < z.size(); ++i) {
              const auto v = c.at<double>(z.data()[i]);
              out.mutable_data()[2 * i] = v.x;
              out.mutable_data()[2 * i + 1] = v.y;
            }
            return out;
          },
          py::arg("z"), "Along x and y, (n, 2), m/s, at heights z (n,), m.");
}

void bind_sea_field(py::module_& m) {
  py::class_<SeaField, std::shared_ptr<SeaField>>(
      m, "SeaField",
      R"(Waves and current of a scene as loads see them at moving points; immutable.

Flows are rows of eleven numbers: elevation (m), its rate (m/s) and its slopes over x and y, velocity (3, m/s,
with the current), acceleration (3, m/s2, of the water, first order), dynamic pressure over density (m2/s2).
Above the water they are those at its level.)")
      .def(py::init([](const WaveComponents& waves, const std::string& stretching) {
             return SeaField(waves, stretching_of(stretching));
           }),
           py::arg("waves"), py::kw_only(), py::arg("stretching") = "wheeler")
      .def("at", &flow_at, py::kw_only(), py::arg("times"), py::arg("points"),
           "Flows (n, m, 11) at times (n,), s, and points (m, 3), m, component by component.");

  py::class_<FlowEvaluator>(
      m, "FlowEvaluator",
      "A stencil of `count` points in a sea field, for tests and timing; loads hold theirs in the core.")
      .def(py::init([](std::shared_ptr<SeaField> field, std::size_t count, double cut) {
             return FlowEvaluator(std::move(field), {"stencil", count, cut});
           }),
           py::arg("field"), py::kw_only(), py::arg("count"), py::arg("cut") = 1e-5)
      .def(
          "line",
          [](FlowEvaluator& e, double time, const Vec3d& first, const Vec3d& step, bool whole) {
            clear_vector_state();
            return flow_rows(e.line(time, first, step, whole));
          },
          py::kw_only(), py::arg("time"), py::arg("first"), py::arg("step"), py::arg("whole") = true,
          "Flows (count, 11) at first + i step, m; with `whole` each is the mean over an element as long as "
          "the step.")
      .def(
          "cloud",
          [](FlowEvaluator& e, double time, const std::vector<Vec3d>& points,
             const std::vector<Mat3d>& extents) {
            if (points.size() != e.stencil().count || extents.size() != points.size()) {
              throw py::value_error("stencil: give as many points and extents as it has");
            }
            std::vector<FlowPoint> at(points.size());
            for (std::size_t i = 0; i < at.size(); ++i) at[i] = {points[i], extents[i]};
            clear_vector_state();
            return flow_rows(e.cloud(time, at));
          },
          py::kw_only(), py::arg("time"), py::arg("points"), py::arg("extents"),
          "Flows (count, 11) at points (count, 3), m, of elements whose extents along three axes are the "
          "columns of (count, 3, 3), m.")
      .def(
          "error_bound",
          [](const FlowEvaluator& e, double time, double x, double y) {
            const LocalFlow<double> bound = e.error_bound(time, x, y);
            return flow_rows({&bound, 1});
          },
          py::kw_only(), py::arg("time"), py::arg("x"), py::arg("y"),
          "Bounds (1, 11) of the distance from the sum component by component.");
}
