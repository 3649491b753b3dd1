#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "seacrane/compile/compile.hpp"
#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"
#include "seacrane/elements/loads/actuator.hpp"
#include "seacrane/elements/loads/flow_force.hpp"
#include "seacrane/elements/loads/spring_damper.hpp"
#include "seacrane/math/random.hpp"
#include "seacrane/math/rotation.hpp"

namespace seacrane::test {

class Random : public seacrane::Random {
 public:
  using seacrane::Random::Random;
  /// The inertia of three masses on the axes, so that a body of this inertia exists.
  Mat3d inertia() {
    const double a = positive(), b = positive(), c = positive();
    const Mat3d r = rotation();
    return r * Vec3d(b + c, a + c, a + b).asDiagonal() * r.transpose();
  }
  BodyKinematics<double> kinematics() { return {vector(), rotation(), vector(), vector()}; }
};

/// Rotation by the vector `angle`, inertial axes.
inline Mat3d rotation_by(const Vec3d& angle) {
  return angle.norm() > 0.0 ? Mat3d(Eigen::AngleAxisd(angle.norm(), angle.normalized())) : Mat3d::Identity();
}

inline Vec6d twist(const BodyKinematics<double>& k) {
  return (Vec6d() << k.velocity, k.angular_velocity).finished();
}

/// Five-point differences with h = 1e-3 of functions of size 1 to 10 whose fifth derivatives are below 1e3:
/// truncation below 1e3 h^4 / 30 = 3e-11, rounding about 1e-15 / h = 1e-12.
inline constexpr double kDifference = 1e-9;

/// Derivative by five points: error h^4 / 30 of the fifth derivative.
template <class F>
auto slope(F&& f, double h = 1e-3) {
  using Value = decltype(f(h));
  const Value near = f(h) - f(-h), far = f(2.0 * h) - f(-2.0 * h);
  return Value((8.0 * near - far) / (12.0 * h));
}

/// Where a body is after a time at constant twist.
inline BodyKinematics<double> moved(const BodyKinematics<double>& k, double t) {
  return {k.position + t * k.velocity, rotation_by(t * k.angular_velocity) * k.rotation, k.velocity,
          k.angular_velocity};
}

/// Right-handed axes with z along `z` and x across it.
inline Mat3d axes_along(const Vec3d& z, const Vec3d& near_x) {
  Mat3d axes;
  axes.col(2) = z.normalized();
  axes.col(1) = z.cross(near_x).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

inline BodyDescription body_at(const std::string& name, double mass, const Vec3d& position) {
  BodyDescription b;
  b.name = name;
  b.mass = mass;
  b.inertia = mass * Vec3d(0.02, 0.03, 0.04).asDiagonal();
  b.position = position;
  return b;
}

/// Frame on a body (default: the ground) from a point and axes in the inertial frame.
inline Frame frame_on(const SceneDescription& scene, const std::string& name, const Vec3d& point,
                      const Mat3d& axes) {
  for (const auto& b : scene.bodies) {
    if (b.name != name) continue;
    const Mat3d r = rotation_from_quaternion<double>(b.quaternion);
    return {r.transpose() * (point - b.position), r.transpose() * axes};
  }
  return {point, axes};
}

inline JointDescription& join(SceneDescription& scene, const std::string& kind, const std::string& name,
                              const std::string& first, const std::string& second, const Vec3d& point,
                              const Mat3d& axes = Mat3d::Identity()) {
  scene.joints.push_back(
      {name, kind, first, second, frame_on(scene, first, point, axes), frame_on(scene, second, point, axes)});
  return scene.joints.back();
}

/// A closed joint of any kind between two bodies, the kind's example in the inertial frame.
inline JointDescription& join_example(SceneDescription& scene, const std::string& kind,
                                      const std::string& name, const std::string& first,
                                      const std::string& second, Random& random) {
  JointDescription j = find_joint_kind(kind)->example(random);
  j.name = name;
  j.first = first;
  j.second = second;
  j.first_frame = frame_on(scene, first, j.first_frame.point, j.first_frame.axes);
  j.second_frame = frame_on(scene, second, j.second_frame.point, j.second_frame.axes);
  scene.joints.push_back(j);
  return scene.joints.back();
}

/// A spatial slider-crank (one degree of freedom), an arm driven on its slider and a pendulum on a link:
/// a loop, an actuator, a spring-damper and a driver. `base` carries it.
inline SceneDescription slider_crank(const std::string& base = kGround) {
  SceneDescription scene;
  scene.name = "slider-crank";
  const Vec3d pivot(0.0, 0.3, 0.2), pin(0.0, 0.8, 0.2);
  const double rod = 1.5;
  const Vec3d end(std::sqrt(rod * rod - pin.squaredNorm()), 0.0, 0.0), tip = end + Vec3d(0.0, 0.0, -0.5);
  if (base != kGround) scene.bodies.push_back(body_at(base, 50.0, Vec3d::Zero()));
  scene.bodies.push_back(body_at("crank", 2.0, 0.5 * (pivot + pin)));
  scene.bodies.push_back(body_at("rod", 1.0, 0.5 * (pin + end)));
  scene.bodies.push_back(body_at("slider", 3.0, end));
  scene.bodies.push_back(body_at("arm", 0.7, 0.5 * (end + tip)));
  scene.bodies.push_back(body_at("load", 1.2, tip + Vec3d(0.3, 0.0, -0.4)));
  const Mat3d along_x = axes_along(Vec3d::UnitX(), Vec3d::UnitY()),
              along_y = axes_along(Vec3d::UnitY(), Vec3d::UnitX());
  join(scene, "revolute", "bearing", base, "crank", pivot, along_x);
  join(scene, "spherical", "pin", "crank", "rod", pin);
  JointDescription& knee = join(scene, "universal", "knee", "slider", "rod", end, along_y);
  knee.second_frame = frame_on(scene, "rod", end, axes_along(Vec3d::UnitY().cross(end - pin), end - pin));
  join(scene, "prismatic", "guide", base, "slider", end, along_x);
  join(scene, "revolute", "shoulder", "slider", "arm", end, along_y);
  JointDescription& link = join(scene, "distance", "link", "arm", "load", tip);
  link.second_frame = frame_on(scene, "load", tip + Vec3d(0.3, 0.0, -0.4), Mat3d::Identity());
  link.parameters["length"] = 0.5;
  scene.loads.of<Actuator>().push_back(
      {"drive", {"bearing", "angle"}, 20.0, 3.0, Curve::constant(1.0), Curve::quintic(0.0, 2.0, 0.0, 1.0)});
  scene.drivers.push_back({"swing", {"shoulder", "angle"}, Curve::harmonic(0.0, -0.2, 0.2, 3.0, 0.0)});
  SpringDescription spring;
  spring.name = "spring";
  spring.first = base;
  spring.second = "load";
  spring.first_point = {2.0, 0.5, -1.0};
  spring.stiffness = 30.0;
  spring.damping = 0.5;
  spring.natural_length = 0.8;
  scene.loads.of<SpringDamper>().push_back(spring);
  scene.coordinates = {{"bearing", "angle"}, {"guide", "displacement"}};
  return scene;
}

/// A body, an arm hinged to it and a strut between them, all axes and points askew; a load on the arm.
inline SceneDescription strut_scene(Random& random, bool universal_at_base, bool swapped) {
  SceneDescription scene;
  for (const char* name : {"base", "arm", "barrel", "rod", "load"}) {
    scene.bodies.push_back(body_at(name, random.positive(), random.vector()));
    scene.bodies.back().inertia = scene.bodies.back().mass * random.inertia();
  }
  const auto add = [&](const std::string& kind, const std::string& a, const std::string& b, const Vec3d& at,
                       const Mat3d& axes) -> JointDescription& {
    return swapped ? join(scene, kind, a + "-" + b, b, a, at, axes)
                   : join(scene, kind, a + "-" + b, a, b, at, axes);
  };
  const Vec3d lower(1.0, 0.2, -1.0), upper = Vec3d(1.2, -0.1, 0.9) + 0.2 * random.vector();
  add("revolute", "base", "arm", 0.3 * random.vector(), random.rotation());
  const Mat3d along = axes_along(upper - lower + 0.3 * random.vector(), random.vector());
  add("prismatic", "barrel", "rod", 0.5 * (lower + upper) + 0.2 * random.vector(), along);
  JointDescription& cross =
      add("universal", universal_at_base ? "base" : "arm", universal_at_base ? "barrel" : "rod",
          universal_at_base ? lower : upper, random.rotation());
  cross.second_frame.axes = cross.second_frame.axes * rotation_by(Vec3d(0.5 * M_PI, 0.0, 0.0));
  add("spherical", universal_at_base ? "arm" : "base", universal_at_base ? "rod" : "barrel",
      universal_at_base ? upper : lower, Mat3d::Identity());
  JointDescription& link = add("distance", "arm", "load", upper, Mat3d::Identity());
  link.second_frame.point += Vec3d(0.0, 0.48, 0.64);
  link.parameters["length"] = 0.8;
  return scene;
}

/// The strut scene with its stroke driven, and its base too where that is asked for.
inline SceneDescription driven_strut_scene(Random& random, bool universal_at_base, bool swapped, bool base) {
  SceneDescription scene = strut_scene(random, universal_at_base, swapped);
  const auto swing = [](double amplitude, double omega) {
    return Curve::harmonic(0.0, 0.0, amplitude, omega, -0.5 * M_PI);
  };
  scene.drivers.push_back({"stroke", {"barrel-rod", "displacement"}, swing(0.05, 2.0)});
  if (!base) return scene;
  join(scene, "free", "motion", kGround, "base", random.vector(), random.rotation());
  double omega = 1.0;
  for (const char* motion : {"x", "y", "z", "roll", "pitch", "yaw"}) {
    scene.drivers.push_back({motion, {"motion", motion}, swing(0.3, omega)});
    omega += 0.2;
  }
  return scene;
}

/// Planar four-bar of two equal cranks and a coupler as long as the ground, in the x-z plane; with
/// `count` cranks. Its out-of-plane constraints are redundant, and so is each crank after the second.
inline SceneDescription parallelogram(int count) {
  SceneDescription scene;
  scene.name = "parallelogram";
  const Mat3d along_y = axes_along(Vec3d::UnitY(), Vec3d::UnitX());
  const Vec3d up(0.3, 0.0, 0.8);
  scene.bodies.push_back(body_at("coupler", 2.0, Vec3d(1.0, 0.0, 0.0) + up));
  for (int i = 0; i < count; ++i) {
    const std::string n = std::to_string(i);
    const Vec3d foot(2.0 * i / (count - 1), 0.0, 0.0);
    scene.bodies.push_back(body_at("crank " + n, 1.0, foot + 0.5 * up));
    join(scene, "revolute", "foot " + n, kGround, "crank " + n, foot, along_y);
    join(scene, "revolute", "head " + n, "crank " + n, "coupler", foot + up, along_y);
  }
  return scene;
}

inline BodyDescription random_body(const std::string& name, Random& random) {
  BodyDescription b;
  b.name = name;
  b.mass = 2.0 + random.positive();
  b.inertia = random.inertia();
  b.center_of_mass = 0.2 * random.vector();
  b.position = random.vector();
  b.quaternion = quaternion_from_rotation(random.rotation());
  return b;
}

/// Two bodies on the example of a joint kind, the first free in space, and a third beside them.
inline SceneDescription pair(const std::string& kind, Random& random) {
  SceneDescription scene;
  scene.name = kind;
  for (const char* name : {"first", "second", "third"}) scene.bodies.push_back(random_body(name, random));
  scene.bodies[1].position = scene.bodies[0].position;
  scene.bodies[1].quaternion = scene.bodies[0].quaternion;
  scene.joints.push_back(find_joint_kind(kind)->example(random));
  return scene;
}

/// Makes `body` of a scene a vessel: added mass, damping, restoring, mooring, two memory states, waves.
inline void make_vessel(SceneDescription& scene, const std::string& body) {
  VesselDescription v;
  v.name = body;
  v.body = body;
  v.added_mass = 20.0 * Mat6d::Identity();
  v.added_mass(1, 3) = v.added_mass(3, 1) = 2.0;
  v.linear_damping = 5.0 * Mat6d::Identity();
  v.quadratic_damping = Vec6d::Constant(2.0);
  v.restoring(2, 2) = 900.0;
  v.restoring(3, 3) = v.restoring(4, 4) = 700.0;
  v.mooring_stiffness = v.mooring_damping = Vec3d::Constant(10.0);
  StateSpaceBlock memory;
  memory.inputs = memory.outputs = {2};
  memory.a = (MatXd(2, 2) << 0.0, 1.0, -4.0, -1.5).finished();
  memory.b = (MatXd(2, 1) << 1.0, 0.5).finished();
  memory.c = (MatXd(1, 2) << 3.0, 6.0).finished();
  memory.d = MatXd::Zero(1, 1);
  v.memory = std::vector<StateSpaceBlock>{memory};
  scene.vessels.push_back(v);
  const std::vector<double> omega = {0.7, 1.1, 1.6}, amplitude = {0.1, 0.2, 0.1}, phase = {0.1, 1.0, 2.0};
  Eigen::MatrixXcd transfer(3, 6);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 6; ++j) transfer(i, j) = {30.0 + 5.0 * j, 10.0 * i - 7.0 * j};
  }
  const auto exact = std::make_shared<const ExactWaveLoad>(
      WaveComponents(omega, amplitude, phase, {0.3, 0.3, 0.3}), transfer);
  scene.wave_loads.push_back(
      {"waves", body, exact, std::make_shared<const WaveTable>(exact), nullptr, nullptr, nullptr});
}

/// Makes the vessels of a scene a group: masses between them, and one passive memory of all motions in place
/// of their own.
inline void make_group(SceneDescription& scene, std::uint64_t seed) {
  Random random(seed);
  HydroGroupDescription group;
  group.name = "group";
  for (VesselDescription& v : scene.vessels) {
    group.vessels.push_back(v.name);
    v.memory = std::vector<StateSpaceBlock>{};
  }
  const auto n = static_cast<Eigen::Index>(6 * group.vessels.size());
  const auto fill = [&](Eigen::Index rows, Eigen::Index columns) {
    MatXd out(rows, columns);
    for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = random.number();
    return out;
  };
  const MatXd some = fill(n, n);
  group.added_mass = some + some.transpose();
  for (Eigen::Index i = 0; i < n; i += 6) group.added_mass.block<6, 6>(i, i).setZero();
  for (const double omega : {1.0, 2.0}) {
    StateSpaceBlock memory;
    for (int i = 0; i < static_cast<int>(n); ++i) {
      memory.inputs.push_back(i);
      memory.outputs.push_back(i);
    }
    memory.a = (MatXd(2, 2) << -0.4, omega, -omega, -0.4).finished();
    memory.b = fill(2, n);
    memory.c = memory.b.transpose();
    memory.d = MatXd::Zero(n, n);
    group.memory.push_back(memory);
  }
  scene.groups = {group};
}

/// A slider-crank on a hull, and a barge beside it at another heading, with a spring between them.
inline SceneDescription two_hulls(bool grouped = true) {
  SceneDescription scene = slider_crank("hull");
  make_vessel(scene, "hull");
  scene.bodies.push_back(body_at("barge", 40.0, {0.5, 4.0, 0.1}));
  scene.bodies.back().quaternion = {std::cos(0.2), 0.0, 0.0, std::sin(0.2)};
  scene.bodies.back().center_of_mass = {0.1, -0.05, 0.2};
  make_vessel(scene, "barge");
  scene.wave_loads.back().name = "waves on the barge";
  SpringDescription line;
  line.name = "line";
  line.first = "hull";
  line.second = "barge";
  line.stiffness = 20.0;
  line.damping = 1.0;
  line.natural_length = 3.0;
  scene.loads.of<SpringDamper>().push_back(line);
  if (grouped) make_group(scene, 3);
  return scene;
}

/// The same with a joint between the hulls.
inline SceneDescription tied_hulls() {
  SceneDescription scene = two_hulls();
  join(scene, "spherical", "tie", "barge", "hull", {0.2, 2.0, 0.3});
  return scene;
}

/// A slider-crank on a vessel in wind, and slow drift from its table or, with the first-order loads, at the
/// actual position, or below a cut-off frequency at the slow one.
inline SceneDescription at_sea(bool actual, double cutoff = 0.0) {
  SceneDescription scene = slider_crank("hull");
  make_vessel(scene, "hull");
  WaveLoadDescription& waves = scene.wave_loads.front();
  const std::vector<double> headings = {0.0, 0.7, 1.4, 2.1, 2.8, 3.5, 4.2, 4.9, 5.6};
  const std::vector<double> values(headings.size() * 3 * 12, 2.0);
  if (actual) {
    waves.positioned = std::make_shared<const PositionedWaveLoad>(
        waves.exact->waves(), ForceByHeading("force", headings, 3, values.data()),
        DriftByHeading("drift", headings, 3, values.data()), cutoff);
  } else {
    waves.drift = std::make_shared<const DriftLoad>(waves.exact->waves(), MatXd::Constant(3, 6, 2.0));
    waves.drift_table = std::make_shared<const DriftTable>(waves.drift);
  }
  FlowForceDescription wind;
  wind.name = "wind";
  wind.body = "hull";
  wind.density = 1.2;
  wind.speed = Curve::harmonic(0.0, 8.0, 2.0, 0.5, 0.0);
  wind.frontal_area = wind.lateral_area = wind.length = 1.0;
  wind.angles = {0.0, 1.5, 3.0, 4.5, 5.5};
  wind.coefficients.assign(5, Vec3d(0.2, 0.3, 0.1));
  scene.loads.of<FlowForce>().push_back(wind);
  return scene;
}

/// Dense D, gamma, mass and load of the last evaluation of a system: eq (9).
struct DenseTerms {
  MatXd mass, d;
  VecXd load, gamma, acceleration, lambda;
};

inline DenseTerms dense_terms(const MaximalSystem& system) {
  const Model& m = system.model();
  const int n = 6 * m.body_count(), rows = m.rows();
  DenseTerms out{MatXd::Zero(n, n), MatXd::Zero(rows, n), VecXd(n), VecXd(rows), VecXd(n), VecXd(rows)};
  for (int b = 0; b < m.body_count(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    out.mass.block<6, 6>(6 * b, 6 * b) = system.terms().mass_matrix(b);
    out.load.segment<6>(6 * b) = system.terms().loads()[i];
    out.acceleration.segment<6>(6 * b) = system.accelerations()[i];
  }
  for (const MassCoupling& c : system.terms().couplings()) {
    out.mass.block<6, 6>(6 * c.first, 6 * c.second) = c.mass;
    out.mass.block<6, 6>(6 * c.second, 6 * c.first) = c.mass.transpose();
  }
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& el = m.elements[e];
    const RowBlock<double>& block = system.terms().blocks()[e];
    if (el.first < m.body_count())
      out.d.block(el.row, 6 * el.first, el.rows, 6) += block.d[0].topRows(el.rows);
    if (el.second < m.body_count()) {
      out.d.block(el.row, 6 * el.second, el.rows, 6) += block.d[1].topRows(el.rows);
    }
    out.gamma.segment(el.row, el.rows) = block.gamma.head(el.rows);
  }
  for (int i = 0; i < rows; ++i) out.lambda[i] = system.multipliers()[static_cast<std::size_t>(i)];
  return out;
}

/// The assembled start with random velocities that satisfy the constraints.
inline std::vector<double> moving_state(MaximalSystem& system, std::uint64_t seed) {
  std::vector<double> y = system.model().initial_state;
  Random random(seed);
  for (int b = 0; b < system.model().body_count(); ++b) {
    double* v = y.data() + system.model().layout.twist(b);
    for (int i = 0; i < 6; ++i) v[i] += random.number();
  }
  system.project(0.0, y.data(), false);
  return y;
}

}  // namespace seacrane::test
