#include <doctest/doctest.h>

#include <Eigen/QR>

#include "count_allocations.hpp"
#include "multibody_scenes.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"

namespace seacrane::test {
namespace {

/// One scene in both formulations, evaluated at the same state.
struct Evaluated {
  MaximalSystem redundant;
  std::shared_ptr<Terms> terms;
  RecursiveSystem recursive;
  std::vector<double> y, q, rate;

  explicit Evaluated(const SceneDescription& scene)
      : redundant(compile(scene)), terms(std::make_shared<Terms>(compile(scene))), recursive(terms) {
    y = moving_state(redundant, 4);
    redundant.project(0.3, y.data(), false);
    q.resize(recursive.size());
    recursive.read_bodies(0.3, y.data(), q.data());
    rate.resize(redundant.size());
    evaluate();
  }
  void evaluate() {
    redundant.derivative(0.3, y.data(), rate.data());
    recursive.derivative(0.3, q.data(), rate.data());
  }
  const double* memory() const { return y.data() + redundant.model().layout.memory; }
  std::vector<Vec6d> zeros() const {
    return std::vector<Vec6d>(redundant.terms().bodies().size(), Vec6d::Zero());
  }
};

double largest(const std::vector<Vec6d>& a) {
  double out = 0.0;
  for (const Vec6d& each : a) out = std::max(out, each.cwiseAbs().maxCoeff());
  return out;
}

double apart(std::vector<Vec6d> a, const std::vector<Vec6d>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return largest(a);
}

std::vector<SceneDescription> loaded_scenes() {
  Random random(3);
  return {slider_crank(), at_sea(true), strut_scene(random, true, false), parallelogram(3)};
}

}  // namespace

TEST_CASE(
    "the response to loads is what they accelerate while the joints hold: M a = load + D^T l, D a = 0") {
  Random random(8);
  for (const SceneDescription& scene : loaded_scenes()) {
    CAPTURE(scene.name);
    Evaluated at(scene);
    std::vector<Vec6d> load = at.zeros();
    for (Vec6d& wrench : load) wrench << random.vector(), random.vector();
    const DenseTerms terms = dense_terms(at.redundant);
    const Eigen::Index n = terms.mass.rows(), rows = terms.d.rows();
    MatXd equations = MatXd::Zero(n + rows, n + rows);
    equations.topLeftCorner(n, n) = terms.mass;
    equations.topRightCorner(n, rows) = -terms.d.transpose();
    equations.bottomLeftCorner(rows, n) = terms.d;
    VecXd right = VecXd::Zero(n + rows);
    for (Eigen::Index b = 0; 6 * b < n; ++b) right.segment<6>(6 * b) = load[static_cast<std::size_t>(b)];
    const VecXd solved = equations.completeOrthogonalDecomposition().solve(right);
    std::vector<Vec6d> expected = at.zeros();
    for (Eigen::Index b = 0; 6 * b < n; ++b) expected[static_cast<std::size_t>(b)] = solved.segment<6>(6 * b);

    std::vector<Vec6d> found = at.zeros();
    at.redundant.load_response(load, found);
    CHECK(apart(found, expected) < 1e-10 * (1.0 + largest(expected)));
    at.recursive.load_response(load, found);
    CHECK(apart(found, expected) < 1e-10 * (1.0 + largest(expected)));
  }
}

TEST_CASE("the response to an actuator's unit force is what one newton more accelerates") {
  for (const SceneDescription& scene : {slider_crank(), at_sea(true, 0.7)}) {
    Evaluated at(scene);
    const Actuator& drive = at.redundant.model().actuators().front();
    std::vector<Vec6d> unit = at.zeros(), found = at.zeros();
    drive.add_unit(0, at.redundant.terms().load_input(0.3, at.memory()), unit.data());
    std::vector<double> inputs(static_cast<std::size_t>(at.redundant.model().slot_count), 0.0);
    inputs[static_cast<std::size_t>(drive.slot)] = 1.0;
    const auto check = [&](Formulation& form) {
      at.evaluate();
      const std::vector<Vec6d> before = form.accelerations();
      form.load_response(unit, found);
      CHECK(largest(found) > 1e-3);
      CHECK(apart(form.accelerations(), before) == 0.0);
      form.terms().set_inputs(inputs);
      at.evaluate();
      for (std::size_t b = 0; b < before.size(); ++b) found[b] += before[b];
      CHECK(apart(found, form.accelerations()) < 1e-10 * largest(before));
    };
    check(at.redundant);
    check(at.recursive);
  }
}

TEST_CASE("the response to loads allocates nothing") {
  for (const SceneDescription& scene : loaded_scenes()) {
    Evaluated at(scene);
    const std::vector<Vec6d> load(at.zeros().size(), Vec6d::Ones());
    std::vector<Vec6d> found = at.zeros();
    const long before = allocation_count();
    at.redundant.load_response(load, found);
    at.recursive.load_response(load, found);
    CHECK(allocation_count() == before);
  }
}

}  // namespace seacrane::test
