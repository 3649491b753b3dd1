#pragma once

#include <array>
#include <cmath>

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/rotation.hpp"
#include "seacrane/math/spatial.hpp"

namespace seacrane {

/// The motion of a body whose six coordinates over the ground are prescribed, those of a free joint: the way
/// of its joint point along the axes of the ground's, and roll, pitch and yaw of its joint axes over them,
/// R = Rz Ry Rx.
struct DrivenBody {
  Vec3d position;
  Mat3d rotation;
  std::array<Twist<double>, 6> parts;  // of the twist, by coordinate
  Twist<double> twist, acceleration;   // of the state point

  DrivenBody(const JointData& joint, const std::array<CurveValue, 6>& asked) {
    const Mat3d& axes = joint.first_axes;
    const Mat3d yawed = axes * rotation_about_z(std::cos(asked[5].value), std::sin(asked[5].value));
    const double cp = std::cos(asked[4].value), sp = std::sin(asked[4].value), cr = std::cos(asked[3].value),
                 sr = std::sin(asked[3].value);
    const Vec3d ahead = cp * yawed.col(0) - sp * yawed.col(2);  // about which it rolls
    Mat3d rolled;
    rolled.col(0) = ahead;
    const Vec3d up = sp * yawed.col(0) + cp * yawed.col(2);
    rolled.col(1) = cr * yawed.col(1) + sr * up;
    rolled.col(2) = cr * up - sr * yawed.col(1);
    rotation = rolled * joint.second_axes.transpose();
    const Vec3d lever = -(rotation * joint.second_point);  // from the joint point
    position = joint.first_point + lever;
    const std::array<Vec3d, 3> about = {ahead, yawed.col(1), yawed.col(2)};
    Vec3d turning = Vec3d::Zero(), turning_rate = Vec3d::Zero(), moving = Vec3d::Zero();
    for (int i = 2; i >= 0; --i) {  // each axis turns with the ones after it
      const CurveValue& angle = asked[idx(3 + i)];
      turning_rate += angle.acceleration * about[idx(i)] + angle.rate * turning.cross(about[idx(i)]);
      turning += angle.rate * about[idx(i)];
    }
    for (int i = 0; i < 3; ++i) {
      position += asked[idx(i)].value * axes.col(i);
      moving += asked[idx(i)].acceleration * axes.col(i);
      const Vec3d way = asked[idx(i)].rate * axes.col(i), turn = asked[idx(3 + i)].rate * about[idx(i)];
      parts[idx(i)] = Twist<double>(way, Vec3d::Zero());
      parts[idx(3 + i)] = Twist<double>(turn.cross(lever), turn);
    }
    twist = Twist<double>::zero();
    for (const Twist<double>& part : parts) twist += part;
    acceleration =
        Twist<double>(moving + turning_rate.cross(lever) + turning.cross(turning.cross(lever)), turning_rate);
  }
};

}  // namespace seacrane
