#include <string>
#include <vector>

#include "bindings.hpp"
#include "processor.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/model/difference.hpp"
#include "seacrane/run/side_by_side.hpp"
#include "shared_simulation.hpp"

using namespace seacrane;

namespace {

/// Whether this processor has the instructions; only names that lanes are compiled for are known.
bool has_instructions(const std::string& name) {
  if (name == "avx2") return Processor::here().avx2;
  if (name == "avx512") return Processor::here().avx512;
  return name.empty();
}

/// What a lane module offers, if it was compiled as the core is.
const LaneModule& offered_by(const py::module_& module) {
  const auto& offered = *module.attr("offered").cast<py::capsule>().get_pointer<const LaneModule>();
  if (offered.layout != layout_of_models()) {
    throw std::invalid_argument("the lanes for " + std::string(offered.instructions) +
                                " were compiled otherwise than the core; build both together");
  }
  return offered;
}

std::vector<Simulation*> simulations_of(const std::vector<SharedSimulation*>& shared) {
  std::vector<Simulation*> out;
  for (SharedSimulation* one : shared) out.push_back(one->alone([](Simulation& s) { return &s; }));
  return out;
}

/// Calls f() while the runs from `next` on are this thread's to advance.
template <class F>
bool while_advancing(const std::vector<SharedSimulation*>& runs, std::size_t next, const F& f) {
  if (next == runs.size()) return f();
  return runs[next]->while_advancing([&](Simulation&) { return while_advancing(runs, next + 1, f); });
}

template <class F>
bool between_steps(const std::vector<SharedSimulation*>& runs, std::size_t next, const F& f) {
  if (next == runs.size()) return f();
  return runs[next]->between_steps([&] { return between_steps(runs, next + 1, f); });
}

bool advance_side_by_side(const std::vector<SharedSimulation*>& runs, const py::module_& module, double t_end,
                          const py::object& progress) {
  const LaneModule& offered = offered_by(module);
  return while_advancing(runs, 0, [&] {
    const WithoutGil released;
    clear_vector_state();
    SideBySide lanes(simulations_of(runs), offered);
    return lanes.advance(t_end, [&](double time) {
      if (WithoutGil::should_return()) return false;
      return between_steps(runs, 0, [&] { return SharedSimulation::ask_python(time, progress); });
    });
  });
}

/// Evaluates models at single states, in lanes and one by one; for checks and timing.
class LaneEvaluator {
 public:
  using States = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  LaneEvaluator(const py::module_& module, const std::vector<std::shared_ptr<Model>>& models)
      : lanes_(offered_by(module).lanes) {
    if (models.size() != lanes_) {
      throw std::invalid_argument("LaneEvaluator: " + std::to_string(models.size()) + " models; give " +
                                  std::to_string(lanes_));
    }
    const LaneModels all(models.begin(), models.end());
    for (const auto& model : all) {
      const std::string why = kept_out_of_lanes(*model);
      if (!why.empty()) throw std::invalid_argument("LaneEvaluator: not in lanes: " + why);
      const std::string other = difference(*all.front(), *model);
      if (!other.empty()) throw std::invalid_argument("LaneEvaluator: the models differ in " + other);
      scalar_.push_back(std::make_unique<SteppedBodies>("recursive", model));
    }
    system_ = offered_by(module).make(all);
  }

  /// The starts of the models, one for each lane, in coordinates of the tree.
  States start() {
    States out(rows(), columns());
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      SteppedBodies& bodies = *scalar_[lane];
      bodies.read(0.0, bodies.described().terms().model().initial_state.data(), out.row(row(lane)).data());
    }
    return out;
  }
  States derivative(double t, const States& y) {
    const std::vector<double> state = side_by_side(y);
    std::vector<double> rate(state.size());
    system_->derivative(t, state.data(), rate.data());
    States out(rows(), columns());
    for (Eigen::Index i = 0; i < out.size(); ++i) {
      out(i % rows(), i / rows()) = rate[static_cast<std::size_t>(i)];
    }
    return out;
  }
  States scalar_derivative(double t, const States& y) {
    check(y);
    States out(rows(), columns());
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      scalar_[lane]->formulation().derivative(t, y.row(row(lane)).data(), out.row(row(lane)).data());
    }
    return out;
  }
  void repeat(double t, const States& y, long count, double dt) {
    const std::vector<double> state = side_by_side(y);
    std::vector<double> rate(state.size());
    for (long i = 0; i < count; ++i) {
      system_->derivative(t + static_cast<double>(i) * dt, state.data(), rate.data());
    }
  }

 private:
  static Eigen::Index row(std::size_t lane) { return static_cast<Eigen::Index>(lane); }
  Eigen::Index rows() const { return row(lanes_); }
  Eigen::Index columns() const { return static_cast<Eigen::Index>(system_->size() / lanes_); }
  void check(const States& y) const {
    if (y.rows() == rows() && y.cols() == columns()) return;
    throw std::invalid_argument("LaneEvaluator: states are (" + std::to_string(y.rows()) + ", " +
                                std::to_string(y.cols()) + "); give (" + std::to_string(rows()) + ", " +
                                std::to_string(columns()) + ")");
  }
  std::vector<double> side_by_side(const States& y) const {
    check(y);
    std::vector<double> out;
    for (Eigen::Index i = 0; i < y.cols(); ++i) {
      for (Eigen::Index lane = 0; lane < y.rows(); ++lane) out.push_back(y(lane, i));
    }
    return out;
  }

  std::size_t lanes_;
  std::vector<std::unique_ptr<SteppedBodies>> scalar_;
  std::unique_ptr<LaneSystem> system_;
};

}  // namespace

void bind_lanes(py::module_& m) {
  m.def("has_instructions", &has_instructions, py::arg("name"),
        "Whether this processor has the instructions that a lane module is compiled for.");
  m.def(
      "lanes_of", [](const py::module_& module) { return offered_by(module).lanes; }, py::arg("module"),
      "How many runs a lane module steps side by side.");
  m.def(
      "kept_apart",
      [](const std::vector<SharedSimulation*>& runs) { return kept_apart(simulations_of(runs)); },
      py::arg("runs"), "Why runs cannot be stepped side by side; empty: they can.");
  m.def(
      "lanes_differ", [](const Model& one, const Model& other) { return difference(one, other); },
      py::arg("one"), py::arg("other"),
      "What two models differ in of what runs side by side share; empty: nothing.");
  m.def("advance_side_by_side", &advance_side_by_side, py::arg("runs"), py::arg("module"), py::arg("t_end"),
        py::arg("progress") = py::none(),
        "Steps runs, whose models differ in their seas alone, to t_end (s) in the lanes of a module, as far "
        "as "
        "each goes there; False as of Simulation.advance.");
  using E = LaneEvaluator;
  py::class_<E>(m, "LaneEvaluator",
                "Evaluates models that differ in their seas at single states (lanes, n), in coordinates of "
                "the tree.")
      .def(py::init<const py::module_&, const std::vector<std::shared_ptr<Model>>&>(), py::arg("module"),
           py::arg("models"))
      .def("start", &E::start, "The described starts.")
      .def("derivative", &E::derivative, py::arg("t"), py::arg("y"), "dy/dt, in lanes.")
      .def("scalar_derivative", &E::scalar_derivative, py::arg("t"), py::arg("y"), "dy/dt, one by one.")
      .def("repeat", &E::repeat, py::arg("t"), py::arg("y"), py::arg("count"), py::arg("dt") = 0.0,
           "Evaluates in lanes `count` times, advancing t by dt; for timing.");
}
