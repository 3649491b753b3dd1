#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "seacrane/math/dual.hpp"
#include "seacrane/math/spd_inverse.hpp"

namespace {

template <int n>
void check_size(std::mt19937& random) {
  using Square = Eigen::Matrix<double, n, n>;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decade(-3.0, 3.0);
  for (int trial = 0; trial < 50; ++trial) {
    const Square root = Square::NullaryExpr([&] { return normal(random); });
    Eigen::Matrix<double, n, 1> unit;  // kg beside kg m2
    for (int i = 0; i < n; ++i) unit[i] = std::pow(10.0, decade(random));
    const Square sound = root * root.transpose() + Square::Identity();
    const Square a = unit.asDiagonal() * sound * unit.asDiagonal();
    Square lower = a;
    lower.template triangularView<Eigen::StrictlyUpper>().setConstant(1e99);  // is not read
    const Square inverse = seacrane::spd_inverse(lower);
    const Square scaled = unit.asDiagonal() * inverse * unit.asDiagonal();  // of `sound`
    CHECK((scaled * sound - Square::Identity()).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(inverse == inverse.transpose());
  }
}

}  // namespace

TEST_CASE("inverse of a small positive definite matrix with units of many sizes") {
  std::mt19937 random(5);
  check_size<1>(random);
  check_size<2>(random);
  check_size<3>(random);
  check_size<5>(random);
  check_size<6>(random);
}

TEST_CASE("factors of an inertia solve as its inverse does, in units of many sizes, coupled or apart") {
  using namespace seacrane;
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decade(-4.0, 4.0);
  for (int trial = 0; trial < 200; ++trial) {
    const Mat6d root = Mat6d::NullaryExpr([&] { return normal(random); });
    const Vec6d unit = Vec6d::NullaryExpr([&] { return std::pow(10.0, decade(random)); });
    const Mat6d sound = root * root.transpose() + Mat6d::Identity();
    Mat6d whole = unit.asDiagonal() * sound * unit.asDiagonal(), apart = whole;
    apart.bottomLeftCorner<3, 3>().setZero();
    apart.topRightCorner<3, 3>().setZero();
    Mat6d compact = apart;
    compact.topLeftCorner<3, 3>() = 7.0 * Mat3d::Identity();
    const Vec6d load = Vec6d::NullaryExpr([&] { return normal(random); });
    InertiaFactor<double> factor;
    const auto check = [&](const Mat6d& mass) {
      const Vec6d expected = spd_inverse<6, double>(mass) * load;
      const Vec6d found = factor.solve(Wrench<double>(load)).vector();
      const Vec6d size = mass.diagonal().cwiseSqrt();  // in units of its own
      CHECK(size.cwiseProduct(found - expected).norm() < 1e-11 * size.cwiseProduct(expected).norm());
    };
    for (const Mat6d& mass : {whole, apart}) {  // in turn, as a part dips in
      factor.take(SpatialInertia<double>(mass));
      check(mass);
    }
    factor.take(CompactInertia<double>{7.0, Symmetric3<double>::lower(compact.bottomRightCorner<3, 3>())});
    check(compact);
  }
}

TEST_CASE("an inertia that is apart has the same factors where it is not known to be") {
  using namespace seacrane;
  using Number = Dual<3>;
  const Mat3d root = (Mat3d() << 2.0, 0.3, -0.1, 0.0, 1.0, 0.7, 0.0, 0.0, 3.0).finished();
  const Mat3d turning = root * root.transpose();
  InertiaFactor<double> known;
  InertiaFactor<Number> unknown;
  known.take(CompactInertia<double>{7.0, Symmetric3<double>::lower(turning)});
  unknown.take(SpatialInertia<Number>(
      CompactInertia<Number>{Number(7.0), Symmetric3<Number>::lower(turning.cast<Number>())}));
  const Vec6d load = (Vec6d() << 1.0, -2.0, 0.5, 3.0, 0.1, -0.7).finished();
  const Vec6d expected = known.solve(Wrench<double>(load)).vector();
  const Vec6<Number> found = unknown.solve(Wrench<Number>(load.cast<Number>())).vector();
  for (int i = 0; i < 6; ++i) CHECK(found[i].value == doctest::Approx(expected[i]).epsilon(1e-15));
}
