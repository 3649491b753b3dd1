#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <limits>

#include "multibody_scenes.hpp"
#include "seacrane/model/block_schur.hpp"

namespace seacrane::test {
namespace {

/// Joints between bodies with random rows and masses, and S = D M^-1 D^T written out.
class RandomGraph {
 public:
  RandomGraph(int bodies, std::uint64_t seed) : bodies_(bodies), random_(seed) {
    for (int b = 0; b < bodies; ++b) {
      Mat6d a;
      for (int i = 0; i < 36; ++i) a(i) = random_.number();
      inverse_mass_.push_back(a * a.transpose() + Mat6d::Identity());
    }
  }

  /// Adds a joint unless its rows would depend on those there are; ground is body `bodies`.
  bool add(int first, int second, int rows) {
    GraphNode node{rows, first, second};
    RowBlock<double> block;
    for (int side = 0; side < 2; ++side) {
      for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < 6; ++c) block.d[side](r, c) = random_.number();
      }
    }
    nodes_.push_back(node);
    blocks_.push_back(block);
    if (rows == 0) return true;
    const MatXd d = jacobian(counting());
    if (Eigen::ColPivHouseholderQR<MatXd>(d.transpose()).rank() == d.rows() && d.rows() <= 6 * bodies_)
      return true;
    nodes_.pop_back();
    blocks_.pop_back();
    return false;
  }

  /// Largest error of x, of the condition measure, relative; S x = r for a random r.
  void check() {
    const BlockSchur schur(nodes_, bodies_);
    std::vector<int> row;
    for (std::size_t e = 0; e < nodes_.size(); ++e) row.push_back(schur.row(static_cast<int>(e)));
    const MatXd d = jacobian(row), s = d * inverse_mass() * d.transpose();
    REQUIRE(schur.rows() == d.rows());
    const auto over = over_mass();
    std::vector<double> values(schur.value_count());
    schur.assemble(blocks_.data(), over.data(), values.data());
    const double condition = schur.factor(values.data());
    const Eigen::LLT<MatXd> cholesky(s);
    const MatXd l = cholesky.matrixL();
    const double expected = s.diagonal().cwiseQuotient(l.diagonal().cwiseAbs2()).maxCoeff();
    CHECK(condition == doctest::Approx(std::max(1.0, expected)).epsilon(1e-9 * expected));
    VecXd r(d.rows());
    for (double& v : r) v = random_.number();
    VecXd x = r;
    schur.solve(values.data(), x.data());
    // Backward error: independent of the condition of S.
    CHECK((s * x - r).norm() < 1e-13 * (s.norm() * x.norm() + r.norm()));
    CHECK((x - cholesky.solve(r)).norm() < 1e-14 * x.norm() * expected * static_cast<double>(d.rows()));
  }

  double singular_condition() const {
    const BlockSchur schur(nodes_, bodies_);
    std::vector<double> values(schur.value_count());
    const auto over = over_mass();
    schur.assemble(blocks_.data(), over.data(), values.data());
    return schur.factor(values.data());
  }

  /// Rows that repeat are left out, each with the combination that S takes to zero; what the others solve
  /// solves all.
  void check_chosen(int dependent) {
    const BlockSchur schur(nodes_, bodies_);
    std::vector<int> row;
    for (std::size_t e = 0; e < nodes_.size(); ++e) row.push_back(schur.row(static_cast<int>(e)));
    const MatXd d = jacobian(row), s = d * inverse_mass() * d.transpose();
    const auto over = over_mass();
    std::vector<double> values(schur.value_count());
    schur.assemble(blocks_.data(), over.data(), values.data());
    std::vector<double> again(values);
    std::vector<char> left_out;
    CHECK(schur.choose(values.data(), schur.diagonal(values.data()), 1e8, left_out) < 1e6);
    CHECK(std::ranges::count(left_out, 1) == dependent);
    VecXd combination(schur.rows());
    for (int r = 0; r < schur.rows(); ++r) {
      if (!left_out[static_cast<std::size_t>(r)]) continue;
      schur.null_vector(values.data(), r, combination.data());
      CHECK(combination[r] == 1.0);
      CHECK((s * combination).norm() < 1e-10 * s.norm() * combination.norm());
    }
    schur.factor(again.data(), left_out);
    VecXd any(schur.rows());
    for (double& v : any) v = random_.number();
    const VecXd right = s * any;
    VecXd x = right;
    schur.solve(again.data(), x.data());
    CHECK((s * x - right).norm() < 1e-9 * right.norm());
    for (int r = 0; r < schur.rows(); ++r)
      CHECK((x[r] == 0.0) == (left_out[static_cast<std::size_t>(r)] != 0));
  }

  void repeat(std::size_t joint) {
    nodes_.push_back(GraphNode(nodes_[joint]));
    blocks_.push_back(RowBlock<double>(blocks_[joint]));
  }

  Random& random() { return random_; }
  int count() const { return static_cast<int>(nodes_.size()); }

 private:
  std::vector<int> counting() const {
    std::vector<int> row;
    int next = 0;
    for (const auto& n : nodes_) {
      row.push_back(next);
      next += n.rows;
    }
    return row;
  }
  MatXd jacobian(const std::vector<int>& row) const {
    int rows = 0;
    for (const auto& n : nodes_) rows += n.rows;
    MatXd d = MatXd::Zero(rows, 6 * bodies_);
    for (std::size_t e = 0; e < nodes_.size(); ++e) {
      const int sides[2] = {nodes_[e].first, nodes_[e].second};
      for (int side = 0; side < 2; ++side) {
        if (sides[side] < bodies_) {
          d.block(row[e], 6 * sides[side], nodes_[e].rows, 6) = blocks_[e].d[side].topRows(nodes_[e].rows);
        }
      }
    }
    return d;
  }
  MatXd inverse_mass() const {
    MatXd out = MatXd::Zero(6 * bodies_, 6 * bodies_);
    for (int b = 0; b < bodies_; ++b)
      out.block<6, 6>(6 * b, 6 * b) = inverse_mass_[static_cast<std::size_t>(b)];
    return out;
  }
  std::vector<Mat6d> over_mass() const {
    std::vector<Mat6d> out(2 * nodes_.size(), Mat6d::Zero());
    for (std::size_t e = 0; e < nodes_.size(); ++e) {
      const int sides[2] = {nodes_[e].first, nodes_[e].second};
      for (std::size_t side = 0; side < 2; ++side) {
        if (sides[side] < bodies_) {
          out[2 * e + side] = blocks_[e].d[side] * inverse_mass_[static_cast<std::size_t>(sides[side])];
        }
      }
    }
    return out;
  }

  int bodies_;
  Random random_;
  std::vector<Mat6d> inverse_mass_;
  std::vector<GraphNode> nodes_;
  std::vector<RowBlock<double>> blocks_;
};

int pick(Random& random, int below) {
  return std::min(below - 1, static_cast<int>(0.5 * (random.number() + 1.0) * below));
}

}  // namespace

TEST_CASE("block Cholesky equals dense Cholesky on chains and trees, fixed to the ground or free") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    for (const bool chain : {true, false}) {
      RandomGraph graph(8, seed);
      if (seed % 2 == 0) CHECK(graph.add(8, 0, 5));
      for (int b = 1; b < 8; ++b) {
        CHECK(graph.add(chain ? b - 1 : pick(graph.random(), b), b, 1 + pick(graph.random(), 6)));
      }
      graph.check();
    }
  }
}

TEST_CASE("block Cholesky equals dense Cholesky on random graphs with loops, ground on either side") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    const int bodies = 3 + static_cast<int>(seed % 8);
    RandomGraph graph(bodies, 100 + seed);
    for (int i = 0; i < 4 * bodies; ++i) {
      const int a = pick(graph.random(), bodies + 1), b = pick(graph.random(), bodies + 1);
      if (a != b) graph.add(a, b, 1 + pick(graph.random(), 6));
    }
    CHECK(graph.count() > bodies);  // loops
    graph.check();
  }
}

TEST_CASE("panels longer than the chunk on the stack: many joints at one body") {
  RandomGraph graph(32, 7);
  for (int b = 1; b < 32; ++b) CHECK(graph.add(0, b, 5));
  graph.check();
  RandomGraph grounded(32, 8);
  for (int b = 1; b < 32; ++b) CHECK(grounded.add(b % 2 == 0 ? 0 : b, b % 2 == 0 ? b : 0, 3));
  for (int b = 2; b < 32; ++b) CHECK(grounded.add(b - 1, b, 1));
  CHECK(grounded.add(32, 0, 6));
  grounded.check();
}

TEST_CASE("joints without rows take no part") {
  RandomGraph graph(3, 9);
  CHECK(graph.add(3, 0, 0));
  CHECK(graph.add(0, 1, 4));
  CHECK(graph.add(1, 2, 0));
  CHECK(graph.add(2, 1, 5));
  graph.check();
  // Among loops as well, where many rows meet at its bodies.
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    RandomGraph loops(6, 200 + seed);
    for (int i = 0; i < 14; ++i) {
      const int a = pick(loops.random(), 7), b = pick(loops.random(), 7);
      if (a != b) loops.add(a, b, i % 3 == 0 ? 0 : 1 + pick(loops.random(), 6));
    }
    loops.check();
  }
}

TEST_CASE("a repeated joint makes the condition measure explode") {
  RandomGraph graph(4, 10);
  for (int b = 1; b < 4; ++b) CHECK(graph.add(b - 1, b, 4));
  const double regular = graph.singular_condition();
  CHECK(regular < 1e6);
  graph.repeat(2);
  CHECK(graph.singular_condition() > 1e11);
}

TEST_CASE("rows that depend on those before them are left out") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    RandomGraph graph(6, 300 + seed);
    for (int b = 1; b < 6; ++b) CHECK(graph.add(pick(graph.random(), b), b, b == 3 ? 4 : 2));
    graph.repeat(2);
    graph.repeat(4);
    graph.check_chosen(4 + 2);
  }
}

}  // namespace seacrane::test
