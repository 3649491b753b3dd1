#include <doctest/doctest.h>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/energy.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/elements/loads/line.hpp"

namespace seacrane::test {
namespace {

LineDescription quasi_static_line(const std::string& name) {
  LineDescription out = Line::example();
  out.name = name;
  out.rung = kQuasiStatic;
  const DrumDescription no_drum;
  static_cast<DrumDescription&>(out) = no_drum;
  out.strains = out.tensions = {};
  return out;
}

LineDescription commanded_line() {
  LineDescription out = quasi_static_line("commanded");
  out.points = {{1.0, 0.2, 1.0}, {0.5, 0.1, -0.3}, {0.2, -0.3, 1.0}};
  out.EA = 200.0;
  out.settling = 0.3;
  const WinchDescription no_winch;
  static_cast<WinchDescription&>(out) = no_winch;
  out.length =
      Curve::harmonic(0.0, 1.4, 0.3, 2.0, 0.4);  // shorter than the path in every scene: slack is a kink
  return out;
}

/// A scene with two lines of quasi-static stretch over the same bodies, one on a winch: they feel each other.
SceneDescription with_lines(SceneDescription scene) {
  scene.loads.of<Line>().push_back(quasi_static_line("on winch"));
  scene.loads.of<Line>().push_back(commanded_line());
  return scene;
}

/// Bodies that hang on one another by such lines, listed in an order of their own: each line feels a few
/// others.
SceneDescription chain(Random& random) {
  SceneDescription scene;
  scene.name = "chain";
  std::string above = kGround;
  std::vector<LineDescription> lines;
  for (int i = 0; i < 6; ++i) {
    BodyDescription link = random_body("link " + std::to_string(i), random);
    link.position = Vec3d(0.0, 0.0, -1.5 * (i + 1)) + 0.1 * random.vector();
    LineDescription line = commanded_line();
    line.name = "line " + std::to_string(i);
    line.bodies = {above, link.name};
    line.points = {Vec3d::Zero(), Vec3d::Zero()};
    line.sheaves = SheaveDescriptions();
    line.length = Curve::constant(1.0);
    lines.push_back(line);
    above = link.name;
    scene.bodies.push_back(link);
  }
  for (const std::size_t i : {1u, 0u, 2u, 3u, 5u, 4u}) scene.loads.of<Line>().push_back(lines[i]);
  return scene;
}

std::vector<SceneDescription> lined_scenes() {
  Random random(71);
  return {with_lines(pair("revolute", random)), with_lines(pair("spherical", random)),
          with_lines(pair("distance", random)), chain(random)};
}

std::vector<double> shaken(MaximalSystem& system) {
  std::vector<double> y = moving_state(system, 72);
  Random random(73);
  const StateLayout& s = system.model().layout;
  for (int i = s.loads; i < s.work; ++i) y[idx(i)] += 0.1 * random.number();
  return y;
}

MatXd differences_of(System& system, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(y.size());
  MatXd out(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    out.col(j) = slope(
        [&](double step) {
          std::vector<double> there = y;
          there[idx(static_cast<int>(j))] += step;
          VecXd rate(n);
          system.derivative(0.7, there.data(), rate.data());
          return rate;
        },
        3e-4);
  }
  return out;
}

void check_exact(System& system, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(y.size());
  MatXd found(n, n);
  REQUIRE(system.jacobian(0.7, y.data(), found.data()));
  const MatXd expected = differences_of(system, y);
  const VecXd size = expected.cwiseAbs().rowwise().maxCoeff().cwiseMax(1.0);
  CHECK(((found - expected).cwiseAbs().array().colwise() / size.array()).maxCoeff() < 1e-8);
}

}  // namespace

TEST_CASE("a quasi-static line pulls EA (e + s (e' - w) + s^2 e'') + c l0 e', whatever its bodies do") {
  for (const SceneDescription& scene : lined_scenes()) {
    MaximalSystem system(compile(scene, false));
    const std::vector<double> y = shaken(system);
    std::vector<double> rate(y.size());
    const StateLayout& s = system.model().layout;
    for (const Line& one : system.model().loads.of<Line>()) {
      CAPTURE(one.d.name);
      // l0 and its rates by differences along the motion, and the strain's likewise.
      const auto motion_at = [&](double t) {
        std::vector<double> there = y;
        system.derivative(0.7, y.data(), rate.data());
        for (std::size_t i = 0; i < y.size(); ++i) there[i] += t * rate[i];
        system.derivative(0.7 + t, there.data(), rate.data());
        return one.motion(system.terms().load_input(0.7 + t, there.data() + s.memory));
      };
      const auto now = motion_at(0.0);
      const double s1 = one.d.settling, w = y[idx(s.loads + one.settled)];
      const double viscous = one.viscous * std::sqrt(now.unstretched);
      const double strain = now.stretch() / now.unstretched, strain_rate = now.straining() / now.unstretched;
      const double bend = slope(
          [&](double t) {
            const auto then = motion_at(t);
            return then.straining() / then.unstretched;
          },
          1e-4);
      const double expected =
          one.d.EA * (strain + s1 * (strain_rate - w) + s1 * s1 * bend) + viscous * strain_rate;
      CHECK(now.tension == doctest::Approx(expected).epsilon(1e-8));
    }
  }
}

TEST_CASE("energy changes by the recorded power: inertial tensions") {
  for (const SceneDescription& scene : lined_scenes()) {
    MaximalSystem system(compile(scene, false));
    const std::vector<double> y = shaken(system);
    std::vector<double> rate(y.size());
    system.derivative(0.7, y.data(), rate.data());
    const double power = rate[idx(system.model().layout.work)];
    const double energy_rate = slope(
        [&](double t) {
          std::vector<double> there = y;
          for (std::size_t i = 0; i < y.size(); ++i) there[i] += t * rate[i];
          return mechanical_energy_at(system.terms(), 0.7 + t, there.data());
        },
        1e-4);
    CHECK(energy_rate == doctest::Approx(power).epsilon(1e-8));
  }
}

TEST_CASE("both formulations find the same inertial tensions, with exact Jacobians") {
  for (const SceneDescription& scene : lined_scenes()) {
    const auto terms = std::make_shared<Terms>(compile(scene, false));
    MaximalSystem maximal(terms);
    RecursiveSystem recursive(terms);
    std::vector<double> y = shaken(maximal), q(recursive.size());
    maximal.project(0.7, y.data(), false);
    recursive.read_bodies(0.7, y.data(), q.data());
    std::vector<double> rate(y.size()), tree_rate(q.size());
    maximal.derivative(0.7, y.data(), rate.data());
    const std::vector<Vec6d> expected = maximal.accelerations();
    recursive.derivative(0.7, q.data(), tree_rate.data());
    for (std::size_t b = 0; b < expected.size(); ++b) {
      CHECK((recursive.accelerations()[b] - expected[b]).norm() < 1e-9 * (1.0 + expected[b].norm()));
    }
    CHECK(tree_rate[tree_rate.size() - 2] == doctest::Approx(rate[rate.size() - 2]).epsilon(1e-9));
    check_exact(maximal, y);
    check_exact(recursive, q);
  }
}

TEST_CASE("a quasi-static stretch is refused where it cannot be") {
  const auto message = [](const LineDescription& line) -> std::string {
    Random random(71);
    SceneDescription scene = pair("revolute", random);
    scene.loads.of<Line>().push_back(line);
    try {
      compile(scene);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  LineDescription bad = commanded_line();
  CHECK(message(bad).empty());
  bad.rung = "stiff";
  CHECK(message(bad).find("rung 'stiff' is unknown; choose 'elastic' or 'quasi-static'") !=
        std::string::npos);
  bad = commanded_line();
  bad.settling = 0.0;
  CHECK(message(bad).find("settling is 0 s; it must be positive") != std::string::npos);
  bad = commanded_line();
  bad.length = Curve::constant(2.0).then(1.0, Curve::constant(2.1));
  CHECK(message(bad).find("jumps at t = 1 s, or its rate; smooth it") != std::string::npos);
  bad = quasi_static_line("on winch");
  bad.lag = 0.0;
  bad.maximum_acceleration = kFarthest;
  CHECK(message(bad).find("its winch has no lag; give one") != std::string::npos);
}

}  // namespace seacrane::test
