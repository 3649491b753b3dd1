#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

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

TEST_CASE("factors of an inertia are those of its matrix, to the bit where moving and turning are apart") {
  using namespace seacrane;
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const Mat6d root = Mat6d::NullaryExpr([&] { return normal(random); });
    Mat6d whole = root * root.transpose() + Mat6d::Identity(), apart = whole;
    apart.bottomLeftCorner<3, 3>().setZero();
    apart.topRightCorner<3, 3>().setZero();
    Mat6d compact = apart;
    compact.topLeftCorner<3, 3>() = 7.0 * Mat3d::Identity();
    const Vec6d load = Vec6d::NullaryExpr([&] { return normal(random); });
    InertiaFactor<double> factor;
    for (const Mat6d& mass : {whole, apart}) {  // in turn, as a part dips in
      factor.take(SpatialInertia<double>(mass));
      CHECK(factor.solve(load) == SpdFactor<6, double>(mass).solve(load));
    }
    factor.take(CompactInertia<double>{7.0, Symmetric3<double>::lower(compact.bottomRightCorner<3, 3>())});
    CHECK(factor.solve(load) == SpdFactor<6, double>(compact).solve(load));
  }
}
