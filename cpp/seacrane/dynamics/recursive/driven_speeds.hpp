#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "seacrane/dynamics/recursive/articulated.hpp"
#include "seacrane/dynamics/recursive/driven_stroke.hpp"
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

/// Coordinates of a tree that drivers prescribe. They are functions of time alone and no unknowns: their
/// places in the state say only on which side of a dead centre a strut stands, and from which full turn on an
/// angle counts. Arrays of positions q and of speeds u are those of the tree.
class DrivenSpeeds {
 public:
  DrivenSpeeds(const Model& model, const BodyTree& tree);

  bool any() const { return !clusters_.empty(); }
  /// Clusters, by their place in the tree.
  const std::vector<std::size_t>& clusters() const { return clusters_; }

  /// Sets positions, speeds and rates of speeds. Throws std::domain_error where a stroke is out of its
  /// hinge's reach.
  void follow(double t, double curve_limit, double* q, double* u, double* u_rate);
  /// How speeds jump at t, from the left limit to that of `curve_limit`, where u are those before; elsewhere
  /// zero. Whether any does.
  bool jump(double t, double curve_limit, const double* q, const double* u, double* jump);
  /// How many drivers there are.
  std::size_t count() const { return coordinates_.size() + 6 * bodies_.size(); }
  /// Appends for every driver, by the tree's last solve(): of a coordinate the load along the tree's own, of
  /// a body the power.
  template <class T>
  void read(const ArticulatedTree<T>& tree, std::vector<T>& drives) const;
  /// From these the load of a driver along its own coordinate, near positions q; not a number: of a driver of
  /// none of them.
  double force(int element, const std::vector<double>& drives, double t, double curve_limit,
               const double* q) const;
  /// From these the power of a driver, at the last follow().
  template <class T>
  T power(std::size_t driver, const std::vector<T>& drives) const {
    return driver < coordinates_.size() ? T(coordinates_[driver].u) * drives[driver] : drives[driver];
  }

 private:
  struct Coordinate {
    const Cluster* cluster;
    std::size_t place;
    const DriverData* driver;
    std::optional<DrivenStroke> stroke;
    double u = 0.0;  // at the last follow()
  };
  struct Body {
    const Cluster* cluster;
    std::size_t place;
    std::array<const DriverData*, 6> drivers;
    std::vector<Twist<double>> parts;  // six, at the last follow()
  };

  DrivenMotion motion(const Coordinate& one, double t, double curve_limit, double near) const;
  static DrivenBody motion(const Body& one, double t, double curve_limit);

  const Model& model_;
  std::vector<std::size_t> clusters_;
  std::vector<Coordinate> coordinates_;
  std::vector<Body> bodies_;
};

template <class T>
void DrivenSpeeds::read(const ArticulatedTree<T>& tree, std::vector<T>& drives) const {
  for (const Coordinate& one : coordinates_) drives.push_back(tree.drive(one.place));
  for (const Body& one : bodies_) {
    const Wrench<T> wrench = tree.drive_wrench(one.place);
    for (const Twist<double>& part : one.parts) {
      drives.push_back(dot(Twist<T>(part.vector().cast<T>()), wrench));
    }
  }
}

}  // namespace seacrane
