#include <doctest/doctest.h>

#include <random>

#include "seacrane/run/complementarity.hpp"

namespace seacrane::test {

TEST_CASE("forces of contacts push, leave nothing to overlap and act only where contacts stay") {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    CAPTURE(i);
    const Eigen::Index n = 1 + i % 8, rank = 1 + i % 5;
    const MatXd rows = MatXd::NullaryExpr(n, rank, [&] { return normal(random); });
    const MatXd g = rows * rows.transpose();
    const VecXd fall = rows * VecXd::NullaryExpr(rank, [&] { return normal(random); });
    const VecXd f = complementary_forces(g, fall), w = g * f + fall;
    CHECK(f.minCoeff() >= 0.0);
    CHECK(w.minCoeff() >= -1e-8 * fall.cwiseAbs().maxCoeff());
    CHECK(f.cwiseProduct(w).cwiseAbs().maxCoeff() < 1e-7 * (1.0 + f.maxCoeff()));
  }
}

TEST_CASE("three wires of four carry where all are asked and one would do nothing") {
  MatXd rows(4, 3);
  rows << 1, 1, 1, 1, -1, 1, 1, -1, -1, 1, 1, -1;
  const VecXd fall = rows * Eigen::Vector3d(-1.0, 0.1, 0.0);
  const VecXd f = complementary_forces(rows * rows.transpose(), fall);
  CHECK((rows.transpose() * f - Eigen::Vector3d(1.0, -0.1, 0.0)).norm() < 1e-12);
  CHECK(f.minCoeff() >= 0.0);
}

TEST_CASE("a contact that no force can part is left out, and the others carry") {
  const MatXd g = Eigen::Vector2d(0.0, 2.0).asDiagonal();
  const VecXd f = complementary_forces(g, Eigen::Vector2d(-1.0, -1.0));
  CHECK(f[0] == 0.0);
  CHECK(f[1] == doctest::Approx(0.5).epsilon(1e-14));
  CHECK(complementary_forces(MatXd::Zero(1, 1), VecXd::Constant(1, -1.0))[0] == 0.0);
}

}  // namespace seacrane::test
