#include <doctest/doctest.h>

#include <Eigen/SVD>

#include "multibody_scenes.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"
#include "seacrane/elements/joints/registry.hpp"

namespace seacrane::test {
namespace {

/// The type's example, its first body at the state points.
template <class Type>
JointData random_joint(Random& random) {
  const JointDescription d = Type::example(random);
  JointData j;
  j.first = 0;
  j.second = 1;
  j.first_point = d.first_frame.point;
  j.second_point = d.second_frame.point;
  j.first_axes = d.first_frame.axes;
  j.second_axes = d.second_frame.axes;
  j.parameters = find_joint_kind(Type::kind)->values(d);
  return j;
}

template <class Type>
RowBlock<double> evaluate(const JointData& j, const BodyKinematics<double>& a,
                          const BodyKinematics<double>& b) {
  RowBlock<double> out;
  Type::template evaluate<double>(JointGeometry<double>(j, a, b), j, out);
  return out;
}

/// Second body at the pose of the first: so an example is closed.
BodyKinematics<double> closed(const BodyKinematics<double>& a) {
  return {a.position, a.rotation, Vec3d::Zero(), Vec3d::Zero()};
}

}  // namespace

TEST_CASE("D of every joint type is the derivative of phi, gamma that of -D v, on and off the constraint") {
  Random random(1);
  for_each_joint_type([&]<class Type>(std::size_t) {
    CAPTURE(std::string(Type::kind));
    for (int trial = 0; trial < 20; ++trial) {
      const JointData j = random_joint<Type>(random);
      const auto a = random.kinematics();
      auto b = random.kinematics();
      b.position.x() += 4.0;  // the distance has no derivative where its points meet
      // Within 1 rad of the closed pose: nor has an angle about an axis that stands across its own.
      b.rotation = rotation_by(0.55 * random.vector()) * a.rotation;
      const auto at = [&](double t) { return evaluate<Type>(j, moved(a, t), moved(b, t)); };
      const auto rate = [&](double t) -> Vec6d { return at(t).d[0] * twist(a) + at(t).d[1] * twist(b); };
      const Vec6d phi_rate = slope([&](double t) -> Vec6d { return at(t).phi; });
      CHECK((rate(0.0) - phi_rate).norm() < kDifference);
      CHECK((at(0.0).gamma + slope(rate)).norm() < kDifference);
      CHECK(at(0.0).nu.norm() == 0.0);
    }
  });
}

TEST_CASE("a joint type has the rows it states, independent where the joint is closed") {
  Random random(2);
  for_each_joint_type([&]<class Type>(std::size_t) {
    CAPTURE(std::string(Type::kind));
    const JointData j = random_joint<Type>(random);
    const auto a = random.kinematics();
    const RowBlock<double> block = evaluate<Type>(j, a, closed(a));
    CHECK(block.phi.norm() < 1e-14);
    CHECK(block.d[0].bottomRows(kMaxRows - Type::rows).norm() == 0.0);
    CHECK(block.d[1].bottomRows(kMaxRows - Type::rows).norm() == 0.0);
    if (Type::rows == 0) return;
    Eigen::Matrix<double, 6, 12> d;
    d << block.d[0], block.d[1];
    const Eigen::JacobiSVD<MatXd> svd(d.topRows(Type::rows));
    CHECK(svd.singularValues()[Type::rows - 1] > 0.1);
  });
}

TEST_CASE("each joint lets pass the relative motions its name promises and no other") {
  // Slides along and turns about x, y, z of the joint frame, from the closed pose.
  const std::vector<std::pair<std::string, std::string>> free_motions = {
      {"weld", "000000"},      {"revolute", "000001"}, {"prismatic", "001000"}, {"cylindrical", "001001"},
      {"spherical", "000111"}, {"planar", "110001"},   {"free", "111111"}};
  Random random(3);
  for_each_joint_type([&]<class Type>(std::size_t) {
    for (const auto& [kind, motions] : free_motions) {
      if (kind != Type::kind) continue;
      const JointData j = random_joint<Type>(random);
      const auto a = random.kinematics();
      const auto b = closed(a);
      const Mat3d axes = a.rotation * j.first_axes;
      for (int i = 0; i < 6; ++i) {
        CAPTURE(kind);
        CAPTURE(i);
        BodyKinematics<double> c = b;
        const Vec3d lever = b.rotation * j.second_point;
        if (i < 3) {
          c.position += 0.3 * axes.col(i);
        } else {
          const Mat3d turn = rotation_by(0.3 * axes.col(i - 3));
          c.rotation = turn * b.rotation;
          c.position += lever - turn * lever;
        }
        const double residual = evaluate<Type>(j, a, c).phi.norm();
        if (motions[static_cast<std::size_t>(i)] == '1') {
          CHECK(residual < 1e-14);
        } else {
          CHECK(residual > 0.1);
        }
      }
    }
  });
}

TEST_CASE("a universal joint turns about both of its axes but not about their common normal") {
  Random random(4);
  const JointData j = random_joint<Universal>(random);
  const auto a = random.kinematics();
  const auto b = closed(a);
  const Mat3d axes = a.rotation * j.first_axes, cross_axes = b.rotation * j.second_axes;
  const auto residual = [&](const Vec3d& about) {
    BodyKinematics<double> c = b;
    const Mat3d turn = rotation_by(0.3 * about);
    const Vec3d lever = b.rotation * j.second_point;
    c.rotation = turn * b.rotation;
    c.position += lever - turn * lever;
    return evaluate<Universal>(j, a, c).phi.norm();
  };
  CHECK(residual(axes.col(2)) < 1e-14);
  CHECK(residual(cross_axes.col(2)) < 1e-14);
  CHECK(residual(axes.col(2).cross(cross_axes.col(2))) > 0.1);
}

TEST_CASE("joint coordinates: rows and second derivatives are those of the value, at any pose") {
  Random random(5);
  for (const CoordinateKind kind :
       {CoordinateKind::displacement, CoordinateKind::x, CoordinateKind::y, CoordinateKind::z,
        CoordinateKind::roll, CoordinateKind::pitch, CoordinateKind::yaw}) {
    CAPTURE(static_cast<int>(kind));
    for (int trial = 0; trial < 20; ++trial) {
      CoordinateData c{random_joint<Free>(random), kind};
      const auto a = random.kinematics();
      auto b = random.kinematics();
      // Relative rotation of 1 rad or less: away from pitch = 90 deg, where these angles end.
      b.rotation = a.rotation * c.joint.first_axes * rotation_by(0.55 * random.vector()) *
                   c.joint.second_axes.transpose();
      const auto at = [&](double t) { return evaluate_coordinate<double>(c, moved(a, t), moved(b, t)); };
      const auto rate = [&](double t) { return coordinate_rate<double>(at(t), moved(a, t), moved(b, t)); };
      CHECK(std::abs(rate(0.0) - slope([&](double t) { return at(t).value; })) < kDifference);
      CHECK(std::abs(at(0.0).gamma + slope(rate)) < kDifference);
      CHECK(std::abs(rate(0.0) - at(0.0).da.dot(twist(a)) - at(0.0).db.dot(twist(b))) < 1e-14);
    }
  }
}

TEST_CASE("the angle of a hinge: value, rate and second derivative along a motion of the hinge") {
  Random random(6);
  for (int trial = 0; trial < 20; ++trial) {
    CoordinateData c{random_joint<Free>(random), CoordinateKind::angle};
    const auto a = random.kinematics();
    const double q = 3.0 * random.number(), q1 = random.number(), q2 = random.number();
    const auto second = [&](double t) {
      const auto first = moved(a, t);
      BodyKinematics<double> b = first;
      const Mat3d axes = first.rotation * c.joint.first_axes;
      b.rotation = axes * rotation_by(Vec3d(0.0, 0.0, q + t * q1 + 0.5 * t * t * q2)) *
                   c.joint.second_axes.transpose();
      b.angular_velocity = first.angular_velocity + (q1 + t * q2) * axes.col(2);
      return b;
    };
    const auto at = [&](double t) { return evaluate_coordinate<double>(c, moved(a, t), second(t)); };
    CHECK(std::abs(at(0.0).value - q) < 1e-14);
    CHECK(std::abs(coordinate_rate<double>(at(0.0), a, second(0.0)) - q1) < 1e-14);
    const Vec3d spin = slope([&](double t) -> Vec3d { return second(t).angular_velocity; });
    CHECK(std::abs(at(0.0).db.tail<3>().dot(spin) - at(0.0).gamma - q2) < kDifference);
  }
}

TEST_CASE("a driver's row is the time derivative of coordinate minus reference") {
  Random random(7);
  for (const CoordinateKind kind : {CoordinateKind::displacement, CoordinateKind::y, CoordinateKind::yaw}) {
    DriverData driver{{random_joint<Free>(random), kind}, Curve::harmonic(-1.0, 0.1, 0.4, 1.3, 0.2), 0};
    const auto a = random.kinematics();
    auto b = random.kinematics();
    b.rotation = a.rotation * driver.coordinate.joint.first_axes * rotation_by(0.3 * random.vector()) *
                 driver.coordinate.joint.second_axes.transpose();
    const auto at = [&](double t) {
      RowBlock<double> out;
      evaluate_driver<double>(driver, driver.curve.at(t), moved(a, t), moved(b, t), out);
      return out;
    };
    const auto rate = [&](double t) {
      const RowBlock<double> r = at(t);
      return r.d[0].row(0).dot(twist(a)) + r.d[1].row(0).dot(twist(b)) - r.nu[0];
    };
    CHECK(std::abs(rate(0.0) - slope([&](double t) { return at(t).phi[0]; })) < kDifference);
    CHECK(std::abs(at(0.0).gamma[0] + slope(rate)) < kDifference);
  }
}

TEST_CASE("an angle driver beyond half a turn sees the small difference, not a full turn") {
  JointData j;
  j.first_axes = j.second_axes = Mat3d::Identity();
  j.first_point = j.second_point = Vec3d::Zero();
  const DriverData driver{{j, CoordinateKind::angle}, Curve::constant(7.0), 0};
  auto a = BodyKinematics<double>::ground(), b = a;
  b.rotation = rotation_by(Vec3d(0.0, 0.0, 7.01));
  RowBlock<double> out;
  evaluate_driver<double>(driver, driver.curve.at(0.0), a, b, out);
  CHECK(out.phi[0] == doctest::Approx(0.01).epsilon(1e-12));
}

}  // namespace seacrane::test
