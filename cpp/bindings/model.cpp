#include "seacrane/model/model.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "bindings.hpp"
#include "load_binding.hpp"
#include "seacrane/compile/compile.hpp"
#include "seacrane/compile/in_sea.hpp"
#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/energy.hpp"
#include "seacrane/dynamics/recursive/body_tree.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/dynamics/time_parts.hpp"
#include "seacrane/run/recording.hpp"
#include "seacrane/run/stepped_bodies.hpp"
#include "vector_state.hpp"
#include "without_gil.hpp"

using namespace seacrane;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

namespace {

std::shared_ptr<Model> compile_scene(
    std::string name, double gravity, const std::string& orientation, double baumgarte, double length_scale,
    std::vector<BodyDescription> bodies, std::vector<JointDescription> joints,
    std::vector<DriverDescription> drivers, const std::vector<py::object>& loads,
    std::vector<VesselDescription> vessels, std::vector<HydroGroupDescription> groups,
    std::vector<WaveLoadDescription> wave_loads,
    const std::vector<std::tuple<std::string, std::string, std::string>>& coordinates,
    std::vector<PointDescription> points, bool merge, std::shared_ptr<SeaField> sea) {
  SceneDescription scene;
  scene.name = std::move(name);
  scene.gravity = gravity;
  if (orientation != "quaternion" && orientation != "euler_xyz") {
    throw std::invalid_argument("scene '" + scene.name + "': orientation '" + orientation +
                                "' is unknown; choose 'quaternion' or 'euler_xyz'");
  }
  scene.orientation = orientation == "quaternion" ? Orientation::quaternion : Orientation::euler_xyz;
  scene.baumgarte = baumgarte;
  scene.length_scale = length_scale;
  scene.bodies = std::move(bodies);
  scene.joints = std::move(joints);
  scene.drivers = std::move(drivers);
  for (const py::object& load : loads) {
    if (py::isinstance<LimitDescription>(load)) {
      scene.limits.push_back(load.cast<LimitDescription>());
    } else {
      add_load(scene.loads, load);
    }
  }
  scene.vessels = std::move(vessels);
  scene.groups = std::move(groups);
  scene.wave_loads = std::move(wave_loads);
  for (const auto& [name, joint, coordinate] : coordinates) {
    scene.coordinates.push_back({{joint, coordinate}, name});
  }
  scene.points = std::move(points);
  scene.sea = std::move(sea);
  return std::const_pointer_cast<Model>(compile(scene, merge));
}

py::dict assembly_report(const Model& m) {
  const AssemblyReport& a = m.assembly;
  py::dict out;
  out["largest_translation_m"] = a.largest_translation;
  out["largest_rotation_rad"] = a.largest_rotation;
  out["most_moved_body"] = a.most_moved;
  out["open"] = a.open;
  out["residual_before"] = a.residual_before;
  out["residual_after"] = a.residual_after;
  out["rate_residual_after"] = a.rate_residual_after;
  out["largest_velocity_change"] = a.velocity_change;
  out["rank"] = a.rank;
  out["condition"] = a.condition;
  return out;
}

py::dict tree_of(const Model& model) {
  const BodyTree tree = build_tree(model.stepped());
  py::dict out;
  out["clusters"] = tree.clusters.size();
  out["struts"] = tree.struts.size();
  out["positions"] = tree.positions;
  out["speeds"] = tree.speeds;
  std::vector<std::string> driven;
  for (const Cluster& c : tree.clusters) {
    for (const int d : c.drive.drivers) {
      const int element = model.stepped().drivers[static_cast<std::size_t>(d)].element;
      driven.push_back(model.stepped().elements[static_cast<std::size_t>(element)].name);
    }
  }
  out["driven"] = driven;
  out["loop_rows"] = tree.loop_rows;
  out["refused"] = tree.refused;
  out["loop_trees"] = SparseLoops::trees_of(model.stepped(), tree);
  return out;
}

py::dict merge_of(const Model& model) {
  const Model& stepped = model.stepped();
  std::map<std::string, std::vector<std::string>> groups;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const int on = stepped.merge.places[b].body;
    const bool fixed = on == stepped.body_count();
    const std::string carrier = fixed ? kGround : stepped.bodies[static_cast<std::size_t>(on)].name;
    if (carrier != model.bodies[b].name) groups[carrier].push_back(model.bodies[b].name);
  }
  std::set<std::string> kept;
  for (const auto& e : stepped.elements) kept.insert(e.name);
  std::vector<std::string> dropped;
  for (const auto& e : model.elements) {
    if (kept.count(e.name) == 0) dropped.push_back(e.name);
  }
  py::dict out;
  out["bodies"] = groups;
  out["locked_by"] = stepped.merge.locked;
  out["dropped"] = dropped;
  out["coordinates"] = 6 * stepped.body_count();
  out["constraints"] = stepped.rows();
  out["left_out"] = std::ranges::count(stepped.left_out, 1);
  return out;
}

std::map<std::string, std::vector<std::string>> axes_of(const Model& model) {
  std::map<std::string, std::vector<std::string>> out;
  for (const Channel* channel : channels_of(model)) {
    for (const Axis* axis : channel->axes) out[axis->name] = labels_of(*axis, model);
  }
  return out;
}

/// Evaluates a model at single states, for tests, linearisation and timing.
class Evaluator {
 public:
  Evaluator(std::shared_ptr<Model> model, const std::string& formulation)
      : model_(std::move(model)), bodies_(formulation, model_), system_(bodies_.described()) {}

  Array derivative(double t, const Array& y) {
    Array out(check(y));
    system_.derivative(t, y.data(), out.mutable_data());
    return out;
  }
  /// d(dy/dt)/dy in maximal coordinates.
  Eigen::MatrixXd jacobian(double t, const Array& y) {
    const auto n = static_cast<Eigen::Index>(check(y));
    if (steps_recursive()) {
      throw std::invalid_argument(
          "jacobian: is in the variables of the state, and formulation \"recursive\" steps coordinates "
          "of its own; use formulation \"redundant\"");
    }
    Eigen::MatrixXd out(n, n);
    if (!system_.jacobian(t, y.data(), out.data())) {
      throw std::invalid_argument("model '" + model_->description.name +
                                  "' has no exact Jacobian at t = " + std::to_string(t) +
                                  " s: " + system_.missing_jacobian() + "; take differences of derivative()");
    }
    return out;
  }
  Array project(double t, const Array& y) {
    Array out(check(y));
    std::copy_n(y.data(), y.size(), out.mutable_data());
    system_.project(t, out.mutable_data(), false);
    return out;
  }
  std::pair<double, double> residual(double t, const Array& y) {
    check(y);
    const ConstraintResidual r = constraint_residual(system_.terms(), t, y.data());
    return {r.position, r.rate};
  }
  double energy(double t, const Array& y) {
    check(y);
    return mechanical_energy_at(system_.terms(), t, y.data());
  }
  /// Mass matrix, constraint Jacobian, gamma, loads, acceleration and multipliers of eq (9), dense.
  py::dict terms(double t, const Array& y) {
    std::vector<double> rate(static_cast<std::size_t>(check(y)));
    system_.derivative(t, y.data(), rate.data());
    const Terms& terms = system_.terms();
    const int n = 6 * model_->body_count(), rows = model_->rows();
    MatXd mass = MatXd::Zero(n, n), d = MatXd::Zero(rows, n);
    VecXd gamma(rows), phi(rows), load(n), acceleration(n);
    for (int b = 0; b < model_->body_count(); ++b) {
      mass.block<6, 6>(6 * b, 6 * b) = terms.mass_matrix(b);
      load.segment<6>(6 * b) = terms.loads()[static_cast<std::size_t>(b)];
      acceleration.segment<6>(6 * b) = system_.accelerations()[static_cast<std::size_t>(b)];
    }
    for (const MassCoupling& c : terms.couplings()) {
      mass.block<6, 6>(6 * c.first, 6 * c.second) = c.mass;
      mass.block<6, 6>(6 * c.second, 6 * c.first) = c.mass.transpose();
    }
    for (std::size_t e = 0; e < model_->elements.size(); ++e) {
      const ElementModel& el = model_->elements[e];
      const RowBlock<double>& block = terms.blocks()[e];
      if (el.first * 6 < n) d.block(el.row, 6 * el.first, el.rows, 6) = block.d[0].topRows(el.rows);
      if (el.second * 6 < n) d.block(el.row, 6 * el.second, el.rows, 6) = block.d[1].topRows(el.rows);
      gamma.segment(el.row, el.rows) = block.gamma.head(el.rows);
      phi.segment(el.row, el.rows) = block.phi.head(el.rows);
    }
    py::dict out;
    out["mass"] = mass;
    out["jacobian"] = d;
    out["gamma"] = gamma;
    out["phi"] = phi;
    out["load"] = load;
    out["acceleration"] = acceleration;
    out["multipliers"] = VecXd(Eigen::Map<const VecXd>(system_.multipliers().data(), rows));
    return out;
  }
  /// Runs the evaluation `count` times; the caller takes the time.
  void repeat(double t, const Array& y, long count, double dt) {
    check(y);
    std::vector<double> state(stepped().size()), rate(stepped().size());
    const WithoutGil released;
    clear_vector_state();
    bodies_.read(t, y.data(), state.data());
    for (long i = 0; i < count; ++i) {
      stepped().derivative(t + static_cast<double>(i) * dt, state.data(), rate.data());
    }
  }
  /// Accelerations of all bodies' state points (bodies, 6), by the formulation chosen.
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> accelerations(double t, const Array& y) {
    evaluate(t, y);
    Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> out(model_->body_count(), 6);
    for (int b = 0; b < model_->body_count(); ++b) {
      out.row(b) = bodies_.accelerations()[static_cast<std::size_t>(b)].transpose();
    }
    return out;
  }
  /// Factor by which terms cancel in the recursive form at a state.
  double condition(double t, const Array& y) {
    auto* const recursive = dynamic_cast<RecursiveSystem*>(&stepped());
    if (recursive == nullptr) {
      throw std::invalid_argument("condition: belongs to an Evaluator of formulation \"recursive\"");
    }
    check(y);
    std::vector<double> state(recursive->size());
    bodies_.read(t, y.data(), state.data());
    return recursive->condition(t, state.data());
  }
  py::dict time_parts(double t, const Array& y, long count) {
    check(y);
    if (count < 1) {
      throw std::invalid_argument("time_parts: count is " + std::to_string(count) + "; give at least 1");
    }
    py::dict out;
    for (const auto& [name, ns] : measured_parts(t, y, count)) out[name.c_str()] = ns;
    return out;
  }

 private:
  py::ssize_t check(const Array& y) const {
    if (y.ndim() != 1 || y.size() != model_->layout.size) {
      throw std::invalid_argument("state: has " + std::to_string(y.size()) + " values, the model needs " +
                                  std::to_string(model_->layout.size));
    }
    return y.size();
  }
  /// By the formulation chosen.
  void evaluate(double t, const Array& y) {
    check(y);
    std::vector<double> state(stepped().size()), rate(stepped().size());
    bodies_.read(t, y.data(), state.data());
    stepped().derivative(t, state.data(), rate.data());
  }
  std::vector<std::pair<std::string, double>> measured_parts(double t, const Array& y, long count) {
    if (auto* const recursive = dynamic_cast<RecursiveSystem*>(&stepped())) {
      std::vector<double> state(recursive->size());
      bodies_.read(t, y.data(), state.data());
      return recursive->time_parts(t, state.data(), count);
    }
    MaximalSystem system(model_->merged ? model_->merged : model_);
    return seacrane::time_parts(system, t, bodies_.merged(y.data()), count);
  }
  bool steps_recursive() { return std::string(stepped().name()) == "recursive"; }
  Formulation& stepped() { return bodies_.formulation(); }

  std::shared_ptr<Model> model_;
  SteppedBodies bodies_;
  MaximalSystem& system_;  // of all bodies as described
};

void bind_evaluator(py::module_& m) {
  py::class_<Evaluator>(m, "Evaluator",
                        "Evaluates a compiled model at single states (t in s, y as Model.initial_state).")
      .def(py::init<std::shared_ptr<Model>, std::string>(), py::arg("model").none(false),
           py::arg("formulation") = "redundant")
      .def("accelerations", &Evaluator::accelerations, py::arg("t"), py::arg("y"),
           "Accelerations of the bodies' state points by the formulation, m/s2 and rad/s2, (bodies, 6).")
      .def("condition", &Evaluator::condition, py::arg("t"), py::arg("y"),
           "How many times larger the terms are than what they cancel to, of inertias along the tree of the "
           "recursive formulation and of its loops: the digits that light bodies between heavy ones cost.")
      .def("derivative", &Evaluator::derivative, py::arg("t"), py::arg("y"), "dy/dt, a new array.")
      .def("jacobian", &Evaluator::jacobian, py::arg("t"), py::arg("y"),
           "Exact d(dy/dt)/dy (n, n), a new array: automatic differentiation, differences only for function "
           "forces; the history of a convolution is held. ValueError where there is none.")
      .def("project", &Evaluator::project, py::arg("t"), py::arg("y"), "y on the constraints, a new array.")
      .def("residual", &Evaluator::residual, py::arg("t"), py::arg("y"),
           "Largest constraint residuals (position in m or rad, rate per s).")
      .def("energy", &Evaluator::energy, py::arg("t"), py::arg("y"), "Mechanical energy, J.")
      .def("terms", &Evaluator::terms, py::arg("t"), py::arg("y"),
           "Dense mass, jacobian, gamma, phi, load, acceleration, multipliers of eq (9).")
      .def("repeat", &Evaluator::repeat, py::arg("t"), py::arg("y"), py::arg("count"), py::arg("dt") = 0.0,
           "Evaluates `count` times, advancing t by dt; for timing.")
      .def("time_parts", &Evaluator::time_parts, py::arg("t"), py::arg("y"), py::arg("count") = 2000,
           "Nanoseconds per evaluation by part.");
}

}  // namespace

void bind_model(py::module_& m) {
  py::class_<Model, std::shared_ptr<Model>>(m, "Model", py::dynamic_attr(),
                                            "A compiled scene: immutable, shareable between threads.")
      .def_property_readonly("name", [](const Model& x) { return x.description.name; })
      .def_property_readonly(
          "tree", &tree_of,
          "What formulation 'recursive' makes of the scene: clusters, struts (cylinder "
          "loops in closed form), positions, speeds, driven (drivers whose coordinate is a "
          "function of time and no unknown), loop_rows (rows left to close), "
          "loop_trees (trees, each with a root of its own, that they couple).")
      .def_property_readonly("merge", &merge_of,
                             "What runs step: bodies merged by the one that carries them, drivers that lock "
                             "a joint, elements dropped, coordinates and constraints of formulation "
                             "'redundant'.")
      .def_property_readonly("bodies",
                             [](const Model& x) {
                               std::vector<std::string> out;
                               for (const auto& b : x.bodies) out.push_back(b.name);
                               return out;
                             })
      .def_property_readonly(
          "elements",
          [](const Model& x) {
            std::vector<std::tuple<std::string, std::string, int, bool>> out;
            for (const auto& e : x.elements) out.emplace_back(e.name, e.kind, e.rows, e.unique_reaction);
            return out;
          },
          "(name, kind, rows, whether the reaction is unique) of joints, then drivers.")
      .def_property_readonly("coordinates", [](const Model& x) { return 6 * x.body_count(); })
      .def_property_readonly("constraints", &Model::rows)
      .def_property_readonly(
          "degrees_of_freedom",
          [](const Model& x) { return 6 * x.body_count() - (x.rows() == 0 ? 0 : x.assembly.rank); })
      .def_property_readonly("states", [](const Model& x) { return x.layout.size; })
      .def_property_readonly("memory_states", [](const Model& x) { return x.layout.work - x.layout.memory; })
      .def_property_readonly(
          "load_states",
          [](const Model& x) {
            std::vector<std::tuple<std::string, std::string, int, double, double>> out;
            for (std::size_t i = 0; i < x.load_states.size(); ++i) {
              const LoadState& s = x.load_states[i];
              out.emplace_back(s.name, s.unit, x.layout.loads + static_cast<int>(i), s.initial, s.scale);
            }
            return out;
          },
          "(name, unit, place in the state, start, scale of errors) of the states that loads have of their "
          "own; they are the last of the memory states.")
      .def_property_readonly(
          "history_samples",
          [](const Model& x) {
            Eigen::Index sum = 0;
            for (const Vessel& v : x.vessels) {
              if (const auto* tables = std::get_if<Convolution>(&v.memory)) sum += tables->length();
            }
            return sum;
          },
          "Points in time at which convolutions keep the motion of their vessels.")
      .def_property_readonly(
          "limits",
          [](const Model& x) {
            std::vector<std::pair<std::string, bool>> out;
            for (const Limit& limit : x.limits) out.emplace_back(limit.name, limit.element >= 0);
            return out;
          },
          "(name, whether it holds at the described start) of wires, bounds and seats, in the order of the "
          "channel limit_force.")
      .def_readonly("slots", &Model::slot_count)
      .def_property_readonly(
          "inputs",
          [](const Model& x) {
            std::vector<std::tuple<std::string, int, int>> out;
            for (const InputModel& input : x.inputs) out.emplace_back(input.name, input.slot, input.count);
            return out;
          },
          "(name, first slot, number of slots) of the zero-order-held inputs.")
      .def_property_readonly(
          "breakpoints",
          [](const Model& x) {
            std::set<double> times;
            for (const Kink& kink : x.kinks) times.insert(kink.time);
            return std::vector<double>(times.begin(), times.end());
          },
          "Times (s) at which curves of drivers and loads are not smooth.")
      .def_property_readonly(
          "kinks",
          [](const Model& x) {
            std::vector<std::pair<double, std::array<double, 4>>> out;
            for (const Kink& kink : x.kinks) out.emplace_back(kink.time, kink.jump);
            return out;
          },
          "(time, jumps) by time, one for each curve that is not smooth there: of velocity, acceleration and "
          "its first two derivatives, at the described start, over the scale of the state (1/s^p).")
      .def_property_readonly(
          "redundant", [](const Model& x) { return x.assembly.redundant; },
          "Names of elements whose reactions are not unique.")
      .def_property_readonly("assembly", &assembly_report)
      .def_readonly("paper_kinematics", &Model::paper_kinematics)
      .def_property_readonly(
          "euler_angles", [](const Model& x) { return x.description.orientation == Orientation::euler_xyz; },
          "Whether the state holds XYZ Euler angles.")
      .def_property_readonly("baumgarte", [](const Model& x) { return x.description.baumgarte; })
      .def_property_readonly(
          "initial_state",
          [](const Model& x) {
            return Array(static_cast<py::ssize_t>(x.initial_state.size()), x.initial_state.data());
          },
          "Consistent start (copy): poses, twists, memory states, states of loads, work.")
      .def_property_readonly(
          "line_bounces",
          [](const Model& x) {
            std::map<std::string, std::tuple<double, double, double>> out;
            for (const LineBounce& one : x.line_bounces) out[one.line] = {one.mass, one.omega, one.ratio};
            return out;
          },
          "By line: the mass (kg) that bounces on it at the start, as on one fall, the frequency of that "
          "(rad/s), and the ratio of critical damping that the lines give it.")
      .def_property_readonly(
          "scale",
          [](const Model& x) { return Array(static_cast<py::ssize_t>(x.scale.size()), x.scale.data()); },
          "Typical magnitude per state (copy); infinity: outside the error norm.")
      .def(
          "pose_index", [](const Model& x, int body) { return x.layout.pose(body); }, py::arg("body"))
      .def(
          "twist_index", [](const Model& x, int body) { return x.layout.twist(body); }, py::arg("body"))
      .def("channel_names", &channel_names, py::arg("defaults_only") = true)
      .def_property_readonly("axes", &axes_of, "The names along each dimension of its channels but time.")
      .def(
          "channel_values",
          [](const Model& m, const std::set<std::string>& names) { return Recording(m, names, 0).width(); },
          py::arg("names"), "How many numbers one output of these channels holds.")
      .def(
          "in_sea",
          [](const Model& m, const std::vector<WaveLoadDescription>& loads, std::shared_ptr<SeaField> sea) {
            return std::const_pointer_cast<Model>(in_sea(m, loads, std::move(sea)));
          },
          py::arg("wave_loads"), py::arg("sea") = py::none(),
          "The model of the same scene with other wave loads on the same vessels, in another field, as "
          "compiling it again gives. Raises SceneError.");
  m.def("compile", &compile_scene, py::kw_only(), py::arg("name"), py::arg("gravity"), py::arg("orientation"),
        py::arg("baumgarte"), py::arg("length_scale"), py::arg("bodies"), py::arg("joints"),
        py::arg("drivers"), py::arg("loads"), py::arg("vessels"), py::arg("groups"), py::arg("wave_loads"),
        py::arg("coordinates"), py::arg("points") = std::vector<PointDescription>{}, py::arg("merge") = true,
        py::arg("sea") = py::none(),
        "Checks and compiles a scene; seacrane.Scene.compile() calls it. Raises SceneError.");
  bind_evaluator(m);
}
