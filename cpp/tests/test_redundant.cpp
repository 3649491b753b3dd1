#include <doctest/doctest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/energy.hpp"
#include "seacrane/dynamics/gear_gupta_leimkuhler.hpp"

namespace seacrane::test {
namespace {

SceneDescription floating() {
  SceneDescription scene = slider_crank("hull");
  make_vessel(scene, "hull");
  return scene;
}

/// y moved along dy/dt = rate by a small time.
std::vector<double> along(const std::vector<double>& y, const std::vector<double>& rate, double t) {
  std::vector<double> out = y;
  for (std::size_t i = 0; i < y.size(); ++i) out[i] += t * rate[i];
  return out;
}

VecXd twists(const Model& m, const std::vector<double>& y) {
  return Eigen::Map<const VecXd>(y.data() + m.layout.velocity, 6 * m.body_count());
}

}  // namespace

TEST_CASE("an evaluation solves equation 9: balance of every body, and D vdot = gamma") {
  for (const SceneDescription& scene : {slider_crank(), floating(), parallelogram(3)}) {
    CAPTURE(scene.name);
    MaximalSystem system(compile(scene));
    const std::vector<double> y = moving_state(system, 21);
    std::vector<double> rate(y.size());
    system.derivative(0.3, y.data(), rate.data());
    const DenseTerms k = dense_terms(system);
    CHECK((k.mass * k.acceleration - k.load - k.d.transpose() * k.lambda).norm() < 1e-11 * k.load.norm());
    CHECK((k.d * k.acceleration - k.gamma).norm() < 1e-11 * (1.0 + k.gamma.norm()));
    CHECK((twists(system.model(), rate) - k.acceleration).norm() == 0.0);
  }
}

TEST_CASE("energy changes by the recorded power: loads, springs, actuators, drivers, waves and memory") {
  for (const SceneDescription& scene : {slider_crank(), floating()}) {
    MaximalSystem system(compile(scene));
    // The reference velocity of the driver at t = 0.3 enters by projection.
    std::vector<double> y = moving_state(system, 22);
    system.project(0.3, y.data(), false);
    std::vector<double> rate(y.size());
    system.derivative(0.3, y.data(), rate.data());
    const double power = rate[static_cast<std::size_t>(system.model().layout.work)];
    const double energy_rate = slope(
        [&](double t) { return mechanical_energy_at(system.terms(), 0.3, along(y, rate, t).data()); }, 1e-4);
    CHECK(std::abs(power) > 0.1);
    CHECK(energy_rate == doctest::Approx(power).epsilon(1e-8));
    CHECK(rate[static_cast<std::size_t>(system.model().layout.work + 1)] >= std::abs(power));
  }
}

TEST_CASE("projection closes poses and velocities, and does nothing where they are closed") {
  for (const SceneDescription& scene : {slider_crank(), floating(), parallelogram(3)}) {
    CAPTURE(scene.name);
    MaximalSystem system(compile(scene));
    std::vector<double> y = moving_state(system, 23);
    Random random(24);
    const int motion = system.model().layout.memory;
    for (int i = 0; i < motion; ++i) y[static_cast<std::size_t>(i)] += 1e-3 * random.number();
    const double before = constraint_residual(system.terms(), 0.0, y.data()).position;
    CHECK(before > 1e-4);
    system.take_residual_before_projection();
    CHECK(system.project(0.0, y.data(), false));
    CHECK(system.take_residual_before_projection() == doctest::Approx(before).epsilon(1e-12));
    const ConstraintResidual after = constraint_residual(system.terms(), 0.0, y.data());
    CHECK(after.position < 1e-12);
    CHECK(after.rate < 1e-12);
    const std::vector<double> closed = y;
    system.project(0.0, y.data(), false);
    double moved = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) moved = std::max(moved, std::abs(y[i] - closed[i]));
    CHECK(moved < 1e-12);
  }
}

TEST_CASE("projection is orthogonal in the mass metric: no admissible motion is disturbed") {
  MaximalSystem system(compile(slider_crank()));
  std::vector<double> y = moving_state(system, 25);
  const std::vector<double> start = y;
  Random random(26);
  for (int i = system.model().layout.velocity; i < system.model().layout.memory; ++i) {
    y[static_cast<std::size_t>(i)] += 0.1 * random.number();
  }
  const std::vector<double> off = y;
  system.project(0.0, y.data(), false);
  std::vector<double> rate(y.size());
  system.derivative(0.0, start.data(), rate.data());
  const DenseTerms k = dense_terms(system);
  const MatXd q = k.d.transpose().householderQr().householderQ();
  const MatXd admissible = q.rightCols(q.cols() - k.d.rows());
  CHECK((k.d * admissible).norm() < 1e-12);
  const VecXd correction = twists(system.model(), y) - twists(system.model(), off);
  CHECK(correction.norm() > 0.05);
  CHECK((admissible.transpose() * (k.mass * correction)).norm() < 1e-11);
}

TEST_CASE("Baumgarte stabilisation: D vdot = gamma - b^2 phi - 2 b (D v - nu)") {
  SceneDescription scene = slider_crank();
  scene.baumgarte = 5.0;
  MaximalSystem system(compile(scene));
  std::vector<double> y = moving_state(system, 27);
  Random random(28);
  for (int i = 0; i < system.model().layout.memory; ++i)
    y[static_cast<std::size_t>(i)] += 1e-2 * random.number();
  std::vector<double> rate(y.size());
  system.derivative(0.0, y.data(), rate.data());
  const DenseTerms k = dense_terms(system);
  const Model& m = system.model();
  VecXd phi(m.rows()), drift(m.rows());
  CHECK(rate_residual(system.terms(), y.data(), drift.data()) > 1e-3);
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    phi.segment(m.elements[e].row, m.elements[e].rows) =
        system.terms().blocks()[e].phi.head(m.elements[e].rows);
  }
  CHECK(phi.norm() > 1e-3);
  CHECK((k.d * k.acceleration - k.gamma + 25.0 * phi + 10.0 * drift).norm() < 1e-11 * (1.0 + k.gamma.norm()));
}

TEST_CASE("multipliers of redundant constraints are the shortest that give these accelerations") {
  MaximalSystem system(compile(parallelogram(3)));
  CHECK(system.model().redundant);
  const std::vector<double> y = moving_state(system, 29);
  std::vector<double> rate(y.size());
  system.derivative(0.0, y.data(), rate.data());
  const DenseTerms k = dense_terms(system);
  const VecXd needed = k.mass * k.acceleration - k.load;
  Eigen::CompleteOrthogonalDecomposition<MatXd> decomposition(k.d.transpose());
  decomposition.setThreshold(1e-9);
  CHECK(decomposition.rank() == system.model().assembly.rank);
  CHECK((decomposition.solve(needed) - k.lambda).norm() < 1e-9 * k.lambda.norm());
}

TEST_CASE("of many rows those that the others hold are left out") {
  MaximalSystem system(compile(parallelogram(16)));
  const Model& m = system.model();
  REQUIRE(system.solver().has_many_rows());
  CHECK(m.redundant);
  CHECK(std::ranges::count(m.left_out, 1) == m.rows() - m.assembly.rank);
  const std::vector<double> y = moving_state(system, 29);
  std::vector<double> rate(y.size());
  system.derivative(0.0, y.data(), rate.data());
  CHECK(system.solver().is_regular());
  const DenseTerms k = dense_terms(system);
  CHECK((k.d * k.acceleration - k.gamma).norm() < 1e-9 * (1.0 + k.gamma.norm()));
  CHECK((k.mass * k.acceleration - k.load - k.d.transpose() * k.lambda).norm() < 1e-9 * k.load.norm());
  Eigen::CompleteOrthogonalDecomposition<MatXd> decomposition(k.d.transpose());
  decomposition.setThreshold(1e-9);
  CHECK(decomposition.rank() == m.assembly.rank);
  system.shorten_multipliers();
  const VecXd shortest = decomposition.solve(k.mass * k.acceleration - k.load);
  CHECK((shortest - Eigen::Map<const VecXd>(system.multipliers().data(), m.rows())).norm() <
        1e-9 * shortest.norm());
  Eigen::FullPivLU<MatXd> transposed(k.d.transpose());
  transposed.setThreshold(1e-9);
  const MatXd null_space = transposed.kernel();
  for (const ElementModel& e : m.elements) {
    CHECK(e.unique_reaction == (null_space.middleRows(e.row, e.rows).norm() < 1e-6));
  }
}

TEST_CASE("rank is watched beside rows that are redundant from the start") {
  MaximalSystem system(compile(parallelogram(3)));
  const Model& m = system.model();
  std::vector<double> y = m.initial_state, rate(y.size());
  system.derivative(0.0, y.data(), rate.data());
  const Dependence found = system.take_dependence();
  CHECK(found.redundant == m.rows() - m.assembly.rank);
  CHECK(found.left_out == found.redundant);
  CHECK_FALSE(found.lost_rank());
  CHECK_FALSE(found.gained_rank());
  const ConstraintRank rank = system.rank(0.0, y.data(), found.redundant);
  CHECK(found.ratio == doctest::Approx(std::pow(rank.smallest_singular_value, -2)));
  CHECK(found.ratio < 1e5);
  CHECK(system.rank(0.0, y.data()).smallest_singular_value < 1e-7);
}

TEST_CASE("a body of next to no inertia far from its hinge does not make rows dependent") {
  for (const double inertia : {1.0, 1e-8, 1e-12, 1e-20}) {
    SceneDescription scene;
    scene.bodies.push_back(body_at("bob", 2.0, Vec3d(1.0, 0.0, 0.0)));
    scene.bodies.back().inertia = inertia * Mat3d::Identity();
    join(scene, "revolute", "pin", kGround, "bob", Vec3d::Zero(), axes_along(Vec3d::UnitY(), Vec3d::UnitX()));
    MaximalSystem system(compile(scene));
    CHECK_FALSE(system.model().redundant);
    std::vector<double> y = system.model().initial_state, rate(y.size());
    system.derivative(0.0, y.data(), rate.data());
    CHECK(system.take_dependence().left_out == 0);
    // A falling pendulum: m g L / (m L^2 + J).
    CHECK(system.accelerations()[0][4] ==
          doctest::Approx(2.0 * scene.gravity / (2.0 + inertia)).epsilon(1e-12));
  }
}

TEST_CASE("the stabilised index-2 residual vanishes at a consistent start and sees each equation") {
  MaximalSystem system(compile(floating()));
  GearGuptaLeimkuhler form(system);
  const std::vector<double> state = moving_state(system, 30);
  std::vector<double> y(form.size()), rate(form.size()), r(form.size());
  system.terms().set_curve_limit(1e9);
  std::vector<double> consistent = state;
  system.project(0.2, consistent.data(), false);
  form.expand(0.2, consistent.data(), y.data(), rate.data());
  form.residual(0.2, y.data(), rate.data(), r.data());
  const auto norm = [&] {
    return Eigen::Map<const VecXd>(r.data(), static_cast<Eigen::Index>(r.size())).norm();
  };
  CHECK(norm() < 1e-10);
  std::vector<double> back(state.size());
  form.contract(0.2, y.data(), back.data());
  CHECK(back == consistent);
  const std::size_t differential = consistent.size();
  for (std::size_t i = 0; i < form.size(); ++i) {
    CHECK(form.differential()[i] == (i < differential ? 1.0 : 0.0));
  }
  for (const std::size_t i : {std::size_t{0}, differential - 1, differential, form.size() - 1}) {
    CAPTURE(i);
    std::vector<double> wrong = y, wrong_rate = rate;
    (i < differential ? wrong_rate : wrong)[i] += 1e-3;
    form.residual(0.2, wrong.data(), wrong_rate.data(), r.data());
    CHECK(norm() > 1e-6);
  }
}

TEST_CASE("Euler angles at their singularity stop the evaluation and name the body") {
  SceneDescription scene;
  scene.orientation = Orientation::euler_xyz;
  scene.bodies.push_back(body_at("hull", 1.0, Vec3d::Zero()));
  MaximalSystem system(compile(scene));
  std::vector<double> y = system.model().initial_state, rate(y.size());
  y[4] = 0.5 * M_PI;
  CHECK_THROWS_WITH(system.derivative(1.5, y.data(), rate.data()), doctest::Contains("body 'hull'"));
  y[4] = 1.7;  // a long step lands behind it
  CHECK_THROWS_WITH(system.derivative(1.5, y.data(), rate.data()), doctest::Contains("body 'hull'"));
  y[4] = 1.5;
  CHECK_NOTHROW(system.derivative(1.5, y.data(), rate.data()));
}

}  // namespace seacrane::test
