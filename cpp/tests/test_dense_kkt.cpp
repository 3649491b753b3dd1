#include <doctest/doctest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include "multibody_scenes.hpp"

namespace seacrane::test {
namespace {

/// Three bodies, one loop through the ground, random rows; eq (9) written out.
struct RandomSystem {
  static constexpr int bodies = 3;
  std::vector<ElementModel> elements;
  std::vector<GraphNode> nodes;
  std::vector<RowBlock<double>> blocks;
  std::vector<Mat6d> mass, over_mass;
  std::vector<Vec6d> load;
  std::vector<double> gamma;
  BlockSchur schur;
  MatXd big_mass = MatXd::Zero(18, 18), d;

  explicit RandomSystem(std::uint64_t seed, bool symmetric = true) {
    Random random(seed);
    const int joins[4][3] = {{3, 0, 3}, {0, 1, 4}, {1, 2, 2}, {2, 3, 1}};
    for (const auto& j : joins) nodes.push_back({j[2], j[0], j[1]});
    schur = BlockSchur(nodes, bodies);
    for (int b = 0; b < bodies; ++b) {
      Mat6d a;
      for (int i = 0; i < 36; ++i) a(i) = random.number();
      Mat6d m = a * a.transpose() + 2.0 * Mat6d::Identity();
      if (!symmetric) m(0, 4) += 0.7;
      mass.push_back(m);
      load.push_back((Vec6d() << random.vector(), random.vector()).finished());
      big_mass.block<6, 6>(6 * b, 6 * b) = m;
    }
    d = MatXd::Zero(schur.rows(), 18);
    for (std::size_t e = 0; e < nodes.size(); ++e) {
      ElementModel element;
      element.rows = nodes[e].rows;
      element.first = nodes[e].first;
      element.second = nodes[e].second;
      element.row = schur.row(static_cast<int>(e));
      elements.push_back(element);
      RowBlock<double> block;
      for (int side = 0; side < 2; ++side) {
        const int body = side == 0 ? element.first : element.second;
        for (int r = 0; r < element.rows; ++r) {
          for (int c = 0; c < 6; ++c) block.d[side](r, c) = random.number();
        }
        over_mass.emplace_back(Mat6d::Zero());
        if (body == bodies) continue;
        over_mass.back() = block.d[side] * mass[static_cast<std::size_t>(body)].inverse();
        d.block(element.row, 6 * body, element.rows, 6) = block.d[side].topRows(element.rows);
      }
      blocks.push_back(block);
    }
    for (int i = 0; i < schur.rows(); ++i) gamma.push_back(random.number());
  }

  VecXd loads() const { return Eigen::Map<const VecXd>(load[0].data(), 18); }
  VecXd right_side() const { return Eigen::Map<const VecXd>(gamma.data(), schur.rows()); }
};

struct Solution {
  VecXd acceleration, lambda;
};

Solution by_lu(const RandomSystem& s) {
  DenseKkt kkt(RandomSystem::bodies, s.schur.rows());
  std::vector<Vec6d> a(3);
  VecXd lambda(s.schur.rows());
  kkt.factor(s.elements, s.blocks.data(), s.mass.data(), {}, nullptr);
  kkt.solve(s.load.data(), s.gamma.data(), a.data(), lambda.data());
  return {Eigen::Map<const VecXd>(a[0].data(), 18), lambda};
}

}  // namespace

TEST_CASE("dense LU solves both rows of equation 9, also with the paper's unsymmetric mass") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomSystem s(seed, seed % 2 == 0);
    const Solution x = by_lu(s);
    CHECK((s.big_mass * x.acceleration - s.loads() - s.d.transpose() * x.lambda).norm() < 1e-12);
    CHECK((s.d * x.acceleration - s.right_side()).norm() < 1e-12);
  }
}

TEST_CASE("dense LU and the Schur complement agree") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomSystem s(seed);
    std::vector<double> values(s.schur.value_count());
    s.schur.assemble(s.blocks.data(), s.over_mass.data(), values.data());
    REQUIRE(s.schur.factor(values.data()) < 1e3);
    const MatXd inverse = s.big_mass.inverse();
    VecXd lambda = s.right_side() - s.d * (inverse * s.loads());
    s.schur.solve(values.data(), lambda.data());
    const Solution x = by_lu(s);
    CHECK((x.lambda - lambda).norm() < 1e-12 * lambda.norm());
    CHECK((x.acceleration - inverse * (s.loads() + s.d.transpose() * lambda)).norm() < 1e-12);
  }
}

TEST_CASE("a repeated joint: rank, null space, the same motion and the shortest multipliers") {
  RandomSystem s(4);
  // The same joint again: twice the rows, the same constraint.
  s.nodes.push_back(s.nodes[1]);
  s.blocks.push_back(s.blocks[1]);
  s.elements.push_back(s.elements[1]);
  s.elements.back().row = s.schur.rows();
  s.over_mass.push_back(s.over_mass[2]);
  s.over_mass.push_back(s.over_mass[3]);
  const int rows = s.schur.rows() + 4;
  MatXd d(rows, 18);
  d << s.d, s.d.middleRows(s.elements[1].row, 4);
  RowSpace space(RandomSystem::bodies, rows);
  CHECK(space.factor(s.elements, s.blocks.data(), s.over_mass.data(), 1e-6) == rows - 4);
  const MatXd& null_space = space.null_space();
  REQUIRE(null_space.cols() == 4);
  CHECK((d.transpose() * null_space).norm() < 1e-12);
  CHECK((null_space.transpose() * null_space - MatXd::Identity(4, 4)).norm() < 1e-13);

  VecXd right(rows);
  right << s.right_side(), s.right_side().segment(s.elements[1].row, 4);
  DenseKkt kkt(RandomSystem::bodies, rows);
  kkt.factor(s.elements, s.blocks.data(), s.mass.data(), {}, &space);
  std::vector<Vec6d> a(3);
  VecXd lambda(rows);
  kkt.solve(s.load.data(), right.data(), a.data(), lambda.data());
  const Eigen::Map<const VecXd> acceleration(a[0].data(), 18);
  CHECK((d * acceleration - right).norm() < 1e-11);
  CHECK((s.big_mass * acceleration - s.loads() - d.transpose() * lambda).norm() < 1e-11);
  CHECK((acceleration - by_lu(RandomSystem(4)).acceleration).norm() < 1e-11);
  const VecXd shortest = Eigen::CompleteOrthogonalDecomposition<MatXd>(d.transpose())
                             .solve(s.big_mass * acceleration - s.loads());
  CHECK((lambda - shortest).norm() < 1e-10 * shortest.norm());
  CHECK((lambda.segment(s.elements[1].row, 4) - lambda.tail(4)).norm() < 1e-10);  // twins share alike
}

TEST_CASE("independent rows of a system of full rank give its solution") {
  const RandomSystem s(6);
  RowSpace space(RandomSystem::bodies, s.schur.rows());
  CHECK(space.factor(s.elements, s.blocks.data(), s.over_mass.data(), 1e-6) == s.schur.rows());
  CHECK(space.null_space().cols() == 0);
  DenseKkt kkt(RandomSystem::bodies, s.schur.rows());
  kkt.factor(s.elements, s.blocks.data(), s.mass.data(), {}, &space);
  std::vector<Vec6d> a(3);
  VecXd lambda(s.schur.rows());
  kkt.solve(s.load.data(), s.gamma.data(), a.data(), lambda.data());
  CHECK((lambda - by_lu(s).lambda).norm() < 1e-10 * lambda.norm());
}

TEST_CASE("a rod of 1e-8 of its neighbours' mass: the run takes LU and both rows of equation 9 hold") {
  for (const double ratio : {1.0, 1e-4, 1e-8}) {
    CAPTURE(ratio);
    SceneDescription scene = slider_crank();
    for (auto& b : scene.bodies) {
      if (b.name != "rod") continue;
      b.mass *= ratio;
      b.inertia *= ratio;
    }
    MaximalSystem system(compile(scene));
    const std::vector<double> y = moving_state(system, 3);
    std::vector<double> rate(y.size());
    system.derivative(0.0, y.data(), rate.data());
    const DenseTerms k = dense_terms(system);
    const VecXd balance = k.mass * k.acceleration - k.load - k.d.transpose() * k.lambda;
    // Per body, against the loads that meet there; the light rod has no rounding of the heavy ones to spare.
    CHECK(balance.norm() < 1e-12 * (k.load.norm() + k.lambda.norm()));
    CHECK((k.d * k.acceleration - k.gamma).norm() < (ratio == 1e-4 ? 1e-9 : 1e-11) * k.acceleration.norm());
    CHECK((system.dense_solves() > 0) == (ratio < 1e-6));
    // Against complete pivoting: a backward-stable solution of a system whose condition, lengths of order 1
    // and masses of 1e-8 to 3 kg, is about 50.
    const Eigen::Index n = k.mass.rows(), rows = k.d.rows();
    MatXd kkt = MatXd::Zero(n + rows, n + rows);
    kkt.topLeftCorner(n, n) = k.mass;
    kkt.bottomLeftCorner(rows, n) = k.d;
    kkt.topRightCorner(n, rows) = -k.d.transpose();
    VecXd right(n + rows);
    right << k.load, k.gamma;
    const VecXd x = kkt.fullPivLu().solve(right);
    // The Schur complement loses as many digits as the mass ratio has; LU loses none.
    const double tolerance = ratio == 1e-4 ? 1e-9 : 1e-12;
    CHECK((x.tail(rows) - k.lambda).norm() < tolerance * k.lambda.norm());
    CHECK((x.head(n) - k.acceleration).norm() < tolerance * k.acceleration.norm());
  }
}

}  // namespace seacrane::test
