#include <doctest/doctest.h>

#include "count_allocations.hpp"
#include "multibody_scenes.hpp"
#include "seacrane/dynamics/gear_gupta_leimkuhler.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/dynamics/recursive/tree_branches.hpp"
#include "seacrane/elements/joints/registry.hpp"
#include "seacrane/elements/loads/contact.hpp"
#include "seacrane/elements/loads/heave_compensator.hpp"
#include "seacrane/elements/loads/immersed_span.hpp"
#include "seacrane/elements/loads/line.hpp"
#include "seacrane/sea/sea_field.hpp"

namespace seacrane::test {
namespace {

/// Five-point differences with this step agree to 6e-11 of a row's largest entry, here.
constexpr double kStep = 3e-4;
constexpr double kTolerance = 1e-9;

MatXd exact(System& system, double t, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(y.size());
  MatXd out = MatXd::Constant(n, n, std::nan(""));
  REQUIRE(system.jacobian(t, y.data(), out.data()));
  return out;
}

MatXd by_differences(System& system, double t, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(y.size());
  MatXd out(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    out.col(j) = slope(
        [&](double step) {
          std::vector<double> there = y;
          there[static_cast<std::size_t>(j)] += step;
          VecXd rate(n);
          system.derivative(t, there.data(), rate.data());
          return rate;
        },
        kStep);
  }
  return out;
}

/// Largest difference of two matrices, by row over its largest entry; rows below `least` count as that.
double difference(const MatXd& a, const MatXd& b, double least = 1.0) {
  const VecXd size = b.cwiseAbs().rowwise().maxCoeff().cwiseMax(least);
  return ((a - b).cwiseAbs().array().colwise() / size.array()).maxCoeff();
}

/// The start with random velocities, or off the constraints: every state changed, quaternions of any length.
std::vector<double> state_of(MaximalSystem& system, bool on_constraints, std::uint64_t seed) {
  std::vector<double> y = moving_state(system, seed);
  Random random(seed + 1);
  const int from = on_constraints ? system.model().layout.memory : 0;
  for (std::size_t i = idx(from); i < y.size(); ++i) y[i] += 0.1 * random.number();
  return y;
}

void check_redundant(const SceneDescription& scene, std::uint64_t seed) {
  for (const bool on_constraints : {true, false}) {
    CAPTURE(on_constraints);
    MaximalSystem system(compile(scene, false));
    const std::vector<double> y = state_of(system, on_constraints, seed);
    start_histories(system, 0.65, y.data(), {});
    const MatXd found = exact(system, 0.7, y), expected = by_differences(system, 0.7, y);
    CHECK(difference(found, expected) < kTolerance);
  }
}

/// In tree coordinates: positions and speeds changed at random, so that loops and quaternions are off too.
void check_recursive(const SceneDescription& scene, std::uint64_t seed) {
  const auto terms = std::make_shared<Terms>(compile(scene, false));
  MaximalSystem maximal(terms);
  const std::vector<double> bodies = state_of(maximal, true, seed);
  start_histories(maximal, 0.65, bodies.data(), {});
  RecursiveSystem system(terms);
  std::vector<double> y(system.size());
  system.read_bodies(0.7, bodies.data(), y.data());
  Random random(seed + 2);
  for (double& value : y) value += 0.05 * random.number();
  const MatXd found = exact(system, 0.7, y), expected = by_differences(system, 0.7, y);
  CHECK(difference(found, expected) < kTolerance);
}

/// F_y + c F_y' of the residual form, at a state, multipliers and rates that solve nothing.
void check_residual(const SceneDescription& scene, std::uint64_t seed) {
  MaximalSystem bodies(compile(scene, false));
  GearGuptaLeimkuhler system(bodies);
  const std::vector<double> start = state_of(bodies, false, seed);
  start_histories(bodies, 0.65, start.data(), {});
  const auto n = static_cast<Eigen::Index>(system.size());
  std::vector<double> y(system.size()), ydot(system.size());
  system.expand(0.7, start.data(), y.data(), ydot.data());
  Random random(seed + 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    ydot[static_cast<std::size_t>(i)] += 0.1 * random.number();
    if (i >= bodies.model().layout.size) y[static_cast<std::size_t>(i)] += 0.1 * random.number();
  }
  const double c = 3.0;
  MatXd found(n, n), expected(n, n);
  REQUIRE(system.jacobian(0.7, c, y.data(), ydot.data(), found.data()));
  for (Eigen::Index j = 0; j < n; ++j) {
    expected.col(j) = slope(
        [&](double step) {
          std::vector<double> there = y, rate = ydot;
          there[static_cast<std::size_t>(j)] += step;
          rate[static_cast<std::size_t>(j)] += c * step;
          VecXd r(n);
          system.residual(0.7, there.data(), rate.data(), r.data());
          return r;
        },
        kStep);
  }
  CHECK(difference(found, expected) < kTolerance);
}

/// What a move along the velocities does to the positions.
void check_move(MaximalSystem& system, std::vector<double> y, double h) {
  const StateLayout& s = system.model().layout;
  MatXd found(s.velocity, s.size - s.velocity), expected = found;
  REQUIRE(system.positions().move_jacobian(h, y.data(), found.data()));
  for (int j = 0; j < found.cols(); ++j) {
    expected.col(j) = slope([&](double step) {
      std::vector<double> there = y;
      there[idx(s.velocity + j)] += step;
      system.positions().move(h, there.data());
      return VecXd(Eigen::Map<const VecXd>(there.data(), s.velocity));
    });
  }
  CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-10);
}

SceneDescription with_convolution() {
  SceneDescription scene = slider_crank("hull");
  make_vessel(scene, "hull");
  RetardationFunctions functions{0.1, {}};
  for (int i = 0; i <= 20; ++i) {
    functions.kernel.emplace_back((Mat6d::Identity() + Mat6d::Constant(0.2)) * 40.0 * std::exp(-0.2 * i));
  }
  scene.vessels.front().memory = functions;
  return scene;
}

}  // namespace

TEST_CASE("exact Jacobian: every kind of joint") {
  Random random(3);
  for_each_joint_type([&]<class Type>(std::size_t) {
    CAPTURE(std::string(Type::kind));
    const SceneDescription scene = pair(Type::kind, random);
    check_redundant(scene, 5);
    check_recursive(scene, 5);
    check_residual(scene, 5);
  });
}

TEST_CASE("exact Jacobian: every kind of load") {
  Random random(4);
  for (std::size_t kind = 0; kind < load_kinds().size(); ++kind) {
    CAPTURE(std::string(load_kinds()[kind]->name));
    SceneDescription scene = pair("revolute", random);
    scene.loads.lists[kind]->add_example();
    check_redundant(scene, 6);
    check_recursive(scene, 6);
    check_residual(scene, 6);
  }
}

TEST_CASE("exact Jacobian: water on a span in waves and current, wet, half wet and dry") {
  const WaveComponents waves({0.8, 1.1, 1.7}, {0.3, 0.2, 0.1}, {0.2, 2.0, 4.0}, {0.3, -0.8, 2.0}, 30.0,
                             standard_gravity, Current({0.0, 20.0}, {0.4, 0.1}, {0.1, 0.3}));
  for (const Stretching stretching : {Stretching::none, Stretching::wheeler}) {
    for (const double height : {-4.0, 0.0, 6.0}) {
      CAPTURE(height);
      Random random(4);
      SceneDescription scene = pair("revolute", random);
      for (BodyDescription& body : scene.bodies) body.position.z() += height;
      scene.loads.of<ImmersedSpan>().push_back(ImmersedSpan::example());
      scene.sea = std::make_shared<const SeaField>(waves, stretching);
      check_redundant(scene, 6);
      check_recursive(scene, 6);
      check_residual(scene, 6);
    }
  }
}

TEST_CASE("exact Jacobian: contact that slides and that sticks, on every surface") {
  const std::vector<std::pair<const char*, Vec3d>> surfaces = {{"plane", {0.0, 0.0, 0.0}},
                                                               {"box", {28.0, 28.0, 28.0}},
                                                               {"post", {0.0, 12.0, 14.0}},
                                                               {"pipe", {1.0, 16.0, 14.0}}};
  for (const auto& [surface, size] : surfaces) {
    for (const double friction : {0.05, 50.0}) {
      CAPTURE(std::string(surface));
      CAPTURE(friction);
      Random random(16);
      SceneDescription scene = pair("revolute", random);
      Contact::Description contact = Contact::example();
      contact.surface = surface;
      contact.size = size;
      contact.edge = contact.is("box") ? 13.9 : (contact.is("pipe") ? 3.4 : 5.4);
      if (size.isZero()) contact.place += 5.0 * contact.axes.col(2);
      contact.friction = friction;
      contact.compressions = {0.0, 1.0, 3.0};
      contact.forces = {0.0, 0.4, 1.8};
      scene.loads.of<Contact>().push_back(contact);
      check_redundant(scene, 6);
      check_recursive(scene, 6);
      check_residual(scene, 6);
    }
  }
}

TEST_CASE("exact Jacobian: more states of loads than directions at once") {
  Random random(14);
  SceneDescription scene = pair("revolute", random);
  for (int i = 0; i < 7; ++i) {
    Line::Description line = Line::example();
    line.name += std::to_string(i);
    line.points[0] += random.vector();
    scene.loads.of<Line>().push_back(line);
  }
  CHECK(compile(scene, false)->load_states.size() > idx(BodyResidual::kDirections));
  check_redundant(scene, 6);
  check_recursive(scene, 6);
  check_residual(scene, 6);
}

TEST_CASE("exact Jacobian: a winch and an actuator that follow heave compensators") {
  Random random(15);
  SceneDescription scene = pair("revolute", random);
  Line::Description line = Line::example();
  line.name = "hoist";
  scene.loads.of<Line>().push_back(line);
  scene.loads.of<Actuator>().push_back(Actuator::example());
  HeaveCompensator::Description heave = HeaveCompensator::example();
  heave.name = "on winch";
  heave.winch = "hoist";
  scene.loads.of<HeaveCompensator>().push_back(heave);
  heave.name = "on actuator";
  heave.winch = "";
  heave.actuator = "load";
  heave.body = "third";
  heave.ratio = -0.4;
  heave.lag = 0.0;
  heave.actuator_frequency = 0.0;
  scene.loads.of<HeaveCompensator>().push_back(heave);
  check_redundant(scene, 6);
  check_recursive(scene, 6);
  check_residual(scene, 6);
}

TEST_CASE("exact Jacobian: drivers on angles and displacements, Baumgarte, Euler angles") {
  Random random(5);
  for (const char* coordinate : {"angle", "displacement"}) {
    for (const Orientation orientation : {Orientation::quaternion, Orientation::euler_xyz}) {
      SceneDescription scene = pair("cylindrical", random);
      scene.orientation = orientation;
      for (BodyDescription& b : scene.bodies) b.quaternion = Vec4d(1.0, 0.1, 0.2, 0.3).normalized();
      scene.joints.clear();
      join(scene, "cylindrical", "joint", "first", "second", random.vector(), random.rotation());
      scene.drivers.push_back({"driver", {"joint", coordinate}, Curve::harmonic(0.0, 0.0, 0.2, 3.0, 0.0)});
      check_recursive(scene, 7);
      scene.baumgarte = 2.0;
      check_redundant(scene, 7);
      check_residual(scene, 7);
      MaximalSystem system(compile(scene, false));
      check_move(system, state_of(system, false, 7), 0.4);
    }
  }
}

TEST_CASE("exact Jacobian: a vessel with memory, waves at its mean, actual and slow position, drift, wind") {
  SceneDescription calm = slider_crank("hull");
  make_vessel(calm, "hull");
  for (const SceneDescription& scene :
       {calm, at_sea(false), at_sea(true), at_sea(true, 0.7), with_convolution()}) {
    check_redundant(scene, 8);
    check_recursive(scene, 8);
    check_residual(scene, 8);
  }
}

TEST_CASE("exact Jacobian: two hulls in one water, free and tied to each other") {
  check_redundant(two_hulls(), 8);
  check_recursive(two_hulls(), 8);
  check_residual(two_hulls(), 8);
  check_redundant(tied_hulls(), 8);
  check_residual(tied_hulls(), 8);
}

TEST_CASE("exact Jacobian of the recursive form: struts, and a loop that stays rows") {
  Random random(9);
  for (int trial = 0; trial < 4; ++trial) {
    CAPTURE(trial);
    check_recursive(strut_scene(random, trial % 2 == 0, trial < 2), 9);
  }
  check_recursive(slider_crank(), 9);
}

TEST_CASE("exact Jacobian of the recursive form: driven strokes and bodies, on the ground and afloat") {
  Random random(23);
  for (int trial = 0; trial < 4; ++trial) {
    CAPTURE(trial);
    SceneDescription scene = driven_strut_scene(random, trial % 2 == 0, trial < 2, trial != 1);
    check_recursive(scene, 9);
  }
}

TEST_CASE("kinematics of the tree on dual numbers are those of the run") {
  Random random(10);
  for (const SceneDescription& scene : {strut_scene(random, true, false), pair("distance", random)}) {
    MaximalSystem system(compile(scene, false));
    Terms& terms = system.terms();
    const BodyTree tree = build_tree(terms.model());
    const auto bodies = idx(terms.model().body_count());
    std::vector<double> q(idx(tree.positions)), u(idx(tree.speeds));
    TreeKinematics<double> run(tree, static_cast<int>(bodies));
    TreeKinematics<Dual<2>> dual(tree, static_cast<int>(bodies));
    terms.read(0.0, moving_state(system, 10).data());
    ArticulatedTree<double>(tree, static_cast<int>(bodies)).read(terms.bodies().data(), q.data(), u.data());
    std::vector<BodyKinematics<double>> a(bodies + 1, BodyKinematics<double>::ground());
    std::vector<BodyKinematics<Dual<2>>> b(bodies + 1, BodyKinematics<Dual<2>>::ground());
    const std::vector<Dual<2>> dual_q(q.begin(), q.end()), dual_u(u.begin(), u.end());
    run.place(q.data(), u.data(), a.data());
    dual.place(dual_q.data(), dual_u.data(), b.data());
    const auto apart = [](const auto& number, const auto& with_slopes) {
      double largest = 0.0;
      for (Eigen::Index i = 0; i < number.size(); ++i) {
        largest = std::max(largest, std::abs(number(i) - with_slopes(i).value));
      }
      return largest;
    };
    for (std::size_t i = 0; i < bodies; ++i) {
      CHECK(apart(a[i].position, b[i].position) < 1e-14);
      CHECK(apart(a[i].rotation, b[i].rotation) < 1e-14);
      CHECK(apart(a[i].velocity, b[i].velocity) < 1e-13);
      CHECK(apart(a[i].angular_velocity, b[i].angular_velocity) < 1e-13);
    }
  }
}

TEST_CASE("exact Jacobian: nothing is allocated after the first one") {
  for (const SceneDescription& scene :
       {slider_crank(), at_sea(true, 0.7), at_sea(false), two_hulls(), with_convolution()}) {
    const auto terms = std::make_shared<Terms>(compile(scene));
    MaximalSystem system(terms);
    RecursiveSystem tree(terms);
    GearGuptaLeimkuhler residual(system);
    const std::vector<double> y = moving_state(system, 9);
    std::vector<double> q(tree.size()), unknown(residual.size()), rate(residual.size());
    tree.read_bodies(0.0, y.data(), q.data());
    residual.expand(0.0, y.data(), unknown.data(), rate.data());
    std::vector<double> out(residual.size() * residual.size());
    const auto all = [&](double t) {
      REQUIRE(system.jacobian(t, y.data(), out.data()));
      REQUIRE(tree.jacobian(t, q.data(), out.data()));
      REQUIRE(residual.jacobian(t, 1.0, unknown.data(), rate.data(), out.data()));
      REQUIRE(system.positions().move_jacobian(0.1, y.data(), out.data()));
    };
    all(0.0);
    const long before = allocation_count();
    for (int i = 0; i < 20; ++i) all(0.001 * i);
    CHECK(allocation_count() == before);
  }
}

}  // namespace seacrane::test
