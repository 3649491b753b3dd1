#include <doctest/doctest.h>

#include "count_allocations.hpp"
#include "multibody_scenes.hpp"
#include "seacrane/dynamics/redundant.hpp"

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
std::vector<double> state_of(RedundantSystem& system, bool on_constraints, std::uint64_t seed) {
  std::vector<double> y = moving_state(system, seed);
  Random random(seed + 1);
  const int from = on_constraints ? system.model().layout.memory : 0;
  for (std::size_t i = idx(from); i < y.size(); ++i) y[i] += 0.1 * random.number();
  return y;
}

void check_redundant(const SceneDescription& scene, std::uint64_t seed) {
  for (const bool on_constraints : {true, false}) {
    CAPTURE(on_constraints);
    RedundantSystem system(compile(scene, false));
    const std::vector<double> y = state_of(system, on_constraints, seed);
    const MatXd found = exact(system, 0.7, y), expected = by_differences(system, 0.7, y);
    CHECK(difference(found, expected) < kTolerance);
  }
}

BodyDescription random_body(const std::string& name, Random& random) {
  BodyDescription b;
  b.name = name;
  b.mass = 2.0 + random.positive();
  b.inertia = random.inertia();
  b.center_of_mass = 0.2 * random.vector();
  b.position = random.vector();
  b.quaternion = quaternion_from_rotation(random.rotation());
  return b;
}

/// Two bodies on a joint of one kind, the first free in space.
SceneDescription pair(const std::string& kind, Random& random) {
  SceneDescription scene;
  scene.name = kind;
  for (const char* name : {"first", "second"}) scene.bodies.push_back(random_body(name, random));
  JointDescription& joint = join(scene, kind, "joint", "first", "second", random.vector(), random.rotation());
  if (kind == "universal") {
    const Mat3d axes = joint.first_frame.axes;
    const Mat3d r = rotation_from_quaternion<double>(scene.bodies[0].quaternion) * axes;
    joint.second_frame = frame_on(scene, "second", Vec3d::Zero(), axes_along(r.col(0), r.col(2)));
    joint.second_frame.point.setZero();
    joint.first_frame = frame_on(scene, "first", scene.bodies[1].position, r);  // at the second body's origin
  }
  if (kind == "distance") {
    joint.second_frame.point = Vec3d(0.4, 0.3, -0.5);
    joint.length = joint.second_frame.point.norm();
    joint.second_frame.point += frame_on(scene, "second", scene.bodies[1].position, Mat3d::Identity()).point;
    joint.first_frame = frame_on(scene, "first", scene.bodies[1].position, Mat3d::Identity());
  }
  return scene;
}

template <class Load>
typename Load::Description example();

/// Its power stays off zero, where differences of the absolute power straddle a kink.
template <>
ActuatorDescription example<Actuator>() {
  return {"load", {"joint", "angle"}, 20.0, 3.0, Curve::constant(9.0), Curve::quintic(0.0, 2.0, 0.0, 1.0)};
}
template <>
PointForceDescription example<PointForce>() {
  return {"load", "first", Vec3d(0.1, 0.2, 0.3), Vec3d(1.0, -2.0, 3.0), true};
}
template <>
SpringDescription example<SpringDamper>() {
  SpringDescription d;
  d.name = "load";
  d.first = "first";
  d.second = "second";
  d.first_point = {2.0, 0.5, -1.0};
  d.stiffness = 30.0;
  d.damping = 0.5;
  d.natural_length = 0.8;
  return d;
}
template <>
ForceTableDescription example<ForceTable>() {
  return {"load",
          "second",
          Vec3d(0.1, 0.2, 0.3),
          {0.0, 1.0},
          {Vec6d::Zero(), (Vec6d() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0).finished()}};
}
template <>
FunctionForceDescription example<FunctionForce>() {
  const ForceFunction pull = [](double, const double* state, const double* parameters, double* wrench) {
    for (int i = 0; i < 3; ++i) {
      wrench[i] = -std::pow(state[i], 3) - parameters[0] * state[7 + i];
      wrench[3 + i] = state[4 + i] - 0.3 * state[10 + i];
    }
  };
  return {"load", "second", pull, {0.7}};
}
template <>
FlowForceDescription example<FlowForce>() {
  FlowForceDescription d;
  d.name = "load";
  d.body = "first";
  d.point = {0.0, 0.1, 0.4};
  d.density = 1.2;
  d.speed = Curve::constant(5.0);
  d.frontal_area = d.lateral_area = d.length = 1.3;
  d.angles = {0.0, 1.5, 3.0, 4.5, 5.5};
  d.coefficients = {{0.9, 0.0, 0.1}, {0.1, 0.8, 0.2}, {-0.8, 0.1, 0.0}, {0.0, -0.9, -0.2}, {0.6, -0.5, 0.1}};
  return d;
}

}  // namespace

TEST_CASE("exact Jacobian: every kind of joint") {
  Random random(3);
  for_each_joint_type([&]<class Type>(std::size_t) {
    CAPTURE(std::string(Type::kind));
    const SceneDescription scene = pair(Type::kind, random);
    check_redundant(scene, 5);
  });
}

TEST_CASE("exact Jacobian: every kind of load") {
  Random random(4);
  for_each_load_type([&]<class Load>() {
    CAPTURE(std::string(Load::kind));
    SceneDescription scene = pair("revolute", random);
    scene.loads_of<Load>().push_back(example<Load>());
    check_redundant(scene, 6);
  });
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
      scene.baumgarte = 2.0;
      check_redundant(scene, 7);
    }
  }
}

TEST_CASE("exact Jacobian: a vessel with memory, waves at the mean and at the actual position, drift, wind") {
  SceneDescription calm = slider_crank("hull");
  make_vessel(calm, "hull");
  for (const SceneDescription& scene : {calm, at_sea(false), at_sea(true)}) {
    check_redundant(scene, 8);
  }
}

TEST_CASE("exact Jacobian: nothing is allocated after the first one") {
  for (const SceneDescription& scene : {slider_crank(), at_sea(true), at_sea(false)}) {
    RedundantSystem system(compile(scene));
    const std::vector<double> y = moving_state(system, 9);
    std::vector<double> out(y.size() * y.size());
    REQUIRE(system.jacobian(0.0, y.data(), out.data()));
    const long before = allocation_count();
    for (int i = 0; i < 20; ++i) REQUIRE(system.jacobian(0.001 * i, y.data(), out.data()));
    CHECK(allocation_count() == before);
  }
}

}  // namespace seacrane::test
