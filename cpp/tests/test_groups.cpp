#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/energy.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/dynamics/state_names.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/math/spd_blocks.hpp"

namespace seacrane::test {
namespace {

/// At random velocities and memory states.
std::vector<double> disturbed(MaximalSystem& system) {
  std::vector<double> y = moving_state(system, 41);
  Random random(42);
  const StateLayout& s = system.model().layout;
  for (int i = s.memory; i < s.work; ++i) y[idx(i)] += 0.1 * random.number();
  return y;
}

std::string refusal_of_group(const SceneDescription& scene) {
  try {
    compile(scene, false);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

bool names(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

}  // namespace

TEST_CASE("a matrix of blocks: its factors solve, and its inverse is the dense one") {
  Random random(40);
  for (const int count : {1, 2, 4}) {
    const Eigen::Index n = 6 * count;
    MatXd root(n, n);
    for (Eigen::Index i = 0; i < root.size(); ++i) root(i) = random.number();
    const MatXd a = root * root.transpose() + MatXd::Identity(n, n), inverse = a.inverse();
    SpdBlocks<double> blocks(count);
    std::vector<Vec6d> x(idx(count));
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j <= i; ++j) blocks.set(i, j, a.block<6, 6>(6 * i, 6 * j));
      x[idx(i)] = Vec6d::LinSpaced(1.0 + i, 2.0);
    }
    VecXd right(n);
    for (int i = 0; i < count; ++i) right.segment<6>(6 * i) = x[idx(i)];
    blocks.factor();
    blocks.solve(x.data());
    blocks.invert();
    const VecXd solved = inverse * right;
    for (int i = 0; i < count; ++i) {
      CHECK((x[idx(i)] - solved.segment<6>(6 * i)).norm() < 1e-12 * solved.norm());
      for (int j = 0; j <= i; ++j) {
        CHECK((blocks.inverse(i, j) - inverse.block<6, 6>(6 * i, 6 * j)).norm() < 1e-12 * inverse.norm());
      }
    }
  }
}

TEST_CASE("two hulls whose added masses do not couple: neither is in the other's matrix") {
  SceneDescription scene = two_hulls();
  REQUIRE(compile(scene, false)->groups[0].pairs.size() == 1);
  scene.groups[0].added_mass.setZero();
  CHECK(compile(scene, false)->groups[0].pairs.empty());
}

TEST_CASE("two hulls in one water: accelerations and multipliers solve the whole system") {
  for (const SceneDescription& scene : {two_hulls(), tied_hulls()}) {
    MaximalSystem system(compile(scene, false));
    const std::vector<double> y = disturbed(system);
    std::vector<double> rate(y.size());
    system.derivative(0.7, y.data(), rate.data());
    const DenseTerms t = dense_terms(system);
    const VecXd left = t.mass * t.acceleration - t.d.transpose() * t.lambda - t.load;
    CHECK(left.norm() < 1e-11 * t.load.norm());
    CHECK((t.d * t.acceleration - t.gamma).norm() < 1e-11 * (1.0 + t.gamma.norm()));
    REQUIRE(system.terms().couplings().size() == 1);
    CHECK(system.terms().couplings()[0].mass.norm() > 1.0);
    CHECK(t.mass.llt().info() == Eigen::Success);
  }
}

TEST_CASE("two hulls in one water: both formulations agree, and bodies merged or not") {
  for (const bool merged : {false, true}) {
    const auto model = compile(two_hulls(), merged);
    const auto stepped = std::shared_ptr<const Model>(model, &model->stepped());
    MaximalSystem redundant(stepped);
    RecursiveSystem recursive(std::make_shared<Terms>(stepped));
    const std::vector<double> y = disturbed(redundant);
    std::vector<double> rate(y.size()), z(recursive.size()), z_rate(z.size());
    redundant.derivative(0.7, y.data(), rate.data());
    recursive.read_bodies(0.7, y.data(), z.data());
    recursive.derivative(0.7, z.data(), z_rate.data());
    const StateLayout& s = stepped->layout;
    double largest = 0.0;
    for (int b = 0; b < stepped->body_count(); ++b) {
      largest = std::max(largest, redundant.accelerations()[idx(b)].norm());
    }
    for (int b = 0; b < stepped->body_count(); ++b) {
      CHECK((redundant.accelerations()[idx(b)] - recursive.accelerations()[idx(b)]).norm() < 1e-10 * largest);
    }
    const auto n = static_cast<Eigen::Index>(s.size - s.memory);
    const VecXd one = Eigen::Map<const VecXd>(rate.data() + s.memory, n),
                other = Eigen::Map<const VecXd>(z_rate.data() + z_rate.size() - idx(static_cast<int>(n)), n);
    CHECK((one - other).norm() < 1e-10 * one.norm());
  }
}

TEST_CASE("two hulls in one water: energy changes by the recorded power, at any heading of each") {
  for (const SceneDescription& scene : {two_hulls(), tied_hulls()}) {
    MaximalSystem system(compile(scene, false));
    const std::vector<double> y = disturbed(system);
    std::vector<double> rate(y.size());
    system.derivative(0.0, y.data(), rate.data());  // drivers are followed where the state was projected
    const double energy_rate = slope(
        [&](double t) {
          std::vector<double> there = y;
          for (std::size_t i = 0; i < y.size(); ++i) there[i] += t * rate[i];
          return mechanical_energy_at(system.terms(), t, there.data());
        },
        1e-4);
    CHECK(energy_rate == doctest::Approx(rate[idx(system.model().layout.work)]).epsilon(1e-8));
  }
}

TEST_CASE("a group without coupling and with the memories of its vessels is these vessels") {
  const SceneDescription apart = two_hulls(false);
  SceneDescription grouped = apart;
  HydroGroupDescription group;
  group.name = "group";
  group.added_mass = MatXd::Zero(12, 12);
  for (int i = 0; i < 2; ++i) {
    VesselDescription& v = grouped.vessels[idx(i)];
    group.vessels.push_back(v.name);
    for (StateSpaceBlock block : std::get<std::vector<StateSpaceBlock>>(v.memory)) {
      for (auto* motions : {&block.inputs, &block.outputs}) {
        for (int& motion : *motions) motion += 6 * i;
      }
      group.memory.push_back(block);
    }
    v.memory = std::vector<StateSpaceBlock>{};
  }
  grouped.groups = {group};
  MaximalSystem one(compile(apart, false)), other(compile(grouped, false));
  REQUIRE(one.size() == other.size());
  const std::vector<double> y = disturbed(one);
  std::vector<double> rate(y.size()), other_rate(y.size());
  one.derivative(0.7, y.data(), rate.data());
  other.derivative(0.7, y.data(), other_rate.data());
  const StateLayout& s = one.model().layout;
  for (int i = 0; i < s.work; ++i) CHECK(rate[idx(i)] == doctest::Approx(other_rate[idx(i)]).epsilon(1e-13));
  CHECK(describe_state(other.model(), s.memory + 3) == "memory state 3 of group 'group'");
}

TEST_CASE("a group that cannot be is refused by name") {
  SceneDescription scene = two_hulls();
  scene.groups[0].vessels = {"hull", "ferry"};
  CHECK(names(refusal_of_group(scene), "group 'group': there is no vessel 'ferry'"));
  scene.groups[0].vessels = {"hull"};
  CHECK(names(refusal_of_group(scene), "has 1 vessels; name two"));
  scene.groups[0].vessels = {"hull", "hull"};
  CHECK(names(refusal_of_group(scene), "vessel 'hull' is in group 'group' already"));

  scene = two_hulls();
  scene.groups[0].added_mass(0, 7) += 1.0;
  CHECK(names(refusal_of_group(scene), "added_mass is not symmetric"));
  scene = two_hulls();
  scene.groups[0].added_mass(2, 2) = 1.0;
  CHECK(names(refusal_of_group(scene), "added_mass of vessel 'hull' with itself is not zero"));
  scene = two_hulls();
  scene.groups[0].added_mass = MatXd::Zero(6, 12);
  CHECK(names(refusal_of_group(scene), "added_mass has shape (6, 12)"));
  scene = two_hulls();
  scene.groups[0].added_mass *= 100.0;
  CHECK(names(refusal_of_group(scene), "are not positive definite"));
  scene = two_hulls();
  scene.groups[0].memory[0].inputs[0] = 12;
  CHECK(names(refusal_of_group(scene), "group 'group': memory block 0: input 12 is not a motion 0..11"));
  scene = two_hulls();
  scene.vessels[0].memory = two_hulls(false).vessels[0].memory;
  CHECK(names(refusal_of_group(scene), "vessel 'hull' has a memory of its own"));
}

TEST_CASE("the recursive form refuses a group with a hull that does not float freely, by name") {
  SceneDescription driven = two_hulls();
  join(driven, "free", "motion", kGround, "barge", Vec3d::Zero());
  for (const char* motion : {"x", "y", "z", "roll", "pitch", "yaw"}) {
    driven.drivers.push_back({motion, {"motion", motion}, Curve::harmonic(0.0, 0.0, 0.1, 1.0, 0.0)});
  }
  const auto refused = [](const SceneDescription& scene) -> std::string {
    try {
      RecursiveSystem(std::make_shared<Terms>(compile(scene, false)));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  CHECK(names(refused(tied_hulls()), "of group 'group' does not float freely"));
  CHECK(names(refused(driven), "vessel 'barge' of group 'group' does not float freely"));
  CHECK(refused(two_hulls()).empty());
}

}  // namespace seacrane::test
