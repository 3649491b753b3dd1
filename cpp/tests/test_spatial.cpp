#include <doctest/doctest.h>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/recursive/turning_inertia.hpp"
#include "seacrane/math/spatial.hpp"

namespace seacrane::test {
namespace {

Mat6d random_inertia(Random& random) {
  const Mat6d root = Mat6d::NullaryExpr([&] { return random.number(); });
  return root * root.transpose();
}

/// Twist at the start of `reach` to that at its end.
Mat6d shift(const Vec3d& reach) {
  Mat6d out = Mat6d::Identity();
  out.topRightCorner<3, 3>() = -skew<double>(reach);
  return out;
}

}  // namespace

TEST_CASE("inertias in blocks do what their matrices do") {
  Random random(21);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat6d carried = random_inertia(random), held = random_inertia(random);
    const Vec3d reach = random.vector();
    const CompactInertia<double> compact{2.5, Symmetric3<double>::lower(random.inertia())};
    const Mat6d plain = SpatialInertia<double>(compact).matrix();
    CHECK((plain.topLeftCorner<3, 3>() - 2.5 * Mat3d::Identity()).norm() == 0.0);

    SpatialInertia<double> sum(held);
    CHECK((sum.matrix() - held).norm() == 0.0);
    sum.add_shifted_from(reach, SpatialInertia<double>(carried));
    sum.add_shifted_from(reach, compact);
    const Mat6d expected = held + shift(reach).transpose() * (carried + plain) * shift(reach);
    CHECK((sum.matrix() - expected).norm() < 1e-13 * expected.norm());

    const Wrench<double> a(random.vector(), random.vector());
    sum.subtract_outer(a, 0.3 * a);
    const Mat6d less = expected - 0.3 * a.vector() * a.vector().transpose();
    CHECK((sum.matrix() - less).norm() < 1e-13 * expected.norm());

    const Twist<double> twist(random.vector(), random.vector());
    CHECK(((sum * twist).vector() - less * twist.vector()).norm() < 1e-13 * expected.norm());
    CHECK(((compact * twist).vector() - plain * twist.vector()).norm() < 1e-14 * plain.norm());
  }
}

TEST_CASE("an inertia turns with its body, by its axis of symmetry alone where it has one") {
  Random random(22);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3d axes = random.rotation(), turned = random.rotation();
    const double across = 1.0 + random.positive();
    for (const double along : {across, 0.01, 5.0}) {
      const Mat3d inertia = axes * Vec3d(along, across, across).asDiagonal() * axes.transpose();
      const Mat3d found = TurningInertia(inertia).at<double>(turned).full();
      CHECK((found - turned * inertia * turned.transpose()).norm() < 1e-13 * inertia.norm());
    }
    const Mat3d inertia = random.inertia();
    const Mat3d found = TurningInertia(inertia).at<double>(turned).full();
    CHECK((found - turned * inertia * turned.transpose()).norm() < 1e-14 * inertia.norm());
  }
}

}  // namespace seacrane::test
