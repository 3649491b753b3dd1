#include <algorithm>

#include "bindings.hpp"
#include "seacrane/elements/check.hpp"
#include "shared_simulation.hpp"

using namespace seacrane;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

namespace {

Array to_array(const std::vector<double>& v) { return Array(static_cast<py::ssize_t>(v.size()), v.data()); }

std::vector<double> to_values(const Array& a) { return {a.data(), a.data() + a.size()}; }

/// Columns of the first `rows` rows of values, of a channel's shape.
Array columns(const std::vector<double>& values_by_row, std::size_t width, const RecordedChannel& c,
              std::size_t offset, py::ssize_t rows) {
  std::vector<py::ssize_t> shape{rows};
  for (std::size_t n : c.shape) shape.push_back(static_cast<py::ssize_t>(n));
  Array values(shape);
  double* target = values.mutable_data();
  for (py::ssize_t i = 0; i < rows; ++i) {
    const double* row = values_by_row.data() + static_cast<std::size_t>(i) * width + offset;
    target = std::copy_n(row, c.size, target);
  }
  return values;
}

py::dict channels(const Recording& r, std::size_t most) {
  const auto rows = static_cast<py::ssize_t>(std::min(r.count(), most));
  py::dict out;
  out["time"] = Array(rows, r.times().data());
  for (const RecordedChannel& c : r.channels()) {
    out[c.channel->name.c_str()] = columns(r.rows(), r.width(), c, c.offset, rows);
  }
  return out;
}

py::dict extremes(const Recording& r, std::size_t most) {
  const auto rows = static_cast<py::ssize_t>(std::min(r.count(), most));
  py::dict out;
  for (const RecordedChannel& c : r.channels()) {
    if (!c.least) continue;
    out[c.channel->name.c_str()] = py::make_tuple(columns(r.rows(), r.width(), c, *c.least, rows),
                                                  columns(r.rows(), r.width(), c, c.largest(), rows));
  }
  return out;
}

py::dict trail(const Trail& t) {
  const auto rows = static_cast<py::ssize_t>(t.times.size());
  py::dict out;
  out["time"] = Array(rows, t.times.data());
  std::size_t offset = 0;
  for (const RecordedChannel* c : t.channels) {
    out[c->channel->name.c_str()] = columns(t.rows, t.width(), *c, offset, rows);
    offset += c->size;
  }
  return out;
}

py::dict statistics(const Simulation& s) {
  const RunStatistics r = s.statistics();
  py::dict out;
  out["steps"] = r.counters.steps;
  out["rejected_steps"] = r.counters.rejected_steps;
  out["evaluations"] = r.counters.evaluations;
  out["jacobians"] = r.counters.jacobians;
  out["newton_iterations"] = r.counters.newton_iterations;
  out["projections"] = r.counters.projections;
  out["restarts"] = r.counters.restarts;
  out["dense_solves"] = r.dense_solves;
  if (s.has_limits() || !s.limits_reached().empty()) {
    out["events"] = s.events().size() + s.limits_reached().size();
  }
  if (s.has_limits()) out["impact_energy_lost_J"] = r.energy_lost;
  if (r.rank) {
    out["smallest_pivot"] = r.rank->pivot;
    out["smallest_pivot_at_s"] = r.rank->time;
    if (!r.rank->element.empty()) {
      out["smallest_singular_value"] = r.rank->singular_value;
      out["smallest_pivot_joint"] = r.rank->element;
      out["rank_changed"] = r.rank->rank_changed ? 1 : 0;
    }
  }
  out["wall_s"] = r.wall_seconds;
  out["states"] = s.state_size();
  return out;
}

py::list events(const Simulation& s) {
  std::vector<std::pair<double, py::tuple>> rows;
  for (const Event& e : s.events()) {
    rows.emplace_back(e.time, py::make_tuple(e.time, s.limit_name(e.limit), to_text(e.kind), e.speed,
                                             e.impulse, e.energy_lost));
  }
  for (const LimitReached& l : s.limits_reached()) {
    rows.emplace_back(l.time, py::make_tuple(l.time, l.name, l.kind, l.speed, 0.0, 0.0));
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  py::list out;
  for (const auto& row : rows) out.append(row.second);
  return out;
}

/// A function of the simulation as a method that waits for its turn.
template <class Function>
auto alone(Function function) {
  return [function](SharedSimulation& s) { return s.alone(function); };
}

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

std::vector<Vec6d> to_twists(const Rows& rows) {
  std::vector<Vec6d> out;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) out.emplace_back(rows.row(i).transpose());
  return out;
}

Rows to_rows(const std::vector<Vec6d>& twists) {
  Rows rows(static_cast<Eigen::Index>(twists.size()), 6);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    rows.row(i) = twists[static_cast<std::size_t>(i)].transpose();
  return rows;
}

void bind_history(py::module_& m) {
  using H = TwistHistory;
  py::class_<H>(
      m, "TwistHistory",
      "What a convolution keeps of a vessel's motion, in the frame that follows yaw: `recent` (3, 6) "
      "at the newest samples, `quadrature` (n, 6) at the quadrature points of the past, newest first; "
      "at rest before `start` (s), `intervals` steps of the convolution ago.")
      .def(py::init([](double start, long intervals, const Rows& recent, const Rows& quadrature) {
             return H{start, intervals, to_twists(recent), to_twists(quadrature)};
           }),
           py::kw_only(), py::arg("start"), py::arg("intervals"), py::arg("recent"), py::arg("quadrature"))
      .def_readonly("start", &H::start, "s")
      .def_readonly("intervals", &H::intervals)
      .def_property_readonly(
          "recent", [](const H& h) { return to_rows(h.recent); }, "m/s and rad/s, copy")
      .def_property_readonly(
          "quadrature", [](const H& h) { return to_rows(h.quadrature); }, "m/s and rad/s, copy");
}

void bind_steps(py::module_& m) {
  using S = StepHistory;
  py::class_<S>(
      m, "StepHistory",
      "What an integrator keeps from step to step, in the coordinates of a formulation, and the rate of the "
      "state: a run with the same settings continues bit for bit (methods of SUNDIALS restart). Another "
      "formulation, integrator or scene, or other values or inputs, start from the values alone.")
      .def(
          py::init([](std::string formulation, std::string integrator, const Array& values, const Array& rate,
                      std::optional<double> kink) {
            return S{std::move(formulation), std::move(integrator), to_values(values), to_values(rate), kink};
          }),
          py::kw_only(), py::arg("formulation"), py::arg("integrator"), py::arg("values"), py::arg("rate"),
          py::arg("kink") = py::none())
      .def_readonly("formulation", &S::formulation)
      .def_readonly("integrator", &S::integrator)
      .def_property_readonly(
          "values", [](const S& s) { return to_array(s.values); }, "copy")
      .def_property_readonly(
          "rate", [](const S& s) { return to_array(s.rate); }, "copy")
      .def_readonly(
          "kink", &S::kink,
          "Where a step that is taken again is to end, at a kink of a load in the state, s; None: nowhere.");
}

void bind_options(py::module_& m) {
  py::class_<RunOptions>(
      m, "RunOptions",
      "Formulation and method of a run, and what it records. `scaled_tolerance`: local error of a step in "
      "units of the scale of each state (Model.scale). None: of `fixed_step` and `spectral_radius` the "
      "method's own, of `max_step` and `energy_limit` no limit, of `capacity` memory for all outputs. "
      "`extremes`: those of the channels of which least and largest values between outputs are kept, "
      "where the core has them (Channel.has_extremes). `trail`: those whose values at every step are kept, "
      "where they follow from a state.")
      .def(py::init([](std::string formulation, std::string integrator, double scaled_tolerance,
                       std::optional<double> fixed_step, std::optional<double> max_step,
                       std::optional<double> spectral_radius, std::optional<double> energy_limit,
                       const Array& output_times, std::set<std::string> channels,
                       std::set<std::string> extremes, std::set<std::string> trail,
                       std::optional<std::size_t> capacity) {
             return RunOptions{std::move(formulation),
                               std::move(integrator),
                               scaled_tolerance,
                               fixed_step,
                               max_step,
                               spectral_radius,
                               energy_limit,
                               to_values(output_times),
                               capacity,
                               std::move(channels),
                               std::move(extremes),
                               std::move(trail),
                               RunOptions{}.ask_every};
           }),
           py::kw_only(), py::arg("formulation") = "redundant", py::arg("integrator"),
           py::arg("scaled_tolerance") = RunOptions{}.scaled_tolerance, py::arg("fixed_step") = py::none(),
           py::arg("max_step") = py::none(), py::arg("spectral_radius") = py::none(),
           py::arg("energy_limit") = py::none(), py::arg("output_times"), py::arg("channels"),
           py::arg("extremes") = std::set<std::string>(), py::arg("trail") = std::set<std::string>(),
           py::arg("capacity") = py::none());
}

py::module_ state_file() { return py::module_::import("seacrane.inputs.state"); }

void bind_record(py::module_& m) {
  using R = RecordHistory;
  py::class_<R>(
      m, "RecordHistory",
      "What recording keeps from output to output, used where `steps` is: energy and work (J) that "
      "energy_balance is counted from, the largest residual before projection since the last output (m or "
      "rad), energy lost in impacts (J), the last recorded quaternions, and least and largest "
      "values since the last output.")
      .def(py::init([](double start_energy, double start_work, double residual, double impact_loss,
                       const Array& quaternions, const Array& extremes) {
             return R{start_energy,           start_work,         residual, impact_loss,
                      to_values(quaternions), to_values(extremes)};
           }),
           py::kw_only(), py::arg("start_energy"), py::arg("start_work"), py::arg("residual"),
           py::arg("impact_loss"), py::arg("quaternions"), py::arg("extremes") = std::vector<double>())
      .def_readonly("impact_loss", &R::impact_loss, "J")
      .def_readonly("start_energy", &R::start_energy, "J")
      .def_readonly("start_work", &R::start_work, "J")
      .def_readonly("residual", &R::residual, "m or rad")
      .def_property_readonly(
          "quaternions", [](const R& r) { return to_array(r.quaternions); }, "copy")
      .def_property_readonly(
          "extremes", [](const R& r) { return to_array(r.extremes); },
          "Least and largest values since the last output, and the steps before; a copy.");
}

}  // namespace

/// Asks Python for Ctrl-C and reports progress; called every 20 ms of wall time. What another signal's
/// handler raises is passed on.
bool SharedSimulation::ask_python(double time, const py::object& progress) {
  py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) {
    if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) throw py::error_already_set();
    PyErr_Clear();
    return false;
  }
  if (!progress.is_none()) progress(time);
  return true;
}

void bind_simulation(py::module_& m) {
  bind_history(m);
  bind_steps(m);
  bind_record(m);
  bind_options(m);
  py::class_<State>(m, "State", "Time (s), state values and inputs of a run; a copy is a checkpoint.")
      .def(py::init([](double time, const Array& values, const Array& inputs,
                       std::vector<TwistHistory> histories, StepHistory steps,
                       std::optional<std::vector<std::string>> closed, std::optional<RecordHistory> record,
                       std::vector<std::string> parts) {
             return State{time,
                          to_values(values),
                          to_values(inputs),
                          std::move(histories),
                          std::move(steps),
                          std::move(closed),
                          std::move(record),
                          std::move(parts)};
           }),
           py::kw_only(), py::arg("time"), py::arg("values"), py::arg("inputs"),
           py::arg("histories") = std::vector<TwistHistory>{}, py::arg("steps") = StepHistory{},
           py::arg("closed") = py::none(), py::arg("record") = py::none(),
           py::arg("parts") = std::vector<std::string>{})
      .def_readonly("closed", &State::closed,
                    "Names of the limits that hold (copy); None: as at the described start.")
      .def_readonly("time", &State::time)
      .def_property_readonly(
          "values", [](const State& s) { return to_array(s.values); }, "copy")
      .def_property_readonly(
          "inputs", [](const State& s) { return to_array(s.inputs); }, "copy")
      .def_property_readonly(
          "histories", [](const State& s) { return s.histories; },
          "One TwistHistory per vessel with a convolution (copies); none: at rest before `time`.")
      .def_property_readonly(
          "steps", [](const State& s) { return s.steps; }, "StepHistory (copy); its names are empty: none.")
      .def_property_readonly(
          "record", [](const State& s) { return s.record; }, "RecordHistory (copy), or None.")
      .def_readonly(
          "parts", &State::parts,
          "What the values belong to, in words; a run of a scene with other parts refuses the state. Empty: "
          "not known.")
      .def_property_readonly(
          "load_states",
          [](const State& s) {
            py::dict out;
            const LoadStates found = load_states(s);
            for (std::size_t i = 0; i < found.names.size(); ++i) {
              out[found.names[i].c_str()] = s.values.at(found.first + i);
            }
            return out;
          },
          "The states that loads have of their own, by name, such as a winch's \"hoist.length\" (copy).")
      .def(
          "with_load_states",
          [](State s, const std::map<std::string, double>& values) {
            const LoadStates found = load_states(s);
            for (const auto& [name, value] : values) {
              const auto at = std::find(found.names.begin(), found.names.end(), name);
              if (at == found.names.end()) {
                std::string known;
                for (const std::string& one : found.names) known += (known.empty() ? "" : ", ") + one;
                throw SceneError("state: there is no load state '" + name + "'; this one has " +
                                 (known.empty() ? "none" : known));
              }
              s.values.at(found.first + static_cast<std::size_t>(at - found.names.begin())) = value;
            }
            return s;
          },
          py::arg("values"),
          "The same state with other values of states of loads, by name; a run starts from it afresh.")
      .def(
          "save", [](const State& s, const py::object& path) { state_file().attr("save_state")(s, path); },
          py::arg("path"), "Writes the state to a file, complete or not at all; see docs/restart.md.")
      .def_static(
          "load",
          [](const py::object& path, const py::object& scene) {
            return state_file().attr("load_state")(path, py::arg("scene") = scene).cast<State>();
          },
          py::arg("path"), py::kw_only(), py::arg("scene") = py::none(),
          "Reads what save() wrote; FileFormatError for a damaged file, and for a state of other parts than "
          "those of `scene`, where one is given.");
  m.def(
      "initial_state", [](const std::shared_ptr<Model>& model) { return initial_state(*model); },
      py::arg("model").none(false));
  using S = SharedSimulation;
  py::class_<S>(
      m, "Simulation",
      "One run of a model: advance(), inputs, recorded channels. Threads may share it: one at a time "
      "is inside; advance() lets the others in every 20 ms, between two steps. In a with statement "
      "it is this thread's until the end of it.")
      .def(py::init([](const std::shared_ptr<Model>& model, const State& start, RunOptions options) {
             return std::make_unique<S>(model, start, std::move(options));
           }),
           py::kw_only(), py::arg("model").none(false), py::arg("start"), py::arg("options"))
      .def("advance", &S::advance, py::arg("t_end"), py::arg("progress") = py::none(),
           "Steps to t_end (s) without the GIL; returns False when Ctrl-C stopped it, or the interpreter "
           "ends. progress(time) is called now and then. SimulationError while the run is advanced already.")
      .def("__enter__",
           [](const py::object& self) {
             self.cast<S&>().enter();
             return self;
           })
      .def("__exit__", [](S& s, const py::object&, const py::object&, const py::object&) { s.leave(); })
      .def_property_readonly("time", alone([](Simulation& s) { return s.time(); }))
      .def_property_readonly("set_aside", alone([](Simulation& s) { return s.set_aside(); }),
                             "Why it was not stepped on beside others; empty: it was.")
      .def_property_readonly("steps", alone([](Simulation& s) { return s.steps(); }),
                             "Steps so far; `statistics` tells more, and takes longer.")
      .def_property_readonly("order", alone([](Simulation& s) { return s.order(); }),
                             "Order of the method, the highest where it varies.")
      .def_property_readonly("adaptive", alone([](Simulation& s) { return s.is_adaptive(); }),
                             "Whether the method chooses its steps.")
      .def_property_readonly("state", alone([](Simulation& s) { return s.state(); }), "copy")
      .def(
          "set_inputs",
          [](S& s, const Array& slots) {
            s.alone([&](Simulation& run) { run.set_inputs(to_values(slots)); });
          },
          py::arg("slots"), "Sets the zero-order-held inputs from now on.")
      .def(
          "channels",
          [](S& s, std::size_t most) {
            return s.alone([most](Simulation& run) { return channels(run.recording(), most); });
          },
          py::arg("most") = std::numeric_limits<std::ptrdiff_t>::max(),
          "Recorded arrays by name, time first (copies), of no more than the first `most` outputs.")
      .def(
          "extremes",
          [](S& s, std::size_t most) {
            return s.alone([most](Simulation& run) { return extremes(run.recording(), most); });
          },
          py::arg("most") = std::numeric_limits<std::ptrdiff_t>::max(),
          "Least and largest values by channel, at each output those since the output before (copies).")
      .def("trail", alone([](Simulation& s) { return trail(s.trail()); }),
           "Values of the channels of RunOptions.trail at the middle and the end of every step, time first "
           "(copies).")
      .def_property_readonly("recorded", alone([](Simulation& s) { return s.recording().count(); }),
                             "Outputs recorded.")
      .def(
          "drop",
          [](S& s, std::size_t count) { s.alone([count](Simulation& run) { run.drop_rows(count); }); },
          py::arg("count"), "Drops the first `count` outputs recorded.")
      .def("snapshot", alone([](Simulation& s) { return channels(s.snapshot(), 1); }),
           "All channels at the present time, arrays of one row.")
      .def("events", alone([](Simulation& s) { return events(s); }),
           "(time in s, limit, kind, speed of approach in m/s or rad/s, impulse in N s or N m s, energy lost "
           "in J) of all events so far.")
      .def("statistics", alone([](Simulation& s) { return statistics(s); }));
}
