#include <doctest/doctest.h>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/dynamics/recursive/tree_branches.hpp"

namespace seacrane::test {
namespace {

std::vector<double> random_values(Random& random, int count) {
  std::vector<double> out(static_cast<std::size_t>(count));
  for (double& value : out) value = random.number();
  return out;
}

/// One body on another that moves: the scene of a joint type, not closed.
struct OneBranch {
  BodyTree tree;
  explicit OneBranch(std::size_t kind, Random& random) {
    Cluster base, c;
    base.parent = 2;
    base.body = 0;
    base.members = {{0, 0}};
    c.kind = kind;
    c.parent = 0;
    c.body = 1;
    with_joint_type(kind, [&]<class Type>() {
      const ParameterValues own = find_joint_kind(Type::kind)->values(Type::example(random));
      c.joint = {0, 1, random.vector(), random.vector(), random.rotation(), random.rotation(), own};
      c.positions = Type::Branch::positions;
      c.speeds = Type::Branch::speeds;
    });
    c.q = 7;
    c.u = 6;
    c.members = {{1, 6}};
    tree.clusters = {base, c};
    tree.positions = 7 + c.positions;
    tree.speeds = tree.columns = 6 + c.speeds;
  }
};

}  // namespace

TEST_CASE("every branch: twist is the rate of the pose, bias that of the twist, and read undoes place") {
  Random random(11);
  for_each_joint_type([&]<class Type>(std::size_t kind) {
    if constexpr (requires { typename Type::Branch; }) {
      CAPTURE(std::string(Type::kind));
      const OneBranch scene(kind, random);
      ArticulatedTree<double> tree(scene.tree, 2);
      std::vector<BodyKinematics<double>> bodies(3, BodyKinematics<double>::ground());
      const auto q = random_values(random, scene.tree.positions);
      const auto u = random_values(random, scene.tree.speeds);
      std::vector<double> q_rate(q.size());
      tree.place(q.data(), u.data(), bodies.data());
      tree.kinematics().position_rates(q.data(), u.data(), bodies.data(), q_rate.data());

      // Rates of the pose along q(t), u constant: position, and R' R^T.
      const auto at = [&](double t) {
        std::vector<double> moved = q;
        std::vector<BodyKinematics<double>> k(3, BodyKinematics<double>::ground());
        for (std::size_t i = 0; i < q.size(); ++i) moved[i] += t * q_rate[i];
        tree.place(moved.data(), u.data(), k.data());
        return k[1];
      };
      const Vec3d velocity = slope([&](double t) -> Vec3d { return at(t).position; });
      const Mat3d spin =
          slope([&](double t) -> Mat3d { return at(t).rotation; }) * bodies[1].rotation.transpose();
      CHECK((velocity - bodies[1].velocity).norm() < kDifference);
      CHECK((spin - skew<double>(bodies[1].angular_velocity)).norm() < kDifference);

      // The bias is what the twist gains while the speeds are held: what solve() gives the child beyond its
      // parent's acceleration and the share of its own speeds.
      const Vec6d gained = slope([&](double t) -> Vec6d { return twist(at(t)); });
      tree.place(q.data(), u.data(), bodies.data());
      const std::vector<Mat6d> mass(2, Mat6d::Identity());
      const std::vector<Vec6d> load(3, Vec6d::Zero());
      std::vector<Vec6d> acceleration(3);
      std::vector<double> u_rate(u.size());
      tree.factor(mass.data());
      tree.solve(load.data(), true, acceleration.data(), u_rate.data());
      const Cluster& c = scene.tree.clusters[1];
      Vec6d bias = acceleration[1] - acceleration[0];
      bias.head<3>() -= acceleration[0].tail<3>().cross(tree.kinematics().over_parent(1).reach);
      for (int k = 0; k < c.speeds; ++k) {
        bias -= u_rate[idx(c.u + k)] * tree.kinematics().columns(c.members[0])[k].vector();
      }
      CHECK((gained - bias).norm() < kDifference);

      std::vector<double> q_back(q.size()), u_back(u.size());
      tree.read(bodies.data(), q_back.data(), u_back.data());
      std::vector<BodyKinematics<double>> again(3, BodyKinematics<double>::ground());
      tree.place(q_back.data(), u_back.data(), again.data());
      CHECK((again[1].position - bodies[1].position).norm() < 1e-14);
      CHECK((again[1].rotation - bodies[1].rotation).norm() < 1e-14);
      CHECK((twist(again[1]) - twist(bodies[1])).norm() < 1e-13);
    }
  });
}

TEST_CASE("every branch: the tree on dual numbers gives the slopes of its accelerations") {
  Random random(14);
  for_each_joint_type([&]<class Type>(std::size_t kind) {
    if constexpr (requires { typename Type::Branch; }) {
      CAPTURE(std::string(Type::kind));
      const OneBranch scene(kind, random);
      const auto q = random_values(random, scene.tree.positions),
                 q_along = random_values(random, scene.tree.positions),
                 u = random_values(random, scene.tree.speeds),
                 u_along = random_values(random, scene.tree.speeds);
      std::vector<Mat6d> mass(2, Mat6d::Identity());
      for (Mat6d& m : mass) m.bottomRightCorner<3, 3>() = random.inertia();
      std::vector<Vec6d> load(3);
      for (Vec6d& w : load) w << random.vector(), random.vector();
      // Rates of the speeds, at a distance t along the direction.
      const auto solve = [&]<class T>(const T& t) {
        ArticulatedTree<T> tree(scene.tree, 2);
        std::vector<BodyKinematics<T>> bodies(3, BodyKinematics<T>::ground());
        std::vector<T> at_q, at_u;
        for (std::size_t i = 0; i < q.size(); ++i) at_q.push_back(T(q[i]) + T(q_along[i]) * t);
        for (std::size_t i = 0; i < u.size(); ++i) at_u.push_back(T(u[i]) + T(u_along[i]) * t);
        std::vector<Mat6<T>> masses;
        for (const Mat6d& m : mass) masses.push_back(m.cast<T>());
        std::vector<Vec6<T>> loads, acceleration(3);
        for (const Vec6d& w : load) loads.push_back(w.cast<T>());
        std::vector<T> u_rate(u.size());
        tree.place(at_q.data(), at_u.data(), bodies.data());
        tree.factor(masses.data());
        tree.solve(loads.data(), true, acceleration.data(), u_rate.data());
        return u_rate;
      };
      const std::vector<Dual<1>> slopes = solve(Dual<1>::variable(0.0, 0));
      const VecXd differences = slope([&](double t) -> VecXd {
        const std::vector<double> u_rate = solve(t);
        return Eigen::Map<const VecXd>(u_rate.data(), static_cast<Eigen::Index>(u_rate.size()));
      });
      const double largest = differences.cwiseAbs().maxCoeff();
      for (std::size_t i = 0; i < slopes.size(); ++i) {
        CHECK(std::abs(slopes[i].slope[0] - differences[static_cast<Eigen::Index>(i)]) < 1e-8 * largest);
      }
    }
  });
}

TEST_CASE("accelerations of a tree agree with the redundant formulation, joint by joint") {
  Random random(12);
  for_each_joint_type([&]<class Type>(std::size_t) {
    if constexpr (requires { typename Type::Branch; }) {
      CAPTURE(std::string(Type::kind));
      for (int trial = 0; trial < 4; ++trial) {
        SceneDescription scene;
        scene.bodies = {body_at("a", 3.0, random.vector()), body_at("b", 0.5, random.vector()),
                        body_at("c", 1.0, random.vector())};
        for (auto& b : scene.bodies) b.inertia = b.mass * random.inertia();
        join_example(scene, Type::kind, "joint a", "a", "b", random);
        join_example(scene, Type::kind, "joint c", "b", "c", random);
        const auto model = compile(scene);
        MaximalSystem redundant(model);
        std::vector<double> y = moving_state(redundant, 100 + static_cast<std::uint64_t>(trial));
        std::vector<double> ydot(y.size());
        redundant.derivative(0.0, y.data(), ydot.data());

        const BodyTree shape = build_tree(*model);
        CHECK(shape.loops.empty());
        ArticulatedTree<double> tree(shape, 3);
        std::vector<double> q(idx(shape.positions)), u(idx(shape.speeds)), u_rate(idx(shape.speeds));
        auto bodies = redundant.terms().bodies();
        tree.read(bodies.data(), q.data(), u.data());
        tree.place(q.data(), u.data(), bodies.data());
        std::vector<Mat6d> mass;
        for (int b = 0; b < 3; ++b) mass.push_back(redundant.terms().mass_matrix(b));
        std::vector<Vec6d> acceleration(4);
        tree.factor(mass.data());
        tree.solve(redundant.terms().loads().data(), true, acceleration.data(), u_rate.data());
        double largest = 0.0;
        for (const Vec6d& a : redundant.accelerations()) largest = std::max(largest, a.norm());
        for (std::size_t b = 0; b < 3; ++b) {
          CHECK((acceleration[b] - redundant.accelerations()[b]).norm() < 1e-11 * largest);
        }
      }
    }
  });
}

TEST_CASE("a strut across a hinge moves and accelerates as its loop of constraints does") {
  Random random(13);
  int told = 0;
  for (int trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const auto model = compile(strut_scene(random, trial % 2 == 0, trial % 4 < 2));
    MaximalSystem redundant(model);
    const BodyTree shape = build_tree(*model);
    if (shape.struts.empty()) continue;  // its ends come nearer than they lie off the slide's line
    ++told;
    CHECK(shape.loops.empty());
    CHECK(shape.speeds == 12);
    std::vector<double> y = moving_state(redundant, 100 + static_cast<std::uint64_t>(trial));
    std::vector<double> ydot(y.size());
    redundant.derivative(0.0, y.data(), ydot.data());
    ArticulatedTree<double> tree(shape, 5);
    std::vector<double> q(idx(shape.positions)), u(idx(shape.speeds)), u_rate(idx(shape.speeds));
    auto bodies = redundant.terms().bodies();
    tree.read(bodies.data(), q.data(), u.data());
    tree.place(q.data(), u.data(), bodies.data());
    std::vector<Mat6d> mass;
    for (int b = 0; b < 5; ++b) {
      const auto &here = bodies[idx(b)], &there = redundant.terms().bodies()[idx(b)];
      CHECK((here.position - there.position).norm() < 1e-12);
      CHECK((here.rotation - there.rotation).norm() < 1e-12);
      CHECK((twist(here) - twist(there)).norm() < 1e-11);
      mass.push_back(redundant.terms().mass_matrix(b));
    }
    std::vector<Vec6d> acceleration(6);
    tree.factor(mass.data());
    tree.solve(redundant.terms().loads().data(), true, acceleration.data(), u_rate.data());
    double largest = 0.0;
    for (const Vec6d& a : redundant.accelerations()) largest = std::max(largest, a.norm());
    for (std::size_t b = 0; b < 5; ++b) {
      CHECK((acceleration[b] - redundant.accelerations()[b]).norm() < 1e-10 * largest);
    }
  }
  CHECK(told > 20);
}

/// Both formulations at one state: accelerations of all bodies, relative to the largest.
void check_agreement(const SceneDescription& scene, double bound) {
  const auto model = compile(scene);
  MaximalSystem redundant(model);
  RecursiveSystem recursive(std::make_shared<Terms>(model));
  std::vector<double> y = moving_state(redundant, 7), ydot(y.size()), back = y;
  std::vector<double> z(recursive.size()), zdot(recursive.size());
  redundant.project(0.3, y.data(), false);
  redundant.derivative(0.3, y.data(), ydot.data());
  recursive.read_bodies(0.3, y.data(), z.data());
  recursive.project(0.3, z.data(), false);
  recursive.derivative(0.3, z.data(), zdot.data());
  recursive.write_bodies(0.3, z.data(), back.data());
  double largest = 0.0, worst = 0.0;
  for (const Vec6d& a : redundant.accelerations()) largest = std::max(largest, a.norm());
  for (std::size_t b = 0; b < redundant.accelerations().size(); ++b) {
    worst = std::max(worst, (recursive.accelerations()[b] - redundant.accelerations()[b]).norm());
  }
  CHECK(worst < bound * largest);
  for (int b = 0; b < model->body_count(); ++b) {
    const int p = model->layout.pose(b);
    for (int i = 0; i < 3; ++i) CHECK(back[idx(p + i)] == doctest::Approx(y[idx(p + i)]).epsilon(1e-11));
    for (int i = 0; i < 6; ++i) {
      CHECK(std::abs(back[idx(model->layout.twist(b) + i)] - y[idx(model->layout.twist(b) + i)]) < 1e-10);
    }
  }
  const int memory = model->layout.work - model->layout.memory;
  for (int i = 0; i < memory; ++i) {
    CHECK(std::abs(zdot[zdot.size() - 2 - idx(memory) + idx(i)] - ydot[idx(model->layout.memory + i)]) <
          1e-12);
  }
  CHECK(std::abs(zdot[zdot.size() - 2] - ydot[idx(model->layout.work)]) <
        1e-9 * (1.0 + std::abs(zdot.back())));
}

TEST_CASE("loops, drivers, vessel, memory and waves: the recursive form agrees with the redundant one") {
  check_agreement(slider_crank(), 1e-10);
  check_agreement(slider_crank("base"), 1e-10);
  SceneDescription afloat = slider_crank("base");
  make_vessel(afloat, "base");
  check_agreement(afloat, 1e-10);
  check_agreement(parallelogram(2), 1e-9);
  check_agreement(parallelogram(5), 1e-9);
}

/// Accelerations and power of both formulations where the recursive one places the bodies: what drivers
/// prescribe there follows from the time.
void check_where_driven(const SceneDescription& scene, double bound) {
  const auto model = compile(scene);
  MaximalSystem redundant(model);
  RecursiveSystem recursive(std::make_shared<Terms>(model));
  std::vector<double> y = moving_state(redundant, 7), ydot(y.size());
  std::vector<double> z(recursive.size()), zdot(recursive.size());
  recursive.read_bodies(0.0, y.data(), z.data());
  recursive.project(0.3, z.data(), false);
  recursive.derivative(0.3, z.data(), zdot.data());
  recursive.write_bodies(0.3, z.data(), y.data());
  redundant.derivative(0.3, y.data(), ydot.data());
  CHECK(constraint_residual(redundant.terms(), 0.3, y.data()).position < 1e-12);
  CHECK(constraint_residual(redundant.terms(), 0.3, y.data()).rate < 1e-11);
  double largest = 0.0, worst = 0.0;
  for (std::size_t b = 0; b < redundant.accelerations().size(); ++b) {
    const Vec6d& a = redundant.accelerations()[b];
    largest = std::max(largest, a.norm());
    worst = std::max(worst, (recursive.accelerations()[b] - a).norm());
  }
  CHECK(worst < bound * largest);
  CHECK(std::abs(zdot[zdot.size() - 2] - ydot[idx(model->layout.work)]) < bound * (1.0 + zdot.back()));
}

TEST_CASE("driven strokes and bodies: the recursive form, without unknowns for them, agrees") {
  Random random(5);
  int told = 0;
  for (int trial = 0; trial < 8; ++trial) {
    CAPTURE(trial);
    const SceneDescription scene = driven_strut_scene(random, trial % 2 == 0, trial % 4 < 2, trial > 3);
    const BodyTree tree = build_tree(*compile(scene));
    if (tree.struts.empty()) continue;  // its ends come nearer than they lie off the slide's line
    ++told;
    CHECK(tree.driven == (trial > 3 ? 7 : 1));
    CHECK(tree.loop_rows == 0);
    check_where_driven(scene, 1e-9);
  }
  CHECK(told >= 4);
}

}  // namespace seacrane::test
