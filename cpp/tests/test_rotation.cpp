#include <doctest/doctest.h>

#include "multibody_scenes.hpp"

namespace seacrane::test {
namespace {

Mat3d about(int axis, double angle) { return rotation_by(angle * Vec3d::Unit(axis)); }

Vec3d vector_of(const Mat3d& s) {
  return 0.5 * Vec3d(s(2, 1) - s(1, 2), s(0, 2) - s(2, 0), s(1, 0) - s(0, 1));
}

}  // namespace

TEST_CASE("a quaternion of any length gives the rotation of its direction") {
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    const Vec3d angle = 3.0 * random.vector();
    const Vec4d unit(std::cos(0.5 * angle.norm()), 0, 0, 0);
    Vec4d q = unit;
    q.tail<3>() = std::sin(0.5 * angle.norm()) * angle.normalized();
    for (const double length : {1.0, 1e-3, 50.0}) {
      CHECK((rotation_from_quaternion<double>(length * q) - rotation_by(angle)).norm() < 1e-14);
    }
    CHECK((rotation_from_quaternion<double>(-q) - rotation_by(angle)).norm() < 1e-14);
  }
}

TEST_CASE("quaternions come back from rotations, in all four of Shepperd's branches") {
  Random random(12);
  int branch[4] = {};
  for (int i = 0; i < 400; ++i) {
    Vec4d q(random.number(), random.number(), random.number(), random.number());
    q.normalize();
    if (q[0] < 0.0) q = -q;
    int largest = 0;
    q.cwiseAbs().maxCoeff(&largest);
    ++branch[largest];
    CHECK((quaternion_from_rotation(rotation_from_quaternion<double>(q)) - q).norm() < 2e-15);
  }
  for (const int count : branch) CHECK(count > 20);
  // Half turns: w = 0.
  for (int axis = 0; axis < 3; ++axis) {
    const Vec4d q = quaternion_from_rotation(about(axis, M_PI));
    CHECK(std::abs(q[1 + axis]) == doctest::Approx(1.0).epsilon(1e-15));
  }
}

TEST_CASE("quaternion_rate turns the body with omega in inertial axes") {
  Random random(13);
  for (int i = 0; i < 20; ++i) {
    const Vec4d q = quaternion_from_rotation(random.rotation());
    const Vec3d omega = random.vector();
    const Vec4d rate = quaternion_rate<double>(q, omega);
    CHECK(std::abs(rate.dot(q)) < 1e-15);
    const Mat3d r = rotation_from_quaternion<double>(q);
    const Mat3d r_rate =
        slope([&](double t) -> Mat3d { return rotation_from_quaternion<double>(Vec4d(q + t * rate)); });
    CHECK((r_rate - skew(omega) * r).norm() < 1e-10);
  }
}

TEST_CASE("rotate_quaternion applies a rotation vector of inertial axes first") {
  Random random(14);
  for (const double size : {3.0, 1.0, 1e-4, 1e-9, 0.0}) {
    const Vec3d angle = size * random.vector();
    const Vec4d q = quaternion_from_rotation(random.rotation());
    const Mat3d turned = rotation_from_quaternion<double>(rotate_quaternion(angle, q));
    CHECK((turned - rotation_by(angle) * rotation_from_quaternion<double>(q)).norm() < 2e-15);
  }
}

TEST_CASE("XYZ Euler angles are Rx Ry Rz and come back from the matrix") {
  Random random(15);
  for (int i = 0; i < 50; ++i) {
    const Vec3d phi(3.1 * random.number(), 1.5 * random.number(), 3.1 * random.number());
    const Mat3d r = about(0, phi[0]) * about(1, phi[1]) * about(2, phi[2]);
    CHECK((rotation_from_euler_xyz<double>(phi) - r).norm() < 2e-15);
    // asin loses digits like 1 / cos(phi_y)
    CHECK((euler_xyz_from_rotation(r) - phi).norm() < 1e-14 / std::cos(phi[1]));
  }
}

TEST_CASE("omega = E phidot is equation 20 with sin(phi_y) in its corner, by differences") {
  Random random(16);
  for (int i = 0; i < 20; ++i) {
    const Vec3d phi(3.0 * random.number(), 1.4 * random.number(), 3.0 * random.number());
    const Vec3d rate = random.vector();
    const Mat3d r = rotation_from_euler_xyz<double>(phi);
    const Mat3d r_rate =
        slope([&](double t) -> Mat3d { return rotation_from_euler_xyz<double>(Vec3d(phi + t * rate)); });
    const Vec3d omega = vector_of(r_rate * r.transpose());
    CHECK((euler_xyz_to_omega<double>(phi) * rate - omega).norm() < 1e-10);
    CHECK((euler_xyz_rate<double>(phi, omega) - rate).norm() < 1e-10 / std::cos(phi[1]));
    // The paper's print has 0 there: its error is sin(phi_y) phidot_z.
    Mat3d printed = euler_xyz_to_omega<double>(phi);
    printed(0, 2) = 0.0;
    const double missing = std::abs(std::sin(phi[1]) * rate[2]);
    CHECK(std::abs((printed * rate - omega).norm() - missing) < 1e-10);
  }
}

TEST_CASE("the rate of E is equation 22 with cos(phi_y) phidot_y in its corner, by differences") {
  Random random(17);
  for (int i = 0; i < 20; ++i) {
    const Vec3d phi = 1.4 * random.vector(), rate = random.vector();
    const Mat3d expected =
        slope([&](double t) -> Mat3d { return euler_xyz_to_omega<double>(Vec3d(phi + t * rate)); });
    CHECK((euler_xyz_to_omega_rate<double>(phi, rate) - expected).norm() < 1e-10);
  }
}

TEST_CASE("roll, pitch, yaw are those of Rz Ry Rx") {
  Random random(18);
  for (int i = 0; i < 50; ++i) {
    const Vec3d a(3.1 * random.number(), 1.5 * random.number(), 3.1 * random.number());
    const Mat3d r = about(2, a[2]) * about(1, a[1]) * about(0, a[0]);
    CHECK((roll_pitch_yaw<double>(r) - a).norm() < 1e-14 / std::cos(a[1]));
  }
  const Vec3d upright = roll_pitch_yaw<double>(about(1, 0.5 * M_PI));  // rounding beyond 1 must not give NaN
  CHECK(upright[1] == doctest::Approx(0.5 * M_PI));
}

TEST_CASE("angles wrap to [-pi, pi)") {
  for (int turns = -3; turns <= 3; ++turns) {
    for (const double x : {-3.0, -0.1, 0.0, 1.0, 3.1}) {
      CHECK(wrap_angle(x + 2.0 * M_PI * turns) == doctest::Approx(x).epsilon(1e-14));
    }
  }
  CHECK(wrap_angle(M_PI) == doctest::Approx(-M_PI));
}

}  // namespace seacrane::test
